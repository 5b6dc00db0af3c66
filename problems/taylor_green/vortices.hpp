// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "stirred_fluid.hpp"

namespace taylor_green {

using namespace spam;

struct Parameters : stirred::Parameters {
    double disorder = 0.0;  // particles moved from the lattice by up to so many spacings
    int seed = 1;
};

/// Four vortices in a square of side L, an exact solution for a fluid that is not compressed. A direction is
/// periodic, or between mirrors: the flow is then moved by a quarter of its wave, so that planes of its
/// symmetry are there.
struct ExactFlow {
    double L, nu, U;
    Point<2> quarter = Point<2>::Zero();  ///< pi/2 in a direction between mirrors

    double wave() const { return 2.0 * std::numbers::pi / L; }
    /// What is left of velocities after this time.
    double left(double t) const { return std::exp(-2.0 * nu * wave() * wave() * t); }
    Point<2> velocity(const Point<2>& x, double t) const;
    /// Of density one.
    double pressure(const Point<2>& x, double t) const;
    double turn() const { return L / U; }
};

struct Flow : Variant<2> {
    ExactFlow exact{};
    std::string transport{};
    bool known = true;  ///< the sides are such that the flow is exact
};

/// Velocity, and the density that belongs to the exact pressure, of cells x cells particles.
Flow make_flow(const Parameters& p, int cells);

/// `velocity_error`: mean |v - v_exact| by mean |v_exact|, both at the places of the particles and at that
/// time, and `decay`: root of the kinetic energy by that at the start.
Observer<2> compare_with_exact(const ExactFlow& exact);

/// Decay and errors against time, and configurations of flows of one size.
void draw(Session& session, const Parameters& p, const std::vector<Flow>& flows,
          const std::vector<RunRecord>& runs);

}  // namespace taylor_green
