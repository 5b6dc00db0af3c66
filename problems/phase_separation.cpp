// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a van der Waals fluid parts into liquid and vapour, [HH01]; 20 s
//
// "Phase-separating fluids", [HH01]: particles of mass 1 on a square lattice in a periodic box, each moved by up to
// `disorder`, whose density is between those at which van der Waals' fluid is stable. They move by the free energy at
// one temperature,
//
//     o  o  o  o  o          ooo      o         m v_dot_i = -d Phi/d r_i - m gamma v_i,   Phi = sum_i m e(rho_i)
//     o  o  o  o  o          oooo               e = -T ln((1 - b rho)/(b rho)) - a rho
//     o  o  o  o  o   ->   oooooo     o         P = rho^2 de/d rho = rho T/(1 - b rho) - a rho^2
//     o  o  o  o  o        ooooo    o
//     o  o  o  o  o         oo                  a = 9/8, b = 1/3: critical density and temperature are 1
//
// and should end as liquid and vapour of the densities that Maxwell's construction says: those of equal pressure and
// chemical potential, e + P/rho. Densities are those of the smoothed field, farther than the range from the boundary.
// domain_size: area by length of the boundary, on which the field is the critical density. mean_wavelength: 2 pi by the
// mean wave number of the field.
//
//     --compare       T = 0.8, 0.85 and 0.9, beside the curve of coexistence; 1 min
//     --damping 0 --samples 5
//                     domains grow as t^p, measured from t = 40 to 113 without friction, by five seeds; 1 min. Inertia
//                     and surface tension alone would give 2/3; a proof would take a decade more. p also depends on
//                     how early domains are there: 0.80 with --disorder 0.02, 0.63 with 0.2
//     --wave M        one wave, M of it along the box, on a perfect lattice. Its amplitude grows as cosh(s t), beside
//                         s^2 = -(e'' G^2 + 2 e' J),   G = sum_j w'(r) (x/r) sin kx,   J = sum_j w_xx (1 - cos kx)
//                     by sums over the lattice, and by integrals: G = -rho k W, J = rho k^2 W, W the transform of w
//     --isolated      the full law, e = T - a rho, with an energy equation, viscosity and conduction by pairs: the
//                     fluid warms up while it parts, until energy and Maxwell's construction agree
//
// Strong friction (--damping 0.1) stops particles before domains have grown, and the vapour is too dense. At rest no
// particle crosses a surface: slabs that start from other densities get equal pressures, but keep their masses.
#include "phase_separation/separation.hpp"

namespace {

using namespace phase_separation;

void add_options(Options& options, Parameters& p) {
    options.integer(
        "cells", p.cells,
        "particles along each side of the periodic box (40 with --wave, 48 with --isolated)",
        between(6, 1000));
    p.add_options(options);
    options.number("density", p.density, "mean density, by the critical one", positive());
    options.integer("wave", p.wave,
                    "grow one wave of a perfect lattice: so many wavelengths along the box",
                    between(1, 500));
    options.flag(
        "isolated", p.isolated,
        "an energy equation with viscosity and conduction in place of a constant temperature");
    options.flag("compare", p.compare, "compute three temperatures: 0.8, 0.85 and 0.9");
    options.number("damping", p.damping,
                   "rate of the friction that takes the heat of separation, gamma; 0 for none",
                   between(0.0, 100.0));
    add_disorder_options(options, p.disorder, p.seed,
                         "largest random displacement from the lattice, in spacings", 0.5, "0.02");
    options.integer("samples", p.samples,
                    "number of runs, of seeds one after the other (default: 1)", between(1, 25));
    options.number("viscosity", p.viscosity, "shear viscosity", between(0.0, 100.0));
    options.number("conductivity", p.conductivity, "heat conductivity", between(0.0, 100.0));
    options.only_when(
        {"viscosity", "conductivity"}, {"isolated"}, [&p] { return p.isolated; },
        "has no meaning at constant temperature; give --isolated, which has the full law and an "
        "energy equation");
    options.exclude("isolated", {"damping", "wave", "compare"},
                    "has no meaning with {by}, which keeps its energy; leave one out");
    options.exclude("wave", {"damping", "disorder", "seed", "samples", "compare"},
                    "has no meaning with {by}, one wave of a perfect lattice; leave one out");
    options.exclude("compare", {"temperature", "samples"},
                    "has no effect with {by}, which has three temperatures; leave one out");
}

/// Of a case among others, where it is not given.
void settle(const Session& session, Parameters& p) {
    const auto usual = [&](const char* option, auto& value, auto other) {
        if (!session.given(option)) value = other;
    };
    if (p.wave) usual("cells", p.cells, 40);
    if (p.isolated) {
        usual("cells", p.cells, 48);
        usual("range", p.range, 3.0);
        usual("temperature", p.temperature, 0.25);
    }
    if (session.common().smoke) usual("cells", p.cells, 20);
}

void refuse_impossible(const Parameters& p) {
    if (!(p.density < 1.0 / van_der_waals_b))
        refuse(
            "density: {:g} is not below 1/b = {:g}, which van der Waals' fluid cannot reach; "
            "give less",
            p.density, 1.0 / van_der_waals_b);
    if (!(p.range > p.spacing()))
        refuse(
            "range: {:g} must lie above the spacing {:.3g} (else no particle has a neighbour); "
            "3 to 4 spacings are usual",
            p.range, p.spacing());
    if (!(p.box().length(0) > 2.0 * p.range))
        refuse(
            "cells: a box of side {:g} is not wider than twice the range {:g}; give more --cells or a "
            "shorter --range",
            p.box().length(0), p.range);
    if (!p.wave && !p.compare) refuse_stable(p);
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("phase_separation", "van der Waals' fluid parts into liquid and vapour, [HH01]",
                    0.1);
    problem.units(van_der_waals_units());
    Parameters p;
    add_options(problem.options(), p);
    return problem.main(argc, argv, [&](Session& session) {
        settle(session, p);
        refuse_impossible(p);
        if (p.isolated) session.prefer_step(0.05);
        p.wave ? grow_wave(session, p) : quench(session, p);
    });
}
