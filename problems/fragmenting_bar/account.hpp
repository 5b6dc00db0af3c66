// SPDX-License-Identifier: GPL-3.0-or-later
// A bar on its way to be broken: its model, the account of its bodies, and what is asked of both.
#pragma once

#include "../breaking/flowing.hpp"
#include "body_ledger.hpp"
#include "target.hpp"

namespace fragmenting_bar {

using namespace spam;

struct Parameters {
    Target target;
    Formulation formulation = Formulation::updated;
    breaking::FlowingMatter flowing{.core = 1.0};  ///< of material vectors
    bool compare = false;

    bool vectors() const { return formulation == Formulation::material_vectors; }
};

/// Of how many particles what is called a piece has at least.
constexpr std::size_t least_particles = 5;

/// Of classical Runge-Kutta.
constexpr double step = 0.05, step_of_vectors = 0.025;

struct Bar : Variant<2, Model<2>> {
    bool L_kept = true;              ///< by every body
    double L_tolerance = 1e-7;       ///< where it is
    double longest_step = HUGE_VAL;  ///< with which that is known
    std::unique_ptr<BodyLedger> ledger = std::make_unique<BodyLedger>();  ///< of its bodies
};

/// One of smooth particles, or one of a solid that flows, with material vectors.
Bar make_bar(const Parameters& p, const Scheme& scheme, bool vectors);
/// Those of the paper without and with a balance of torques, and one with material vectors.
std::vector<Bar> compared(const Parameters& p, Scheme scheme);

/// bodies.csv: all bodies after every change.
void write_ledger(const RunFolder& folder, const BodyLedger& ledger);

/// What no body may lose while it is one, by the angular momentum and the momentum that came with the projectile.
void check_account(Session& session, const Bar& bar, const RunRecord& run);

/// How one has gone, or how several have ended.
void draw(Session& session, const std::vector<Bar>& bars, const std::vector<RunRecord>& runs);

}  // namespace fragmenting_bar
