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
#include <spam/analysis/lattice_modes.hpp>
#include <spam/analysis/periodic_solid.hpp>
#include <spam/analysis/wave_vectors.hpp>
#include <spam/io/csv.hpp>
#include <spam/picture/draw.hpp>
#include <spam/spam.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace spam;
using std::numbers::pi;

constexpr double noise = 1e-5;  // rates below are round-off: square roots of what should be zero

struct Parameters {
    double stress = 0.02;
    int cells = 24;
};

/// What the analysis says at some wave vectors.
struct Spectrum {
    Points<2> k;
    std::vector<double> growth, low_frequency, high_frequency;

    std::size_t fastest() const {
        return static_cast<std::size_t>(
            std::distance(growth.begin(), std::max_element(growth.begin(), growth.end())));
    }
};

struct Analysed {
    std::string label, title;
    Scheme scheme;
    Spectrum path, sample;
    double transverse_speed = 0.0, longitudinal_speed = 0.0;  // of long waves
};

std::string_view title_of(Transport transport) {
    return transport == Transport::plain     ? "plain v"
           : transport == Transport::average ? "⟨v⟩"
                                             : "⟨v⟩ Monaghan";
}

std::vector<Analysed> schemes_to_compare(const Scheme& scheme, bool single) {
    std::vector<Analysed> all;
    if (single) {
        all.push_back({"", std::string(title_of(scheme.transport)), scheme, {}, {}});
        return all;
    }
    for (const auto transport : {Transport::plain, Transport::average, Transport::monaghan}) {
        Scheme other = scheme;
        other.transport = transport;
        all.push_back(
            {std::string(to_string(transport)), std::string(title_of(transport)), other, {}, {}});
    }
    return all;
}

// ---- the lattice ----

/// A lattice just wide enough for the analysis tells the modes of samples of any size.
LatticeModes<2> analyse(const Parameters& p, const Scheme& scheme, RunStatistics& statistics) {
    const auto solid = smallest_triangular_solid(ElasticSolid::triangular_lattice(), scheme,
                                                 std::sqrt(4.0 / 3.0), p.stress);
    LatticeModes<2> modes(*solid.model, solid.y0);
    statistics.particles = solid.model->particles().size();
    statistics.rhs_evaluations += modes.rhs_evaluations();
    statistics.pair_interactions += modes.rhs_evaluations() * solid.model->pairs();
    return modes;
}

Spectrum spectrum(const LatticeModes<2>& modes, const Points<2>& k) {
    Spectrum result;
    result.k = k;
    for (const auto& wave : k.colwise()) {
        const auto omega = modes.frequencies(wave);
        const double growth = modes.growth_rate(wave);
        result.growth.push_back(growth > noise ? growth : 0.0);
        result.high_frequency.push_back(omega[0]);
        result.low_frequency.push_back(omega[1]);
    }
    return result;
}

/// omega/k of a wave of a hundred spacings along the rows.
double sound_speed(const LatticeModes<2>& modes, const Point<2>& direction) {
    const Point<2> k(2.0 * pi / 100.0, 0.0);
    return modes.frequency(k, direction) / k.norm();
}

// ---- what was found ----

void write_spectrum(const RunFolder& folder, const std::string& name, const Spectrum& spectrum,
                    const std::vector<double>& distance) {
    std::vector<std::string> names{"k_x", "k_y", "growth_rate", "low_frequency", "high_frequency"};
    if (!distance.empty()) names.insert(names.begin(), "distance");
    CsvWriter csv(folder / name, names);
    for (std::size_t s = 0; s < spectrum.growth.size(); ++s) {
        const auto column = static_cast<Eigen::Index>(s);
        std::vector<double> row{spectrum.k(0, column), spectrum.k(1, column), spectrum.growth[s],
                                spectrum.low_frequency[s], spectrum.high_frequency[s]};
        if (!distance.empty()) row.insert(row.begin(), distance[s]);
        csv.add(row);
    }
}

