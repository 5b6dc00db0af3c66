// SPDX-License-Identifier: GPL-3.0-or-later
// What plane_wave is asked for, and what it refuses.
#pragma once

#include "../lattice_choice.hpp"
#include <spam/analysis/plane_wave.hpp>

namespace plane_wave {

using namespace spam;

struct Parameters {
    Polarization polarization = Polarization::transverse;
    int cells = 24;
    double amplitude = 0.25;
    double block = 3.0;  // d
    bool compare_sizes = false;
    int dimension = 2;
    CubicLattice lattice = CubicLattice::sc;
    std::optional<double> perturb{};
    int seed = 1;
    /// Of one of the cells along the wave.
    double height() const { return dimension == 2 ? std::sqrt(0.75) : cubic_edge(lattice); }
};

/// Blocks are of the transverse wave, and a part of one bulge of it.
/// Turning is measured in a transverse wave of one size in the plane.
inline bool has_blocks(const Options& options, const Parameters& p) {
    return p.dimension == 2 && !p.compare_sizes &&
           !(options.given("polarization") && p.polarization == Polarization::longitudinal);
}

inline void refuse_blocks(const Options& options, const Parameters& p) {
    if (!has_blocks(options, p)) return;
    const double half = 0.5 * p.cells * std::sqrt(0.75);
    if (p.block > half)
        refuse("block: {} must be at most half a wave, {:.4g} for --cells {}; choose a smaller one",
               p.block, half, p.cells);
}

/// The smallest of three lattices has half the cells; it must be wider than twice the range.
inline void refuse_small(const Parameters& p, double range) {
    const int half = p.cells / 4 * 2;
    if (!p.compare_sizes || half * p.height() > 2.0 * range) return;
    const int least = static_cast<int>(2.0 * range / p.height()) + 1;
    refuse(
        "cells: {} are too few for --compare-sizes with --range {}: half of them make "
        "a lattice not "
        "wider than twice the range; the least is {}, or leave --compare-sizes out",
        p.cells, range, 2 * (least + least % 2));
}

/// Three zeros of the velocity make a period: the last at 3/2 of it.
inline void refuse_too_short(const Parameters& p, double t_end, double longest) {
    const double least = 1.6 * longest;
    if (p.compare_sizes && t_end < least)
        refuse(
            "t-end: {:g} is too short to measure the period {:.4g} of the longest wave that "
            "--compare-sizes needs; the least is {:.4g}",
            t_end, longest, least);
}

}  // namespace plane_wave
