// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: linear stability of a stretched lattice: growth rates and dispersion, [HHM04] IV; 1 s
//
// Linear stability of a stretched lattice, [HHM04] IV.
//
//       o   o   o   o        A triangular lattice of smooth particles, spacing 1, at rest under
//         o   o   o          hydrostatic stress s (tension: s > 0). Small disturbances are waves
//       o   o   o   o        exp(rate t + i k . r): their frequency is Im rate, and where Re rate is
//         o   o   o          positive they grow. Nothing is integrated here.
//
//     z = (x, v, [rho], sigma),   z_dot = J(k) z,   J(k) = sum_j J_j0 exp(-i k . (r_j - r_0))
//
// Attraction between neighbours, -s grad w, makes short waves grow ("tensile instability"). They do
// so with averaged velocities too, but an order of magnitude slower: <v> hardly moves particles in
// a wave as short as two spacings. Compression makes plain velocities grow as well, more slowly,
// and averaged ones not at all. Shown are the way Gamma - K - M - Gamma through the wave vectors
// and all wave vectors of a periodic sample of cells x cells particles.
// Without scheme options it compares the plain velocity, <v> and <v>_Monaghan.
//
// --dimension 3 --lattice sc, fcc or bcc: cubic lattices in space, and of all waves the fastest, by a climb from a grid
// over the symmetric part of the zone (stability/space.cpp).
//
// --formulation material_vectors: a solid whose particles remember a material vector for each neighbour, under
// stress, which may have a shear part (--shear-stress). Its K(k), m omega^2 u = K(k) u, is Hermitian: a wave
// grows or oscillates, and none does neither but translations. Without --penalty or --memoryless it compares
// penalties kappa and the scheme without its memory, whose vectors are X = F^-1 r at all times.
#include "stability/lattice.hpp"

namespace stability {
namespace {

using std::numbers::pi;

Spectrum spectrum(const Waves& waves, const Points<2>& k) {
    Spectrum result;
    result.k = k;
    for (const auto& free : k.colwise()) {
        const Point<2> wave = waves.strained * free;
        const auto omega = waves.frequencies(wave);
        const double growth = waves.growth_rate(wave);
        result.growth.push_back(growth > waves.noise ? growth : 0.0);
        result.high_frequency.push_back(omega[0]);
        result.low_frequency.push_back(omega[1]);
    }
    return result;
}

/// omega/k of a wave of a hundred spacings along the rows.
double sound_speed(const Waves& waves, const Point<2>& direction) {
    const Point<2> k(2.0 * pi / 100.0, 0.0);
    return waves.frequency(k, direction) / k.norm();
}

double lowest_by_elastic(const Waves& waves, const Spectrum& sample) {
    double lowest = HUGE_VAL;
    for (std::size_t n = 0; n < sample.growth.size(); ++n) {
        const Point<2> k = waves.strained * sample.k.col(static_cast<Eigen::Index>(n));
        if (k.norm() > 1e-9)  // translations
            lowest = std::min(lowest, sample.low_frequency[n] / (std::sqrt(3.0 / 8.0) * k.norm()));
    }
    return lowest;
}

/// What means nothing beside what.
void add_rules(Options& options, const Parameters& p) {
    const auto never = [] { return false; };
    options.only_when({"closest-approach"}, {}, never,
                      "has no effect in a linear analysis, where nothing is reflected; leave it "
                      "out");
    options.only_when({"mean-density"}, {}, never,
                      "both means are the same to first order about a lattice of equal densities; "
                      "leave it out");
    auto smooth = Problem::scheme_option_names();
    smooth.push_back("kernel");
    options.only_when(
        smooth, {"formulation"}, [&p] { return !p.vectors(); },
        "has no meaning for --formulation material_vectors; leave it out");
    options.only_when(
        {"penalty", "shear-stress", "memoryless"}, {"formulation"}, [&p] { return p.vectors(); },
        "has a meaning for --formulation material_vectors alone; leave it out");
    options.exclude("memoryless", {"penalty"},
                    "has no meaning with --memoryless, which leaves no misfit; leave one out");
    options.only_when(
        {"cells", "formulation", "penalty", "shear-stress", "memoryless"}, {"dimension"},
        [&p] { return p.dimension == 2; }, "has no meaning with --dimension 3; leave it out");
    // Without any of these several schemes are compared.
    options.only_when(Problem::scheme_option_names(), {},
                      [&] { return !options.first_given(Problem::scheme_option_names()).empty(); },
                      {});
}

}  // namespace

std::size_t Spectrum::fastest() const {
    return static_cast<std::size_t>(
        std::distance(growth.begin(), std::max_element(growth.begin(), growth.end())));
}

}  // namespace stability

