// SPDX-License-Identifier: GPL-3.0-or-later
// What a column of elements does, and how near to it one of particles is.
#include "column.hpp"

namespace water_column {
namespace {

/// The mesh of the slide, of a column 40 wide, from another program; the same flow at t/W of other widths.
struct KnownMesh {
    double centre_height, kinetic, front, leading, tension;
};
constexpr KnownMesh known_meshes[] = {{26.371, 39.49, 53.0, 46.55, 0.16},
                                      {25.516, 55.22, 58.9, 50.6, 0.25}};
constexpr double known_width = 40.0;
constexpr const char* source = "[HH07] 11; recorded value";

/// Options of the fluid and of its rest, whatever the size; the rest of the particles beside it.
bool is_slide(const Session& session, const Parameters& p, const FluidColumn& mesh) {
    return session.when_default({"gravity", "hourglass-viscosity", "hourglass-stiffness", "damping",
                                 "relaxation-time"}) &&
           p.cavitation == 0.02 && p.aspect == 1.6 && mesh.mesh == std::array{80, 64};
}

std::string at(const std::string& name, double t) { return fmt::format("{}_at_{:g}", name, t); }

/// Rows carry what lies above them: P = g (mass above their middle by the width).
void report_rows(const Findings& findings, const FluidColumn& mesh, const Parameters& p,
                 const RunRecord& rest, bool known) {
    const auto rows = rows_of(mesh, rest.y);
    const double
        mass = static_cast<double>(mesh.rows) / mesh.mesh[1],
        surface = ConstState<2>(mesh.between_walls->layout(), rest.y).position().row(1).maxCoeff();
    const auto law = law_of(p);
    double pressure = 0.0, density = 0.0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const double above = (static_cast<double>(rows.size() - k) - 0.5) * mass;
        pressure =
            std::max(pressure, std::abs(law.pressure(rows[k].density, 0.0) - mesh.g * above));
        const double expected = hydrostatic_density(mesh.g, surface - rows[k].y);
        density = std::max(density, std::abs(rows[k].density - expected));
    }
    findings.claim("pressure_error", pressure, 0.0, 1e-6, "row k from the top: P = g dy (k - 1/2)",
                   known);
    findings.claim("profile_error", density, 0.0, 1e-5,
                   "rho(d) = (2 + sqrt(1 + 6 g d))/3, depths in the mesh", known);
    findings.measure("kinetic_energy_at_rest", rest.history.last("kinetic"));
}

/// The largest up to t.
double energy_change(const History& h, double t) {
    const auto time = h.column("t"), energy = h.column("energy");
    double largest = 0.0;
    for (std::size_t k = 0; k < time.size() && time[k] <= t * (1.0 + 1e-9); ++k)
        largest = std::max(largest, std::abs(energy[k] - energy[0]));
    return largest;
}

}  // namespace

void report_elements(Session& session, const Parameters& p, const Computed& elements) {
    const auto& [mesh, rest, collapse] = elements;
    const Findings findings(session, mesh->prefix);
    const bool known = is_slide(session, p, *mesh);
    report_rows(findings, *mesh, p, *rest, known && rest->complete);
    session.check_promises(*rest, mesh->prefix + "relaxation_");
    if (!collapse) return;
    const History& h = collapse->history;
    const double scale = mesh->width / known_width;
    for (std::size_t k = 0; k < std::size(compared_times); ++k) {
        const double t = compared_times[k] * mesh->unit;
        if (!reached(*collapse, t)) continue;
        const KnownMesh& one = known_meshes[k];
        const auto claim = [&](const char* name, double expected, double tolerance, double unit) {
            findings.claim(at(name, t), h.at(t, name), expected * unit, tolerance * unit, source,
                           known);
        };
        claim("centre_height", one.centre_height, 0.005, scale);
        claim("kinetic", one.kinetic, 0.1, scale * scale);
        claim("front", one.front, 0.3, scale);
        claim("leading_percent", one.leading, 0.2, scale);
        claim("tension", one.tension, 0.04, 1.0);
        findings.measure(at("height", t), h.at(t, "height"));
    }
    findings.claim(at("energy_change", mesh->unit), energy_change(h, mesh->unit), 0.0,
                   2e-4 * scale * scale, "kinetic, internal, of gravity, and hourglass work",
                   known && reached(*collapse, mesh->unit));
    const double resisted = h.last("hourglass_work") - h.first("hourglass_work");
    findings.measure("hourglass_work", resisted, "at the end of the collapse");
    findings.claim("hourglass_work_by_kinetic", resisted / h.last("kinetic"), 0.0, 0.03,
                   "the hourglass takes little", known && collapse->complete);
    session.check_promises(*collapse, mesh->prefix + "collapse_");
}

void report_both(Session& session, const Parameters& p, std::span<const Computed> samples,
                 const Computed& elements) {
    const FluidColumn& mesh = *elements.column;
    const bool known =
        is_slide(session, p, mesh) &&
        session.when_default({"surface-tension", "core", "core-range", "kernel", "range"});
    const Findings findings(session);
    for (const double part : compared_times) {
        const double t = part * mesh.unit, scale = mesh.width / known_width;
        if (!elements.collapse || !reached(*elements.collapse, t)) continue;
        const auto compare = [&](const char* name, double tolerance, bool by_value) {
            const Sampled found = sampled(samples, t, name);
            if (found.number == 0) return;
            const double expected = elements.collapse->history.at(t, name),
                         difference =
                             by_value ? found.mean / expected - 1.0 : found.mean - expected;
            const auto words = fmt::format("particles against elements, mean of {}", found.number);
            if (tolerance > 0.0)
                findings.claim(at(std::string(name) + "_difference", t), difference, 0.0,
                               tolerance * (by_value ? 1.0 : scale), words, known);
            else
                findings.measure(at(std::string(name) + "_difference", t), difference, words);
            if (found.number > 1)
                findings.measure(at(std::string(name) + "_deviation", t), found.deviation,
                                 "standard deviation of one sample of particles");
        };
        compare("centre_height", 0.02, false);
        compare("kinetic", 0.02, true);
        compare("leading_percent", 0.4, false);
        compare("front", 0.0, true);
        compare("tension", 0.0, false);
    }
}

}  // namespace water_column
