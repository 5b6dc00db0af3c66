// SPDX-License-Identifier: GPL-3.0-or-later
#include "pieces.hpp"

#include <spam/neighbors/connected_parts.hpp>
#include <spam/neighbors/pair_list.hpp>

namespace breaking {

std::vector<std::size_t> piece_sizes(const Model<2>& model, std::span<const double> y,
                                     std::size_t least, double reach) {
    const Points<2> x = ConstState<2>(model.layout(), y).position();
    std::vector<std::size_t> sizes;
    for (const auto piece : connected_parts<2>(x, reach * model.particles().spacing, model.box())) {
        sizes.resize(std::max(sizes.size(), static_cast<std::size_t>(piece) + 1), 0);
        ++sizes[static_cast<std::size_t>(piece)];
    }
    std::erase_if(sizes, [least](std::size_t n) { return n < least; });
    std::sort(sizes.rbegin(), sizes.rend());
    return sizes;
}

std::vector<Eigen::Index> particles_of_pieces(const Points<2>& position, double spacing,
                                              std::size_t least) {
    const auto piece = connected_parts<2>(position, piece_reach * spacing, {});
    std::vector<std::size_t> size(piece.size(), 0);
    for (const auto one : piece) ++size[static_cast<std::size_t>(one)];
    std::vector<Eigen::Index> all;
    for (std::size_t i = 0; i < piece.size(); ++i)
        if (size[static_cast<std::size_t>(piece[i])] >= least)
            all.push_back(static_cast<Eigen::Index>(i));
    return all;
}

FirstNeighbours::FirstNeighbours(const Particles<2>& particles)
    : count_(Eigen::ArrayXd::Zero(particles.reference_position.cols())),
      reach_(piece_reach * particles.spacing) {
    const PairList<2> near(particles.reference_position, 1.3 * particles.spacing, {});
    for (std::size_t i = 0; i < near.size(); ++i)
        for (const std::uint32_t j : near.neighbours(i)) {
            if (j <= i || particles.body[i] != particles.body[j]) continue;
            pairs_.emplace_back(i, j);
            count_[static_cast<Eigen::Index>(i)] += 1.0;
            count_[static_cast<Eigen::Index>(j)] += 1.0;
        }
}

std::vector<double> FirstNeighbours::lost(const Points<2>& position) const {
    Eigen::ArrayXd left = Eigen::ArrayXd::Zero(position.cols());
    for (const auto& [i, j] : pairs_)
        if ((position.col(i) - position.col(j)).norm() < reach_) {
            left[i] += 1.0;
            left[j] += 1.0;
        }
    const Eigen::ArrayXd lost = 1.0 - left / count_.max(1.0);
    return {lost.begin(), lost.end()};
}

}  // namespace breaking
