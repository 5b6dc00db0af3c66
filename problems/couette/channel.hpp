// SPDX-License-Identifier: GPL-3.0-or-later
// A viscous fluid between two parallel plates, driven by one that moves (couette) or by a force along them
// (poiseuille): what the two problems share.
#pragma once

#include "../common.hpp"

namespace channel {

using namespace spam;

enum class Drive { plate, force };
struct Parameters {
    const Sides* sides = nullptr;
    int cells = 20;          // particles from plate to plate, at spacing 1
    double speed = 0.1;      // of the plate, or in the middle of the finished flow; sound: 1
    double reynolds = 10.0;  // speed cells/nu
    bool compare = false;
    FrictionBy friction = FrictionBy::pairs;
    Scheme scheme{.density = Density::continuity, .kernel = Kernel::w4, .range = 4.0};
};

/// The flow of an incompressible fluid that was at rest at t = 0 between plates at y = 0 and y = H.
struct ExactFlow {
    Drive drive;
    double H, nu, speed;

    /// Of the fluid along the plates. Fourier's series of the start-up on top of the finished flow, u = V y/H
    /// or 4 U (y/H)(1 - y/H).
    double velocity(double y, double t) const;
    /// After that long nothing changes by more than 1e-4.
    double time() const { return H * H / nu; }
    /// Force of the finished flow on it by one plate, along the plates, by their length.
    double stress(bool upper) const {
        if (drive == Drive::plate) return (upper ? 1.0 : -1.0) * nu * speed / H;
        return -4.0 * nu * speed / H;
    }
};

struct Flow : Variant<2> {
    ExactFlow exact{};
    bool known = true;  ///< the sides are those of the exact flow
};

/// cells x cells particles of the fluid P = rho^2/2 with Newton's viscosity, density and sound speed 1, on a
/// square lattice, at rest, between sides as options say: plates below and above and periods along them.
Flow make_flow(const Parameters& p, Drive drive, int cells, bool only_described);

/// The whole of a problem's main().
int main_of(int argc, char** argv, const std::string& name, const std::string& summary,
            Drive drive);

}  // namespace channel
