// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: which potentials of the density hold a lattice together, [HH07] 8; 50 s
//
// Which potentials of the density hold a lattice together, [HH07] 8.
//
//       o   o   o   o        A periodic lattice of smooth particles, triangular or square, spacing 1,
//         o   o   o          moves like molecules with the potential
//       o   o   o   o
//         o   o   o              Phi = sum e(rho),   e = (rho/rho0 - 1)^2/(2 rho0)
//                                    + s_c sum ((rho_xx - rho_yy)^2 + 4 rho_xy^2)    curvature
//                                    + s_g sum |grad rho|^2                          gradient
//
// of densities summed with w(r), free of pressure: rho0 is what particles sum to at a site.
// 1. At rest. Eigenvalues of the second derivatives of Phi, and elastic moduli. With e(rho) alone more
//    than half of all directions cost nothing, and the shear modulus is exactly zero; curvature gives
//    strength; gradients leave no zero modes but the two translations, yet give no strength.
// 2. In motion. Particles with small random velocities leave their sites for good with e(rho) alone:
//    the lattice melts, and so it does with gradients, in spite of its two zero modes. Curvature holds
//    it. Their paths, as on the slide.
// With --potential one lattice under one choice of potentials is analysed, and nothing moves.
#include "lattice_stability/motion.hpp"
#include "lattice_stability/strength.hpp"
#include <spam/kernel/kernel.hpp>

#include <cmath>

namespace {

using namespace lattice_stability;

// rk4 takes omega t (omega dt)^5/72 of the energy of a vibration: with the fastest, omega = 1.42 of both
// potentials, 2e-6 until t = 600, and less than 1e-6 of all of it. dt = 0.05 would be too long.
constexpr double step = 0.03, omega_dt = 0.043;
constexpr double range_of_dynamics = 3.25, range_of_one_case = 2.5;

/// Steeper weights, shorter ranges and stronger potentials make faster vibrations. Those of a sample just wide
/// enough for the range are as fast as those of the crystal.
double step_of(Parameters p) {
    p.cells = std::min(p.cells, 2 * static_cast<int>(std::ceil(1.2 * *p.range)) + 2);
    const auto all = analyse(p, p.lattice, Acting::both, *p.range).spectrum.eigenvalue;
    return std::min(step, omega_dt / std::sqrt(all.back()));
}

/// With --potential one lattice is analysed: nothing moves, and potentials that do not act have no
/// strength.
void add_rules(Options& options, const Parameters& p) {
    const auto one = [&options] { return options.given("potential"); };
    options.only_when({"potential"}, {}, one, {});
    const std::string why =
        "has no meaning with {by} (nothing moves, and only what is named acts); leave it out";
    options.only_when(
        {"strength"}, {"potential"}, [&p, one] { return !one() || has_curvature(p.acting); }, why);
    options.only_when(
        {"surface-tension"}, {"potential"}, [&p, one] { return !one() || has_gradient(p.acting); },
        why);
    options.exclude("potential", {"block", "speed", "seed"}, why);
}

void analyse_one(Session& session, Parameters& p) {
    if (!p.range) p.range = range_of_one_case;
    refuse_meaningless(p, p.lattice, p.acting, *p.range);
    session.begin_analysis(
        {fmt::format("particles   {0} x {0}, {1} lattice, periodic", p.cells, to_string(p.lattice)),
         fmt::format("potentials  {}", p.potentials(p.lattice, p.acting, *p.range).describe())});
    const std::vector<Analysed> one{analyse(p, p.lattice, p.acting, *p.range)};
    print_table(session, one);
    write_spectra(session.folder(), one);
    report(session, p, one.front(), "");
    if (session.plots()) draw_spectra(session, p, one, *p.range);
}

/// [HH07] 8 of 144 particles of the triangular lattice: whether it melts. Free flight would take them 6
/// spacings far in this time.
void check_motion(Session& session, const Parameters& p, const std::vector<Sample>& samples,
                  const std::vector<RunRecord>& runs) {
    const bool known = session.when_default(
        {"lattice", "kernel", "block", "speed", "strength", "surface-tension", "misfit"});
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const Acting acting = samples[k].acting;
        const Findings findings(session, samples[k].prefix);
        const History& h = runs[k].history;
        const bool melts = acting == Acting::density;
        findings.claim("rms_displacement", h.last("rms_displacement"), melts ? 3.5 : 0.0,
                       melts ? 2.0 : 0.15,
                       melts ? "[HH07] 8: melts; above 1.5 spacings"
                             : "[HH07] 8: is held; below 0.15 spacings",
                       known && *p.range == range_of_dynamics && h.last("t") == 600.0 &&
                           (melts || acting == Acting::both));
        findings.check_promises(runs[k]);
    }
}

