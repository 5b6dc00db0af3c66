// SPDX-License-Identifier: GPL-3.0-or-later
// Tables and pictures of what was found.
#include "lattice.hpp"

namespace stability {

using std::numbers::pi;

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
    const Findings findings(session, one.label.empty() ? "" : one.label + "_");
    const std::size_t fastest = one.sample.fastest();
    const double growth = one.sample.growth[fastest];
    const Point<2> k = one.sample.k.col(static_cast<Eigen::Index>(fastest));
    if (p.stress == 0.0 && p.shear_stress == 0.0)
        findings.check("growth_rate", growth, 0.0, one.noise, "nothing pulls, [HHM04] IV");
    else if (one.stable)
        findings.check("growth_rate", growth, 0.0, one.noise,
                       "the penalty is enough (rhs/material_vectors.hpp)");
    else
        findings.measure("growth_rate", growth);
    if (growth > 0.0) {
        findings.measure("growth_time", 1.0 / growth);
        findings.measure("fastest_k_x", k.x());
        findings.measure("fastest_k_y", k.y());
    }
    findings.measure("growth_rate_on_path", one.path.growth[one.path.fastest()]);
    const auto growing = std::count_if(one.sample.growth.begin(), one.sample.growth.end(),
                                       [](double g) { return g > 0.0; });
    findings.measure("growing_wave_vectors", static_cast<double>(growing));
    // Elasticity is what long waves see, up to the stress itself and to sums in place of integrals.
    const double tolerance = 0.02 + 2.0 * std::abs(p.stress);
    const auto claim = [&](const char* name, double value, double c) {
        if (one.elastic)
            findings.check(name, value, c, tolerance * c, "[HHM04] V, linear elasticity");
        else
            findings.measure(name, value);
    };
    if (p.vectors()) findings.measure("lowest_frequency_by_elastic", one.lowest);
    claim("transverse_speed", one.transverse_speed, std::sqrt(3.0 / 8.0));
    claim("longitudinal_speed", one.longitudinal_speed, std::sqrt(9.0 / 8.0));
}

void print_table(Session& session, const Parameters& p, const std::vector<Analysed>& all) {
    session.terminal().say("");
    session.terminal().say(fmt::format("{:<16}{:>12}{:>12}   {}",
                                       p.vectors() ? "penalty" : "velocity", "growth rate",
                                       "growth time", "fastest wave vector of the sample"));
    for (const auto& one : all) {
        const std::size_t s = one.sample.fastest();
        const Point<2> k = one.sample.k.col(static_cast<Eigen::Index>(s));
        session.terminal().say(
            one.sample.growth[s] > 0.0
                ? fmt::format("{:<16}{:>12.6f}{:>12.1f}   ({:.4f}, {:.4f}), wavelength {:.3f}",
                              one.row, one.sample.growth[s], 1.0 / one.sample.growth[s], k.x(),
                              k.y(), 2.0 * pi / k.norm())
                : fmt::format(
                      "{:<16}{:>12}{:>12}   nothing grows{}", one.row, 0, "-",
                      p.vectors() ? fmt::format("; lowest omega/(c_T k) {:.3f}", one.lowest) : ""));
    }
}

namespace {

std::string under(const Parameters& p) {
    return p.shear_stress == 0.0 ? fmt::format("{:g}", p.stress)
                                 : fmt::format("{:g}, shear {:g}", p.stress, p.shear_stress);
}

/// The border of the first zone: six corners at the distance 4 pi/3.
Points<2> zone_border() {
    Points<2> corners(2, 6);
    for (int c = 0; c < 6; ++c)
        corners.col(c) = 4.0 * pi / 3.0 * Point<2>(std::cos(c * pi / 3.0), std::sin(c * pi / 3.0));
    return corners;
}

}  // namespace

void draw(Session& session, const Parameters& p, const WavePath& path,
          const std::vector<Analysed>& all) {
    CurvePanel frequency = frame("frequencies (dashed: the slower branch)", "wave vector", "ω");
    CurvePanel growth = frame("growth", "wave vector", "growth rate");
    for (const auto& corner : path.corners) {
        frequency.x_ticks.push_back({corner.distance, corner.name});
        growth.x_ticks.push_back({corner.distance, corner.name});
    }
    for (std::size_t n = 0; n < all.size(); ++n) {
        const Spectrum& s = all[n].path;
        frequency.curves.push_back({all[n].title, path.distance, s.high_frequency});
        frequency.curves.push_back(
            {"", path.distance, s.low_frequency, Mark::line, 0, static_cast<int>(n) + 1});
        growth.curves.push_back({all[n].title, path.distance, s.growth});
    }
    draw_curves(session, "dispersion", fmt::format("Triangular lattice under stress {}", under(p)),
                {frequency, growth});
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
    draw_configurations(
        session, "growth_rates",
        fmt::format("Wave vectors of {0} × {0} particles under stress {1}", p.cells, under(p)),
        panels, panels.size(), "growth rate / largest");
}

}  // namespace stability
