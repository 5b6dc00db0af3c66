// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of plastic_block share.
#pragma once

#include "../common.hpp"

namespace plastic_block {

using namespace spam;

/// How the stress is kept on the yield surface.
enum class Yielding {
    in_stages,    ///< returned in every right-hand side, settled after the step
    after_steps,  ///< after steps alone: right-hand sides see stresses beyond the surface
    smooth        ///< by rates
};
inline std::string_view to_string(Yielding yielding) {
    constexpr std::string_view names[] = {"return", "after", "smooth"};
    return names[static_cast<int>(yielding)];
}

struct Parameters {
    int columns = 20, rows = 11;
    double amplitude = 0.12, spin = 0.03;
    double yield_stress = 0.02, hardening = 0.0, width = 0.1;
    Formulation formulation = Formulation::updated;
    Yielding yielding = Yielding::in_stages;
    Transport transport = Transport::monaghan;
    double range = 3.0, penalty = 0.1;
    bool compare = false;
    int jobs = all_cores();
};

struct Block {
    std::shared_ptr<ParticleModel<2>> model;
    std::vector<double> y0;
};

/// A triangular lattice of spacing 1 about the origin, lambda = eta = sqrt(3/16), free of stress, with
///     v = (A sin(pi x/20) - w y, 0.7 A sin(pi x/20) sin(pi x/10) y/5 + w x).
Block make_block(const Parameters& p);

/// Energy spent on plastic flow: summed over particles what the law remembers, or, where the energy equation
/// carries it, what is left of the internal energy without the elastic one.
double plastic_work(const Model<2>& model, std::span<const double> y);

std::vector<double> plastic_strains(const Model<2>& model, std::span<const double> y);

// ---- comparison.cpp ----

/// Errors, orders and work of all forms against steps of their own: comparison.csv and one picture.
void compare(Session& session, const Parameters& p);

}  // namespace plastic_block