void report(Session& session, const Parameters& p, const Analysed& one) {
    const std::string prefix = one.label.empty() ? "" : one.label + "_";
    const auto measured = [&](const char* name, double value) {
        session.measure(prefix + name, value);
    };
    const std::size_t fastest = one.sample.fastest();
    const double growth = one.sample.growth[fastest];
    const Point<2> k = one.sample.k.col(static_cast<Eigen::Index>(fastest));
    if (p.stress == 0.0)
        session.check({prefix + "growth_rate", growth, 0.0, noise, "nothing pulls, [HHM04] IV"});
    else
        measured("growth_rate", growth);
    if (growth > 0.0) {
        measured("growth_time", 1.0 / growth);
        measured("fastest_k_x", k.x());
        measured("fastest_k_y", k.y());
    }
    measured("growth_rate_on_path", one.path.growth[one.path.fastest()]);
    const auto growing = std::count_if(one.sample.growth.begin(), one.sample.growth.end(),
                                       [](double g) { return g > 0.0; });
    measured("growing_wave_vectors", static_cast<double>(growing));
    // Elasticity is what long waves see, up to the stress itself and to sums in place of integrals.
    const double tolerance = 0.01 + 2.0 * std::abs(p.stress);
    const bool reaches =
        one.scheme.kernel == Kernel::lucy && one.scheme.range >= 2.5 && one.scheme.range <= 4.0;
    const auto claim = [&](const char* name, double value, double c) {
        if (reaches)
            session.check({prefix + name, value, c, tolerance * c, "[HHM04] V, linear elasticity"});
        else
            measured(name, value);
    };
    claim("transverse_speed", one.transverse_speed, std::sqrt(3.0 / 8.0));
    claim("longitudinal_speed", one.longitudinal_speed, std::sqrt(9.0 / 8.0));
}

void print_table(Session& session, const std::vector<Analysed>& all) {
    session.terminal().say("");
    session.terminal().say(fmt::format("{:<14}{:>12}{:>12}   {}", "velocity", "growth rate",
                                       "growth time", "fastest wave vector of the sample"));
    for (const auto& one : all) {
        const std::size_t s = one.sample.fastest();
        const Point<2> k = one.sample.k.col(static_cast<Eigen::Index>(s));
        session.terminal().say(
            one.sample.growth[s] > 0.0
                ? fmt::format("{:<14}{:>12.6f}{:>12.1f}   ({:.4f}, {:.4f}), wavelength {:.3f}",
                              to_string(one.scheme.transport), one.sample.growth[s],
                              1.0 / one.sample.growth[s], k.x(), k.y(), 2.0 * pi / k.norm())
                : fmt::format("{:<14}{:>12}{:>12}   nothing grows", to_string(one.scheme.transport),
                              0, "-"));
    }
}

/// The border of the first zone: six corners at the distance 4 pi/3.
Points<2> zone_border() {
    Points<2> corners(2, 6);
    for (int c = 0; c < 6; ++c)
        corners.col(c) = 4.0 * pi / 3.0 * Point<2>(std::cos(c * pi / 3.0), std::sin(c * pi / 3.0));
    return corners;
}

