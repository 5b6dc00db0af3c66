// SPDX-License-Identifier: GPL-3.0-or-later
// A bar on its way to be broken: its model, the account of its bodies, and what is asked of both.
#pragma once

#include "../breaking/flowing.hpp"
#include "../formulation.hpp"
#include "body_ledger.hpp"
#include "target.hpp"
#include <spam/problem/nearest_state.hpp>

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

struct Bar {
    std::string title, label;
    std::shared_ptr<Model<2>> model;
    bool L_kept;                           ///< by every body
    double L_tolerance;                    ///< where it is
    double longest_step;                   ///< with which that is known
    std::unique_ptr<BodyLedger> ledger{};  ///< of its bodies
    std::vector<NearestState<2>> drawn{};
    std::string prefix{};  ///< of results where there are several
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
