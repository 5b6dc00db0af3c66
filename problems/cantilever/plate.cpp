// SPDX-License-Identifier: GPL-3.0-or-later
#include "plate.hpp"

#include <spam/external/clamp.hpp>
#include <spam/external/gravity.hpp>

namespace cantilever {
namespace {

constexpr double held_part = 0.25;  // of the length, beyond it

Points<2> lattice(const Parameters& p, int layers) {
    const double spacing = p.spacing(layers);
    const int columns = std::max(1, static_cast<int>(std::lround(p.beam.length / spacing)));
    const int held = std::max(static_cast<int>(std::ceil(2.0 * p.range())),
                              static_cast<int>(std::lround(held_part * p.beam.length / spacing)));
    Points<2> x = square_lattice<2>({columns + held, layers}, spacing);
    x.row(0).array() -= (held - 0.5) * spacing;
    x.row(1).array() -= 0.5 * (layers - 1) * spacing;
    return x;
}

}  // namespace

Plate make_plate(const Parameters& p, int layers) {
    const Beam& beam = p.beam;
    const double spacing = p.spacing(layers), c_s = std::sqrt(beam.bulk_modulus() / beam.density);
    auto model = std::make_shared<ParticleModel<2>>(
        make_particles<2>(lattice(p, layers), beam.density * spacing * spacing, spacing));
    const ElasticSolid solid{beam.lambda(), beam.shear_modulus()};
    p.add_term(
        *model, 0, model->particles().size(), solid, beam.density, p.range() * spacing,
        {.transport = Transport::monaghan, .angular_momentum = AngularMomentum::torque_pair});
    if (p.gravity != 0.0) model->add(std::make_unique<Gravity<2>>(Point<2>(0.0, -p.gravity)));
    model->add(std::make_unique<Clamp<2>>(
        select<2>(model->particles(), [](const Point<2>& x) { return x.x() < 0.0; })));
    Plate plate{{}, layers};
    plate.y0 = initial_state<2>(*model, beam.density, solid.eta, [&](const Point<2>& x) {
        return Point<2>(0.0, p.speed * c_s * beam.shape(x.x()));
    });
    plate.model = std::move(model);
    return plate;
}

Column<2> tip_column(const Model<2>& model) {
    const Points<2>& X = model.particles().reference_position;
    const double last = X.row(0).maxCoeff() - 0.5 * model.particles().spacing;
    std::vector<Eigen::Index> tip;
    for (Eigen::Index i = 0; i < X.cols(); ++i)
        if (X(0, i) > last) tip.push_back(i);
    return {"tip", [tip](const Model<2>& m, std::span<const double> y) {
                const Points<2> moved =
                    ConstState<2>(m.layout(), y).position() - m.particles().reference_position;
                return moved.row(1)(tip).mean();
            }};
}

double period_of(const Parameters& p, const History& h) {
    auto tip = h.column("tip");
    const double rest = p.gravity == 0.0 ? 0.0 : 0.5 * (h.smallest("tip") + h.largest("tip"));
    for (double& y : tip) y -= rest;
    return period_of_zeros(h.column("t"), tip);
}

void draw(Session& session, const Parameters& p, const std::vector<Plate>& plates,
          const std::vector<RunRecord>& runs) {
    const Beam& beam = p.beam;
    std::vector<ConfigurationPanel> panels;
    for (const auto& state : plates.front().drawn)
        panels.push_back(
            speed_panel(fmt::format("t = {:.3g} s", state.t), *plates.front().model, state));
    draw_configurations(
        session, "configurations",
        fmt::format("A plate of {} layers, held on the left", plates.front().layers), panels, 2,
        "speed, m/s");

    CurvePanel tip = frame("deflection of the tip", "t, s", "tip, m");
    for (std::size_t k = 0; k < runs.size(); ++k)
        tip.curves.push_back(
            over_time(fmt::format("{} layers", plates[k].layers), runs[k].history, "tip"));
    if (p.gravity == 0.0) {
        Curve theory{"thin beam", runs.front().history.column("t"), {}};
        const double omega = 2.0 * std::numbers::pi / beam.thin_period();
        const double amplitude = p.speed * std::sqrt(beam.bulk_modulus() / beam.density) / omega;
        for (const double t : theory.x) theory.y.push_back(amplitude * std::sin(omega * t));
        tip.curves.push_back(theory);
    }
    std::vector<CurvePanel> all{tip};
    if (runs.size() > 1) {
        const auto ms = [](double T) { return 1000.0 * T; };
        CurvePanel periods{"period", "layers", "T, ms", false, {}};
        Curve found{"particles", {}, {}, Mark::points};
        Curve derived{"derived for layers", {}, {}};
        for (std::size_t k = 0; k < runs.size(); ++k)
            add_point(found, plates[k].layers, ms(period_of(p, runs[k].history)));
        const double least = plates.front().layers - 1.0, most = plates.back().layers + 2.0;
        for (int n = plates.front().layers; n <= static_cast<int>(most); ++n)
            add_point(derived, n, ms(layered_period(beam, n, p.range())));
        const double thin = ms(beam.thin_period()), thick = ms(beam.period());
        periods.curves = {found,
                          derived,
                          {"thin beam", {least, most}, {thin, thin}},
                          {"beam with shear", {least, most}, {thick, thick}}};
        all.push_back(periods);
    }
    draw_curves(session, "curves", "An oscillating plate", all);
}

}  // namespace cantilever
