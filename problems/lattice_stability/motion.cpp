// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion.hpp"

namespace lattice_stability {
namespace {

/// 2 x N, rms `speed`, sum zero; the same numbers with every library.
Points<2> random_velocities(Eigen::Index particles, double speed, int seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    Points<2> v(2, particles);
    for (double& component : v.reshaped()) component = 2.0 * drawn(random) - 1.0;
    v.colwise() -= v.rowwise().mean().eval();
    return v * (speed / std::sqrt(v.squaredNorm() / static_cast<double>(particles)));
}

}  // namespace

std::vector<Points<2>> Paths::lines() const {
    if (at.empty()) return {};
    std::vector<Points<2>> lines(static_cast<std::size_t>(at.front().cols()));
    for (std::size_t i = 0; i < lines.size(); ++i) {
        lines[i].resize(2, static_cast<Eigen::Index>(at.size()));
        for (std::size_t s = 0; s < at.size(); ++s)
            lines[i].col(static_cast<Eigen::Index>(s)) = at[s].col(static_cast<Eigen::Index>(i));
    }
    return lines;
}

Sample make_sample(const Parameters& p, Acting acting, double range) {
    const Box<2> box = box_of(p.lattice, p.block);
    auto particles = make_particles<2>(positions_of(p.lattice, p.block), 1.0, 1.0, box);
    Sample sample{{}, acting};
    sample.call(std::string(to_string(acting)));
    sample.model = std::make_unique<DensityPotentialModel<2>>(
        std::move(particles), p.potentials(p.lattice, acting, range), box);
    const Points<2> v = random_velocities(p.block * p.block, p.speed, p.seed);
    Eigen::Index next = 0;
    sample.y0 = initial_state<2>(*sample.model, 1.0, 1.0,
                                 [&](const Point<2>&) { return Point<2>(v.col(next++)); });
    return sample;
}

Column<2> rms_displacement_column() {
    return {"rms_displacement", [](const Model<2>& model, std::span<const double> y) {
                const ConstState<2> state(model.layout(), y);
                const auto& sites = model.particles().reference_position;
                const auto n = static_cast<double>(sites.cols());
                return std::sqrt((state.position() - sites).squaredNorm() / n);
            }};
}

void draw_paths(Session& session, const Parameters& p, const std::vector<Sample>& samples,
                double t_end) {
    const Box<2> box = box_of(p.lattice, p.block);
    // The frame runs between the sites, so that as many particles are inside as belong to it.
    const double x = -0.25, y = -0.25 * box.length(1) / p.block * 2.0;
    Points<2> frame(2, 4);
    frame << x, x + box.length(0), x + box.length(0), x,  //
        y, y, y + box.length(1), y + box.length(1);
    std::vector<PathPanel> panels;
    for (const auto& sample : samples)
        panels.push_back({title_of(sample.acting), sample.paths.lines(), frame});
    spam::draw_paths(session, "trajectories",
                     fmt::format("Paths of {} particles with speeds of {:g} until t = {:g}",
                                 p.block * p.block, p.speed, t_end),
                     panels, 2);
}

void draw_displacements(Session& session, const std::vector<Sample>& samples,
                        const std::vector<RunRecord>& runs) {
    CurvePanel displacement = frame("from the sites of the lattice", "t", "rms displacement");
    CurvePanel kinetic = frame("energy in motion", "t", "kinetic energy / total");
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const History& h = runs[k].history;
        const std::string title = title_of(samples[k].acting);
        const int style = style_of(samples[k].acting);
        const auto share = divided(h.column("kinetic"), h.first("energy"));
        displacement.curves.push_back(
            {title, h.column("t"), h.column("rms_displacement"), Mark::line, style});
        kinetic.curves.push_back({title, h.column("t"), share, Mark::line, style});
    }
    draw_curves(session, "displacements", "A lattice that melts, and potentials that hold it",
                {displacement, kinetic});
}

}  // namespace lattice_stability
