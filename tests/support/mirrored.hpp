// SPDX-License-Identifier: GPL-3.0-or-later
// A model between mirrors beside the symmetric whole of which it is a part.
#pragma once

#include "support/random_state.hpp"
#include <spam/problem/motion.hpp>

#include <functional>
#include <memory>

namespace spam::test {

inline constexpr int cells = 6;

/// Mirrors around [0, size]^Dim.
template <int Dim>
Box<Dim> mirrors(double size, WallKind kind = WallKind::mirror) {
    Box<Dim> box;
    for (int a = 0; a < Dim; ++a) {
        box.set_wall(a, false, {kind, 0.0});
        box.set_wall(a, true, {kind, size});
    }
    return box;
}

template <int Dim>
Particles<Dim> jittered(int n, unsigned seed) {
    std::array<int, Dim> edge;
    edge.fill(n);
    Points<Dim> x = square_lattice<Dim>(edge);
    x.colwise() -= x.rowwise().minCoeff().eval();
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> u(-0.2, 0.2);
    for (auto& c : x.reshaped()) c += 0.5 + u(random);
    auto particles = make_particles<Dim>(x, 1.0);
    for (double& m : particles.mass) m += u(random);
    return particles;
}

/// The sign of component c of a field in an image behind mirrors across the directions in `flipped`.
inline double sign_of(Field field, int dim, int c, unsigned flipped) {
    const auto of = [&](int a) { return flipped >> a & 1U ? -1.0 : 1.0; };
    if (field == Field::position || field == Field::velocity) return of(c);
    if (field == Field::stress)
        for (int a = 0; a < dim; ++a)
            for (int b = a + 1; b < dim; ++b)
                if (symmetric_index(dim, a, b) == c) return of(a) * of(b);
    return 1.0;
}

template <int Dim>
using Build = std::function<std::unique_ptr<Model<Dim>>(Particles<Dim>, const Box<Dim>&)>;

/// Largest difference of any rate between mirrors and the symmetric whole, relative to the largest; or of anything in
/// y after that many steps of time 0.02.
template <int Dim>
double against_symmetric_whole(const Build<Dim>& build, int steps = 0) {
    constexpr unsigned images = 1U << Dim;
    const auto half = jittered<Dim>(cells, 3);
    const auto n = half.reference_position.cols();
    Particles<Dim> all = half;
    all.reference_position.resize(Dim, n * images);
    all.mass.clear(), all.id.clear();
    for (unsigned image = 0; image < images; ++image) {
        for (int a = 0; a < Dim; ++a)
            all.reference_position.row(a).segment(image * n, n) =
                sign_of(Field::position, Dim, a, image) * half.reference_position.row(a);
        all.mass.insert(all.mass.end(), half.mass.begin(), half.mass.end());
        for (const auto id : half.id) all.id.push_back(id + image * n);
    }
    all.body.assign(all.mass.size(), 0);
    std::array<double, Dim> twice;
    twice.fill(2.0 * cells);
    auto walled = build(half, mirrors<Dim>(cells));
    auto whole = build(all, Box<Dim>(twice));
    auto y = random_state(*walled, 5);
    std::mt19937_64 random(6);
    std::uniform_real_distribution<double> aside(-0.05, 0.05);
    for (auto& x : State<Dim>(walled->layout(), y).position().reshaped()) x += aside(random);
    if (steps > 0) State<Dim>(walled->layout(), y).velocity() *= 0.1;  // none reaches a mirror
    std::vector<double> Y(whole->layout().size(), 0.0);
    const State<Dim> small(walled->layout(), y), large(whole->layout(), Y);
    if (small.has(Field::energy))
        for (auto& e : small.energy().reshaped()) e = std::abs(e) + 0.5;
    for (const auto& block : whole->layout().blocks())
        for (unsigned image = 0; image < images; ++image)
            for (Eigen::Index c = 0; c < static_cast<Eigen::Index>(block.components); ++c)
                large.field(block.field).row(c).segment(image * n, n) =
                    sign_of(block.field, Dim, static_cast<int>(c), image) *
                    small.field(block.field).row(c);
    const auto later = [&](Model<Dim>& model, const std::vector<double>& from) {
        if (steps == 0) return rates_of(model, from);
        Motion<Dim> motion(model, from, {.method = "rk4", .dt = 0.02});
        motion.advance_to(0.02 * steps);
        return std::vector<double>(motion.y().begin(), motion.y().end());
    };
    const auto rates = later(*walled, y), expected = later(*whole, Y);
    const ConstState<Dim> found(walled->layout(), rates), right(whole->layout(), expected);
    double worst = 0.0;
    for (const auto& block : whole->layout().blocks()) {
        const auto of_half = right.field(block.field).leftCols(n);
        const double size = of_half.cwiseAbs().maxCoeff();
        const double apart = (found.field(block.field) - of_half).cwiseAbs().maxCoeff();
        worst = std::max(worst, std::isnan(apart) ? HUGE_VAL : apart / size);
    }
    return worst;
}

}  // namespace spam::test