void draw(Session& session, const Parameters& p, const WavePath& path,
          const std::vector<Analysed>& all) {
    const auto folder = session.plots_folder();
    CurvePanel frequency{"frequencies (dashed: the slower branch)", "wave vector", "ω", false, {}};
    CurvePanel growth{"growth", "wave vector", "growth rate", false, {}};
    for (const auto& corner : path.corners) {
        frequency.x_ticks.push_back({corner.distance, corner.name});
        growth.x_ticks.push_back({corner.distance, corner.name});
    }
    for (std::size_t n = 0; n < all.size(); ++n) {
        const Spectrum& s = all[n].path;
        frequency.curves.push_back({all[n].title, path.distance, s.high_frequency});
        frequency.curves.push_back({.title = "",
                                    .x = path.distance,
                                    .y = s.low_frequency,
                                    .like = static_cast<int>(n) + 1});
        growth.curves.push_back({all[n].title, path.distance, s.growth});
    }
    session.note_drawn(draw_curves(folder, "dispersion",
                                   fmt::format("Triangular lattice under stress {:g}", p.stress),
                                   {frequency, growth}));
    std::vector<ConfigurationPanel> panels;
    for (const auto& one : all) {
        const double largest = one.sample.growth[one.sample.fastest()];
        std::vector<double> share = one.sample.growth;
        for (double& g : share) g = largest > 0.0 ? g / largest : 0.0;
        panels.push_back({fmt::format("{}: largest {:.4f}", one.title, largest),
                          one.sample.k,
                          share,
                          {zone_border()}});
    }
    session.note_drawn(draw_configurations(
        folder, "growth_rates",
        fmt::format("Wave vectors of {0} × {0} particles under stress {1:g}", p.cells, p.stress),
        panels, panels.size(), "growth rate / largest"));
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("stability",
                    "linear stability of a lattice under hydrostatic stress, [HHM04] IV");
    Parameters p;
    auto& options = problem.options();
    options.number("stress", p.stress, "hydrostatic stress; tension is positive",
                   between(-1.0, 1.0));
    options.integer("cells", p.cells, "the sample is cells x cells particles (an even number)",
                    between(2, 400));
    problem.use_scheme();
    const auto never = [] { return false; };
    options.only_when({"closest-approach"}, {}, never,
                      "has no effect in a linear analysis, where nothing is reflected; leave it "
                      "out");
    options.only_when({"mean-density"}, {}, never,
                      "both means are the same to first order about a lattice of equal densities; "
                      "leave it out");
    // Without any of these several schemes are compared.
    options.only_when(Problem::scheme_option_names(), {},
                      [&] { return !options.first_given(Problem::scheme_option_names()).empty(); },
                      {});

    return problem.main(argc, argv, [&](Session& session) {
        if (session.common().smoke && !session.given("cells")) p.cells = 8;
        const Box<2> box = triangular_box(p.cells, p.cells);
        const bool single = !options.first_given(Problem::scheme_option_names()).empty();
        auto all = schemes_to_compare(session.scheme(), single);
        RunStatistics unused;
        for (const auto& one : all)
            analyse(p, one.scheme, unused);  // refused before anything is written

        std::vector<std::string> lines{
            fmt::format("lattice     triangular, spacing 1, hydrostatic stress {:g}", p.stress),
            fmt::format("sample      {0} x {0} particles, {1} wave vectors", p.cells,
                        p.cells * p.cells)};
        for (const auto& one : all)
            lines.push_back(fmt::format("scheme      {}", one.scheme.describe()));
        RunStatistics& statistics = session.begin_analysis(lines);

        const WavePath path = triangular_path(400);
        Points<2> k = allowed_wave_vectors<2>(box, {p.cells, p.cells});
        for (Eigen::Index n = 0; n < k.cols(); ++n) k.col(n) = first_zone(k.col(n));
        for (auto& one : all) {
            const auto modes = analyse(p, one.scheme, statistics);
            one.path = spectrum(modes, path.k);
            one.sample = spectrum(modes, k);
            one.transverse_speed = sound_speed(modes, {0.0, 1.0});
            one.longitudinal_speed = sound_speed(modes, {1.0, 0.0});
            const std::string suffix = one.label.empty() ? ".csv" : "_" + one.label + ".csv";
            write_spectrum(session.folder(), "dispersion" + suffix, one.path, path.distance);
            write_spectrum(session.folder(), "sample" + suffix, one.sample, {});
            report(session, p, one);
        }
        print_table(session, all);
        if (session.plots()) draw(session, p, path, all);
    });
}