void table_and_motion(Session& session, Parameters& p) {
    // A range that was given is the only one.
    const std::vector<double> ranges =
        p.range ? std::vector{*p.range} : std::vector{2.5, 3.0, range_of_dynamics, 3.5};
    if (!p.range) session.leave_out_of_case({"range"});  // several
    if (!p.range) p.range = range_of_dynamics;
    for (const auto lattice : {LatticeKind::triangular, LatticeKind::square})
        for (const double h : ranges) refuse_meaningless(p, lattice, Acting::both, h);

    refuse_narrow("block", p.lattice, p.block, *p.range);
    session.prefer_step(step_of(p));
    std::vector<Sample> samples;
    for (const Acting acting : all_potentials) samples.push_back(make_sample(p, acting, *p.range));
    const auto runs = run_all(session, samples, [&](Sample& sample) {
        Plan<2> plan;
        const bool smoke = session.common().smoke;
        plan.t_end = smoke ? 3.0 : 600.0;
        plan.snapshot_every = plan.t_end / (smoke ? 20.0 : 200.0);
        const auto follow = [&sample](double, const Model<2>& model, std::span<const double> y) {
            sample.paths.at.push_back(ConstState<2>(model.layout(), y).position());
        };
        plan.observe({.columns = {rms_displacement_column()},
                      .on_snapshot = follow,
                      .memory = [&sample](Archive& archive) { archive(sample.paths); }});
        return plan;
    });
    if (runs.size() < samples.size() || !runs.back().complete) return;

    std::vector<Analysed> all;
    session.evaluate([&] { all = analyse_all(p, ranges); });
    print_table(session, all);
    write_spectra(session.folder(), all);
    for (const auto& one : all)
        report(
            session, p, one,
            fmt::format("{}_{}_h{:g}_", to_string(one.acting), to_string(one.lattice), one.range));
    for (const auto& one : all)
        if (one.lattice == p.lattice && one.range == *p.range)
            session.measure(fmt::format("{}_fastest_vibration", to_string(one.acting)),
                            std::sqrt(one.spectrum.eigenvalue.back()), "omega, measured");
    check_motion(session, p, samples, runs);
    if (!session.plots()) return;
    draw_modes(session, p, all);
    draw_spectra(session, p, all, *p.range);
    draw_paths(session, p, samples, runs.front().history.last("t"));
    draw_displacements(session, samples, runs);
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("lattice_stability",
                    "which potentials of the density hold a lattice together, [HH07] 8", step,
                    "0.03, shorter with steeper weights or stronger potentials");
    problem.units(fluid_units());
    Parameters p;
    auto& options = problem.options();
    options.choice<LatticeKind>("lattice", p.lattice,
                                {LatticeKind::triangular, LatticeKind::square},
                                "the lattice that moves, or that --potential analyses");
    options.choice<Acting>("potential", p.acting, all_potentials,
                           "analyse one lattice only, under e(rho) alone (density), with the "
                           "curvature or the gradient potential, or with both");
    options.choice<Kernel>("kernel", p.kernel, all_kernels(), "weight function");
    options.number("range", p.range,
                   "range h of the weight function, in spacings (default: 2.5, 3, 3.25 and 3.5 for "
                   "the table, 3.25 for the motion, 2.5 with --potential)",
                   between(1.05, 50.0));
    options.number("strength", p.strength, "s_c of the curvature potential", between(1e-6, 1e6));
    options.number("surface-tension", p.surface_tension, "s_g of the gradient potential",
                   between(1e-6, 1e6));
    options.number("misfit", p.misfit,
                   "rest density of the law, divided by the density at a site of the lattice",
                   between(0.5, 2.0));
    options.integer("cells", p.cells,
                    "the lattice at rest has cells x cells particles (an even number)",
                    {[](double n) { return n >= 4.0 && n <= 24.0 && std::fmod(n, 2.0) == 0.0; },
                     "an even number between 4 and 24 (a matrix of 2 cells x cells squared)"});
    options.integer("block", p.block,
                    "the moving lattice has block x block particles (an even number)",
                    {[](double n) { return n >= 4.0 && n <= 400.0 && std::fmod(n, 2.0) == 0.0; },
                     "an even number between 4 and 400"});
    options.number("speed", p.speed, "root mean square of the random initial velocities",
                   between(1e-6, 0.3));
    options.integer("seed", p.seed, "seed of the random initial velocities", between(0.0, 1e9));
    add_rules(options, p);

    return problem.main(argc, argv, [&](Session& session) {
        if (session.given("potential")) return analyse_one(session, p);
        if (session.common().smoke && !p.range) p.range = 2.2;
        session.smoke_default("cells", p.cells, 6);
        session.smoke_default("block", p.block, 6);
        table_and_motion(session, p);
    });
}