int main(int argc, char** argv) {
    using namespace stability;
    Problem problem("stability",
                    "linear stability of a lattice under hydrostatic stress, [HHM04] IV");
    problem.units(lattice_units());
    Parameters p;
    auto& options = problem.options();
    options.number("stress", p.stress, "hydrostatic stress; tension is positive",
                   between(-1.0, 1.0));
    options.integer("cells", p.cells, "the sample is cells x cells particles (an even number)",
                    between(2, 400));
    options.choice<Formulation>("formulation", p.formulation,
                                {Formulation::updated, Formulation::material_vectors},
                                "smooth particles, or a solid with material vectors");
    options.number("penalty", p.penalty,
                   "penalty kappa of material_vectors (several are compared without it)",
                   between(0.0, 100.0));
    options.number("shear-stress", p.shear_stress,
                   "shear stress besides the hydrostatic one (material_vectors)",
                   between(-1.0, 1.0));
    options.flag("memoryless", p.memoryless,
                 "material_vectors without their memory: vectors are renewed all the time");
    add_lattice_options(
        options, p.dimension, p.lattice,
        "2: the triangular lattice; 3: a cubic one, with stresses 0.01 and 0.02 unless --stress says another");
    problem.use_scheme();
    add_rules(options, p);

    return problem.main(argc, argv, [&](Session& session) {
        if (p.dimension == 3)
            return analyse_in_space(session, p,
                                    !options.first_given(Problem::scheme_option_names()).empty());
        session.smoke_default("cells", p.cells, 8);
        const Box<2> box = triangular_box(p.cells, p.cells);
        const bool single = p.vectors()
                                ? p.penalty || p.memoryless
                                : !options.first_given(Problem::scheme_option_names()).empty();
        auto all = p.vectors() ? material_vectors(p, session.scheme().range, single)
                               : smooth_particles(p, session.scheme(), single);
        RunStatistics unused;
        for (const auto& one : all) one.analyse(unused);  // refused before anything is written

        std::vector<std::string> lines{
            fmt::format("lattice     triangular, spacing 1, hydrostatic stress {:g}", p.stress),
            fmt::format("sample      {0} x {0} particles, {1} wave vectors", p.cells,
                        p.cells * p.cells)};
        if (p.shear_stress != 0.0) lines[0] += fmt::format(", shear stress {:g}", p.shear_stress);
        for (const auto& one : all) lines.push_back("scheme      " + one.description);
        RunStatistics& statistics = session.begin_analysis(lines);

        const WavePath path = triangular_path(400);
        Points<2> k = allowed_wave_vectors<2>(box, {p.cells, p.cells});
        for (Eigen::Index n = 0; n < k.cols(); ++n) k.col(n) = first_zone(k.col(n));
        for (auto& one : all) {
            const Waves waves = one.analyse(statistics);
            one.noise = waves.noise;
            one.path = spectrum(waves, path.k);
            one.sample = spectrum(waves, k);
            one.transverse_speed = sound_speed(waves, {0.0, 1.0});
            one.longitudinal_speed = sound_speed(waves, {1.0, 0.0});
            one.lowest = lowest_by_elastic(waves, one.sample);
            const std::string suffix = one.label.empty() ? ".csv" : "_" + one.label + ".csv";
            write_spectrum(session.folder(), "dispersion" + suffix, one.path, path.distance);
            write_spectrum(session.folder(), "sample" + suffix, one.sample, {});
            report(session, p, one);
        }
        print_table(session, p, all);
        if (session.plots()) draw(session, p, path, all);
    });
}
