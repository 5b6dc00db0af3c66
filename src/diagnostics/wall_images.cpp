// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/diagnostics/wall_images.hpp>

#include <cmath>

namespace spam {

template <int Dim>
Eigen::MatrixXd WallImages<Dim>::with_particles(
    const Eigen::Ref<const Eigen::MatrixXd>& of_particles) const {
    Eigen::MatrixXd all(of_particles.rows(), of_particles.cols() + count());
    all.leftCols(of_particles.cols()) = of_particles;
    for (Eigen::Index k = 0; k < count(); ++k)
        all.col(of_particles.cols() + k) = of_particles.col(owner[static_cast<std::size_t>(k)]);
    return all;
}

template <int Dim>
WallImages<Dim> images_behind_walls(const Box<Dim>& box, double reach, const Points<Dim>& position,
                                    const Points<Dim>& velocity) {
    struct One {
        Point<Dim> x, v;
        Eigen::Index owner;
    };
    std::vector<One> all;
    for (Eigen::Index i = 0; i < position.cols(); ++i)
        all.push_back({position.col(i), velocity.col(i), i});
    // Direction by direction: images in corners are images of images.
    for (int a = 0; a < Dim; ++a) {
        const std::size_t before = all.size();
        for (const bool upper : {false, true}) {
            const Wall<Dim>& wall = box.wall(a, upper);
            if (!wall.has_images()) continue;
            const Image<Dim> image = wall.image(a);
            for (std::size_t k = 0; k < before; ++k) {
                if (std::abs(all[k].x[a] - wall.at) > reach) continue;
                One one = all[k];
                for (int b = 0; b < Dim; ++b) {
                    const auto axis = static_cast<std::size_t>(b);
                    one.x[b] = image.position[axis].sign * one.x[b] + image.position[axis].shift;
                    one.v[b] = image.velocity[axis].sign * one.v[b] + image.velocity[axis].shift;
                }
                all.push_back(one);
            }
        }
    }
    WallImages<Dim> images;
    const auto n = static_cast<std::size_t>(position.cols());
    const auto count = static_cast<Eigen::Index>(all.size() - n);
    images.position.resize(Dim, count);
    images.velocity.resize(Dim, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const One& one = all[n + static_cast<std::size_t>(k)];
        images.position.col(k) = one.x;
        images.velocity.col(k) = one.v;
        images.owner.push_back(one.owner);
    }
    return images;
}

SPAM_COMPILED(template struct WallImages);
#define SPAM_INSTANTIATE(D)                                                             \
    template WallImages<D> images_behind_walls(const Box<D>&, double, const Points<D>&, \
                                               const Points<D>&);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
