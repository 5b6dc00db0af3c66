// SPDX-License-Identifier: GPL-3.0-or-later
#include "convection.hpp"
#include <spam/diagnostics/field_interpolation.hpp>
#include <spam/diagnostics/wall_images.hpp>

namespace rayleigh_benard {
namespace {

/// Density, u, v and temperature of particles where the grid has its cells. Images behind a plate have
/// the temperatures that sweeps see.
struct Fields {
    FieldGrid<2> nodes;
    Eigen::RowVectorXd density;
    Eigen::MatrixXd rest;  ///< u, v, T
};

Fields fields_of(const Convection& gas, std::span<const double> y, const FieldGrid<2>& nodes) {
    const FluidModel<2>& model = *gas.model;
    const ConstState<2> state(model.layout(), y);
    const Points<2> x = state.position(), v = state.velocity();
    const double range = model.scheme().range;
    const auto images = images_behind_walls<2>(model.box(), range, x, v);
    Points<2> at(2, x.cols() + images.count());
    at << x, images.position;
    Eigen::MatrixXd values(3, at.cols());
    values.topRows(2) << v, images.velocity;
    const auto T = model.temperature(y);
    for (Eigen::Index i = 0; i < x.cols(); ++i) values(2, i) = T[static_cast<std::size_t>(i)];
    const Box<2>& box = model.box();
    for (Eigen::Index k = 0; k < images.count(); ++k) {
        double& temperature = values(2, x.cols() + k);
        temperature = values(2, images.owner[static_cast<std::size_t>(k)]);
        for (int a = 0; a < 2; ++a)
            for (const bool upper : {false, true}) {
                const auto& wall = box.wall(a, upper);
                const double beyond = (upper ? 1.0 : -1.0) * (images.position(a, k) - wall.at);
                if (!wall.open() && wall.temperature && beyond > 0.0)
                    temperature = 2.0 * *wall.temperature - temperature;
            }
    }
    std::vector<double> mass = model.particles().mass;
    for (const auto owner : images.owner) mass.push_back(mass[static_cast<std::size_t>(owner)]);
    const FieldInterpolation<2> field(weight_function<2>(to_string(model.scheme().kernel), range),
                                      mass, at, model.box().without_walls());
    const Points<2> places = nodes.points();
    return {nodes, field.density(places), field.value(values, places)};
}

FieldGrid<2> nodes_of(const Grid& grid) {
    const double d = grid.spacing();
    return {Point<2>(0.5 * d, 0.5 * d), Point<2>(d, d), {grid.nx(), grid.ny()}};
}

std::vector<double> row(const Eigen::RowVectorXd& values) {
    return {values.data(), values.data() + values.size()};
}

/// A dash from every second place to where the flow would be after a while.
PathPanel dashes(const std::string& title, const Grid& grid, const std::vector<double>& u,
                 const std::vector<double>& v, double fastest) {
    PathPanel panel{title, {}};
    const int each = std::max(1, grid.ny() / 10);
    const double longest = 1.6 * each * grid.spacing();
    for (int j = each / 2; j < grid.ny(); j += each)
        for (int i = each / 2; i < grid.nx(); i += each) {
            const auto k = static_cast<std::size_t>(j * grid.nx() + i);
            Points<2> path(2, 2);
            const Point<2> from((i + 0.5) * grid.spacing(), (j + 0.5) * grid.spacing());
            path.col(0) = from;
            path.col(1) = from + longest / fastest * Point<2>(u[k], v[k]);
            panel.paths.push_back(path);
        }
    return panel;
}

ContourPanel coloured(const FieldGrid<2>& nodes, const std::vector<double>& values,
                      const ContourPanel::Colours& colours) {
    ContourPanel panel{
        .title = "", .grid = nodes, .values = values, .periodic = false, .particles = {}};
    panel.colours = colours;
    return panel;
}

void draw_histories(Session& session, const Convection& gas, const RunRecord& run,
                    const GridRun& twin) {
    const auto t = run.history.column("t");
    const std::vector<double> later(t.begin() + 1, t.end());
    const std::vector<double> twins_later(twin.t.begin() + 1, twin.t.end());
    CurvePanel heat = frame("", "t", "Nusselt number (dashed: upper plate)");
    const auto of_run = [&](const char* column, bool upper) {
        return nusselt(gas.layer, t, run.history.column(column), upper);
    };
    heat.curves = {
        {"particles", later, of_run("heat_bottom", false)},
        {"grid", twins_later, nusselt(gas.layer, twin.t, twin.heat_bottom, false)},
        {"", later, of_run("heat_top", true), Mark::line, 0, 1},
        {"", twins_later, nusselt(gas.layer, twin.t, twin.heat_top, true), Mark::line, 0, 2}};
    CurvePanel rolls = over_time("", run.history, "velocity of the rolls",
                                 {{"particles", "roll_amplitude"}}),
               kinetic = over_time("", run.history, "kinetic energy", {{"particles", "kinetic"}});
    rolls.curves.push_back({"grid", twin.t, twin.roll});
    kinetic.curves.push_back({"grid", twin.t, twin.kinetic});
    draw_curves(session, "histories",
                fmt::format("Convection at Ra = {:g}: {} smooth particles and finite differences",
                            gas.layer.rayleigh, gas.model->particles().size()),
                {heat, rolls, kinetic});
}

}  // namespace

void draw(Session& session, const Convection& gas, const RunRecord& run, const Grid& grid,
          const GridRun& twin) {
    draw_histories(session, gas, run, twin);
    const FieldGrid<2> nodes = nodes_of(grid);
    const Fields fields = fields_of(gas, run.y, nodes);
    const auto rho = grid.field(twin.y, 0), u = grid.field(twin.y, 1), v = grid.field(twin.y, 2),
               T = grid.field(twin.y, 3);
    double fastest = 0.0;
    for (std::size_t k = 0; k < u.size(); ++k) fastest = std::max(fastest, std::hypot(u[k], v[k]));
    for (Eigen::Index k = 0; k < fields.rest.cols(); ++k)
        fastest = std::max(fastest, std::hypot(fields.rest(0, k), fields.rest(1, k)));
    if (!(fastest > 0.0)) fastest = 1.0;
    const auto title =
        fmt::format("Ra = {:g}: grid of {} x {} (left), {} particles (right)", gas.layer.rayleigh,
                    grid.nx(), grid.ny(), gas.model->particles().size());
    draw_paths(
        session, "velocity", title,
        {dashes(fmt::format("finite differences, at most {:.3f}", fastest), grid, u, v, fastest),
         dashes("smooth particles", grid, row(fields.rest.row(0)), row(fields.rest.row(1)),
                fastest)},
        2);
    const double L = gas.layer.L;
    const ContourPanel::Colours of_rho{0.7, 1.4, "density"},
        of_T{gas.layer.cold, gas.layer.hot, "temperature"};
    draw_contours(session, "fields", title,
                  {coloured(nodes, rho, of_rho), coloured(nodes, row(fields.density), of_rho),
                   coloured(nodes, T, of_T), coloured(nodes, row(fields.rest.row(2)), of_T)},
                  2, {Point<2>::Zero(), Point<2>(2.0 * L, L)});
}

void draw_scan(Session& session, const Scan& scan) {
    const std::string theory =
        scan.linear_onset ? fmt::format(" (linear theory: Ra = {:g})", *scan.linear_onset) : "";
    CurvePanel rolls = frame("", "Rayleigh number", "velocity of strong rolls at the end");
    rolls.curves = {{"smooth particles", scan.rayleigh, scan.of_particles},
                    {"finite differences", scan.rayleigh, scan.of_grid}};
    CurvePanel growth = frame("", "Rayleigh number", "growth rate of weak rolls");
    growth.curves = {
        {"finite differences", scan.rayleigh, scan.growth, Mark::line, 2},
        {"no growth", {scan.rayleigh.front(), scan.rayleigh.back()}, {0.0, 0.0}, Mark::line, 3}};
    draw_curves(session, "onset", "Onset of convection" + theory, {rolls, growth});
}

}  // namespace rayleigh_benard
