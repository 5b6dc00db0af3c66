// SPDX-License-Identifier: GPL-3.0-or-later
#include "impact.hpp"

#include "elements.hpp"
#include <spam/external/clamp.hpp>

namespace ball_plate {
namespace {

/// Rows of the triangular lattice; in space layers of the face-centred cubic one parallel to the faces of its cells, of
/// whole cells about `columns` spacings wide.
template <int Dim>
Points<Dim> plate_of(const Parameters& p) {
    if constexpr (Dim == 2) {
        return triangular_block(p.columns, p.rows);
    } else {
        const double edge = cubic_edge(CubicLattice::fcc);
        const int cells = static_cast<int>(std::lround(p.columns / edge));
        const Points<3> sites = cubic_lattice(CubicLattice::fcc, {cells, cells, (p.rows + 1) / 2});
        std::vector<Eigen::Index> within;
        for (Eigen::Index k = 0; k < sites.cols(); ++k)
            if (sites(2, k) < (0.5 * p.rows - 0.25) * edge) within.push_back(k);
        return sites(Eigen::all, within);
    }
}

/// Two bodies, however near they are to each other.
template <int Dim>
std::vector<Particles<Dim>> ball_and_plate(const Parameters& p) {
    Points<Dim> disk = lattice_ball<Dim>(p.radius);
    const Points<Dim> block = centred<Dim>(plate_of<Dim>(p));
    disk.row(Dim - 1).array() +=
        block.row(Dim - 1).maxCoeff() + p.gap - disk.row(Dim - 1).minCoeff();
    return {one_body(make_particles<Dim>(disk, 1.0)), one_body(make_particles<Dim>(block, 1.0))};
}

/// The outermost column of the plate on either side; in space all around.
template <int Dim>
void hold_ends(const Particles<Dim>& whole_plate, ParticleModel<Dim>& model) {
    const auto& particles = model.particles();
    const double outermost = whole_plate.reference_position.row(0).maxCoeff() - 0.75;
    Group ends(particles.size());
    for (std::size_t i = 0; i < ends.size(); ++i)
        ends[i] = particles.body[i] == plate &&
                  particles.reference_position.col(static_cast<Eigen::Index>(i))
                          .template head<Dim - 1>()
                          .template lpNorm<Eigen::Infinity>() > outermost;
    model.add(std::make_unique<Clamp<Dim>>(std::move(ends)));
}

}  // namespace

std::string_view to_string(Ends ends) { return ends == Ends::free ? "free" : "held"; }

std::vector<double> speeds_of(MatterKind kind) {
    if (kind == MatterKind::pair_md) return {1.0, 2.0, 4.0, 8.0};
    if (kind == MatterKind::elements) return {0.25, 0.5};
    return {0.25, 0.5, 1.0, 2.0};
}

int seeds_of(const Parameters& p, double speed) {
    const bool breaks = p.dimension == 3 && p.matter.kind == MatterKind::pair_md && speed >= 4.0;
    return breaks && p.matter.disorder > 0.0 ? 5 : 1;
}

double step_of(const Parameters& p) {
    const MatterKind kind = p.matter.kind;
    const bool molecules = kind == MatterKind::pair_md;
    double step = molecules ? 0.0025 : kind == MatterKind::embedded_atom ? 0.0125 : 0.05;
    const Parameters usual;
    if (const auto contact = p.repulsion()) step *= relative_step(*contact, usual.contact);
    step *= breaking::relative_step(p.matter);
    return step * (p.compare ? 1.0 : relative_step(p.speed, molecules ? 20.0 : 2.0));
}

/// The finite-element twin, which meets by a contact and whose elements are removed where they break.
Impact<2> make_elements(const Parameters& p, double speed) {
    ball_plate_elements::Parameters twin;
    twin.speed = speed;
    twin.radius = p.radius;
    twin.ball_side = std::max(2, static_cast<int>(std::lround(1.75 * p.radius)));
    twin.columns = p.columns;
    twin.rows = p.rows;
    twin.gap = p.gap;
    twin.yield_stress = p.matter.yield_stress.value_or(twin.yield_stress);
    twin.hardening = p.matter.hardening;
    twin.failure_strain = p.matter.failure_strain.value_or(twin.failure_strain);
    twin.held = p.ends == Ends::held;
    twin.contact = *p.repulsion();
    auto made = ball_plate_elements::make_impact(twin);
    Impact<2> impact{{}, speed, p.matter.seed};
    impact.model = std::move(made.model);
    impact.y0 = std::move(made.y0);
    return impact;
}

template <int Dim>
Impact<Dim> make_impact(const Session& session, const Parameters& p, double speed) {
    if constexpr (Dim == 2)
        if (p.matter.kind == MatterKind::elements) return make_elements(p, speed);
    Impact<Dim> impact{{}, speed, p.matter.seed};
    const auto bodies = ball_and_plate<Dim>(p);
    impact.model = make_model<Dim>(session, p.matter, bodies, p.repulsion());
    if (p.ends == Ends::held) hold_ends(bodies.back(), *impact.model);
    const auto& particles = impact.model->particles();
    Points<Dim> x = particles.reference_position;
    disturb(x, p.matter);
    impact.y0 = start(*impact.model, x, speed);
    const State<Dim> state(impact.model->layout(), impact.y0);
    for (std::size_t i = 0; i < particles.size(); ++i)
        if (particles.body[i] == ball)
            state.velocity()(Dim - 1, static_cast<Eigen::Index>(i)) = -speed;
    return impact;
}

template <int Dim>
std::vector<Column<Dim>> columns_of(const Parameters& p) {
    if constexpr (Dim == 2)
        if (p.matter.kind == MatterKind::elements) return ball_plate_elements::columns_of();
    using Y = std::span<const double>;
    return {
        {"ball_speed",
         [](const Model<Dim>& model, Y y) {
             const auto v = ConstState<Dim>(model.layout(), y).velocity();
             double sum = 0.0, n = 0.0;
             for (std::size_t i = 0; i < model.particles().size(); ++i)
                 if (model.particles().body[i] == ball) {
                     sum -= v(Dim - 1, static_cast<Eigen::Index>(i));
                     n += 1.0;
                 }
             return sum / n;
         }},
        {"pieces", [](const Model<Dim>& model,
                      Y y) { return static_cast<double>(piece_sizes(model, y).size()); }},
        {"largest_piece", [](const Model<Dim>& model,
                             Y y) { return static_cast<double>(piece_sizes(model, y).front()); }},
        closest_pair_column<Dim>()};
}

template Impact<2> make_impact(const Session&, const Parameters&, double);
template Impact<3> make_impact(const Session&, const Parameters&, double);
template std::vector<Column<2>> columns_of(const Parameters&);
template std::vector<Column<3>> columns_of(const Parameters&);

}  // namespace ball_plate
