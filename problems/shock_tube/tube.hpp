// SPDX-License-Identifier: GPL-3.0-or-later
// The gas of shock_tube at the start, and how far it is from the exact solution in the end.
#pragma once

#include "../common.hpp"
#include "riemann.hpp"

#include <thread>

namespace shock_tube {

using namespace spam;

/// Two gases beside each other, and how they are computed unless options say otherwise.
struct Setting {
    std::string title;
    GasState left, right;
    double t_end;
    double range = 10.0;  ///< in spacings
    double viscosity = 1.0;
    bool resolved = true;  ///< particles are near enough everywhere for what is claimed
};

/// Sod's, which is --toro 1 to a later time.
const Setting& sod();
/// Number 1 to 5 of Toro's book, table 4.1, t as in its figures.
const Setting& toro(int number);
inline constexpr int toro_tests = 5;

struct Parameters {
    const Sides* sides = nullptr;
    std::optional<int> toro;
    Setting setting = sod();
    int cells = 800;
    double gamma = 1.4;
    bool single = false, compare = false;
    int jobs = all_cores();
    Scheme scheme{
        .density = Density::continuity, .viscosity = 1.0, .kernel = Kernel::w4, .range = 10.0};

    /// What was not given: by the setting.
    void settle(const Session& session);
    /// Whether the scheme is that of which something is claimed, to this part.
    bool standard(const Session& session) const;
    double tolerance() const { return toro ? 0.03 : 0.02; }

    /// A step of rk4 for so many particles: a tenth of the spacing by a speed of the gases.
    double step(int particles) const;
};

struct Tube : Variant<1, FluidModel<1>> {
    int cells;       ///< from -1/2 to 1/2
    int extra_left;  ///< and beyond, so that what the ends do to a gas that streams does not come back
    int extra_right;
    RiemannProblem exact;

    int particles() const { return extra_left + cells + extra_right; }
};

/// `cells` particles from -1/2 to 1/2. Without y0 where it is only described.
Tube make_tube(const Parameters& p, int cells, bool only_described);

/// What is compared with the exact solution.
inline constexpr std::array quantities{"density", "velocity", "pressure", "energy"};

/// One of them, of all particles in the order of their numbers, and exactly.
std::vector<double> found(const Tube& tube, std::span<const double> y, std::size_t quantity);
double exact_value(const Tube& tube, double gamma, std::size_t quantity, double x, double t);

/// Mean |rho - exact| over the particles from -1/2 to 1/2.
double density_error(const Tube& tube, std::span<const double> y, double t);

/// The integral of |found - exact| from -1/2 to 1/2, particles being m/rho wide.
double integral_error(const Tube& tube, double gamma, std::size_t quantity,
                      std::span<const double> y, double t);

/// A value that is constant between two waves: exact, and the median of the particles in the middle half of
/// what lies between them; NaN where there are none.
struct Plateau {
    std::string name;
    double exact, found;
    double scale;  ///< what it is right to a part of
};
/// Density behind the left and the right wave, pressure, velocity; none where there is a vacuum.
std::vector<Plateau> plateaus(const Tube& tube, double gamma, std::span<const double> y, double t);

}  // namespace shock_tube
