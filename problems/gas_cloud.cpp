// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: an ellipsoid of gas flies apart in the void, beside Dyson's exact solution; 2 s
//
// An ellipse or an ellipsoid of gas with semi-axes a, b, c is let go in the void.
//
//        . o o o .          rho = rho_c (1 - x^2/a^2 - y^2/b^2 - z^2/c^2), e = rho/2, gamma = 2: P = rho^2/2
//      . o o o o o .        on the isentrope, and the speed of sound is 1 in the middle
//        . o o o .
//
// It stays an ellipsoid with a profile of that form. Every particle of the gas moves in proportion to the semi-axes,
//     x_i(t) = a_i(t)/a_i(0) x_i(0),    d2 a_i/dt2 = 2 rho_c (product of all a(0))/(product of all a)/a_i,
// which is exact, nonlinear, has a free surface, and knows no scale (Dyson, J. Math. Mech. 18, 91, 1968; Ovsiannikov
// 1956). Pressure is steepest along the shortest axis, which becomes the longest one.
//
// Particles begin on a square or cubic lattice of spacing 1, with masses in proportion to the density. Of the gas that
// moves semi-axes are measured by second moments, a_i^2 = (D + 4) sum m x_i^2/sum m, in units of the shortest at the
// start; times are in that by the speed of sound.
//
//     --dimension 2 --axes 2,1     an ellipse in the plane
//     --ranges ellipses            particles are ellipses that are drawn out with the gas (physics/ellipse.hpp)
//     --ranges density             h = range (m/rho)^(1/D): as many neighbours in the thin gas as in the dense
//     --rezone                     particles are split where the gas has become thin, and merged where it is dense:
//                                  the range of particles stays, and they have neighbours enough
//     --return                     velocities are reversed halfway: the gas comes back to where it began
#include "gas_cloud/cloud.hpp"
#include <spam/core/rigid_motion.hpp>

namespace gas_cloud {
namespace {

/// e by what it is on the isentrope of the start, a mean by mass.
template <int Dim>
double entropy(const Model<Dim>& model, std::span<const double> y) {
    const auto rho = model.density(y);
    const ConstState<Dim> state(model.layout(), y);
    Eigen::RowVectorXd s = 2.0 * state.energy();
    for (std::size_t i = 0; i < rho.size(); ++i) s[static_cast<Eigen::Index>(i)] /= rho[i];
    return mean_by_mass<1>(model.particles().mass, s)[0];
}

const char* const names[] = {"axis_1", "axis_2", "axis_3"};

/// The exact ellipse in the plane of the longest and the shortest axis at the start.
template <int Dim>
Points<2> exact_outline(const Cloud<Dim>& cloud, double t) {
    constexpr int corners = 180;
    const Point<Dim> a = cloud.size * cloud.exact(t);
    Points<2> ellipse(2, corners);
    for (int k = 0; k < corners; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / corners;
        ellipse.col(k) << a[0] * std::cos(angle), a[Dim - 1] * std::sin(angle);
    }
    return ellipse;
}

template <int Dim>
void draw(Session& session, const Cloud<Dim>& cloud, const RunRecord& run) {
    std::vector<CurvePanel> panels{frame("semi-axes", "t c/s", "a/s"),
                                   frame("less the exact ones", "t c/s", "%")};
    const auto t = run.history.column("t");
    for (int a = 0; a < Dim; ++a) {
        const auto found = run.history.column(names[a]);
        Curve off{.title = fmt::format("{:g}", cloud.axes[a]), .x = {}, .y = {}};
        Curve curve = off, exact = off;
        exact.title.clear();
        exact.like = a + 1;
        for (std::size_t k = 0; k < t.size(); ++k) {
            const double wanted = cloud.exact(t[k])[a];
            add_point(curve, t[k] / cloud.size, found[k]);
            add_point(exact, t[k] / cloud.size, wanted);
            add_point(off, t[k] / cloud.size, 100.0 * (found[k] / wanted - 1.0));
        }
        panels[0].curves.push_back(std::move(curve));
        panels[0].curves.push_back(std::move(exact));
        panels[1].curves.push_back(std::move(off));
    }
    if (run.history.has("particles")) {
        panels.push_back(frame("particles", "t c/s", "number", true));
        panels.back().curves.push_back(over_time("", run.history, "particles"));
        for (double& when : panels.back().curves.back().x) when /= cloud.size;
    }
    draw_curves(session, "semi_axes", "A cloud of gas flies apart (dashed: exact)", panels);
    const auto& reference = cloud.model->particles().reference_position;
    std::vector<ConfigurationPanel> configurations;
    for (const auto& state : cloud.drawn) {
        if (!state.there()) continue;
        // In space the layer of sites that is next to the plane of the longest and the shortest axis at the start.
        std::vector<Eigen::Index> near;
        const bool others = state.position.cols() != reference.cols();  // of other particles: now
        const auto& places = others ? state.position : reference;
        const double thick = others ? cloud.exact(state.t)[1] / cloud.axes[1] : 1.0;
        for (Eigen::Index i = 0; i < places.cols(); ++i)
            if (Dim == 2 || (places(1, i) > 0.0 && places(1, i) < thick)) near.push_back(i);
        ConfigurationPanel panel{fmt::format("t c/s = {:.3g}", state.t / cloud.size), {}, {}, {}};
        if (run.history.has("particles"))
            panel.title += fmt::format(": {} particles", state.position.cols());
        panel.outlines.push_back(exact_outline(cloud, state.t));
        panel.position.resize(2, static_cast<Eigen::Index>(near.size()));
        for (std::size_t k = 0; k < near.size(); ++k) {
            const auto to = static_cast<Eigen::Index>(k);
            panel.position.col(to) << state.position(0, near[k]), state.position(Dim - 1, near[k]);
            panel.colour.push_back(state.velocity.col(near[k]).norm());
        }
        configurations.push_back(std::move(panel));
    }
    draw_configurations(
        session, "configurations",
        run.history.has("particles")
            ? "Particles are split where the gas is thin (line: exact)"
            : fmt::format("{}{} particles: the longest axis becomes the shortest (line: exact)",
                          Dim == 3 ? "A layer of " : "", cloud.model->particles().size()),
        configurations, configurations.size(), "speed");
}

template <int Dim>
Point<Dim> usual() {
    Point<Dim> axes;
    for (int a = 0; a < Dim; ++a) axes[a] = std::pow(2.0, Dim - 1 - a);
    return axes;
}

template <int Dim>
double usual_time(const Parameters& p) {
    return Dim == 3 && !p.rezone ? 8.0 : 4.0;
}

/// What another program found with the defaults, in % of the exact axes.
std::vector<double> known(const Parameters& p, double size) {
    const bool fixed = p.ranges == Ranges::fixed;
    if (p.rezone) {
        if (p.dimension == 2 && size == 10.0 && fixed) return {0.5, -2.5};
        return {};
    }
    if (p.ranges == Ranges::ellipses) {
        if (p.dimension == 2 && size == 10.0) return {-0.23, -0.31};
        if (p.dimension == 3 && size == 4.0) return {-2.0, -3.1, -3.5};
        if (p.dimension == 3 && size == 6.0) return {-0.9, -1.4, -1.5};
        return {};
    }
    if (p.dimension == 3 && size == 4.0)
        return fixed ? std::vector{8.8, 0.0, -18.3} : std::vector{2.1, 0.6, -7.3};
    if (p.dimension == 3 && size == 6.0 && !fixed) return {2.1, 1.6, -4.3};
    if (p.dimension == 2 && size == 10.0)
        return fixed ? std::vector{1.6, -10.3} : std::vector{0.7, -0.9};
    return {};
}

/// Particles on the surface are small from the start, and have few neighbours: they stay as they are.
template <int Dim>
void rezone(Plan<Dim>& plan, const Parameters& p, double size) {
    const double most = p.largest_volume.value_or(Dim == 3 ? 4.0 : 2.0);
    const double at_start =
        (Dim == 3 ? 4.0 / 3.0 : 1.0) * std::numbers::pi * std::pow(p.range, Dim);
    plan.rezone({.every = 0.05 * size,
                 .volume = RezoningLimits{most, most / (1 << Dim)},
                 .neighbours = RezoningLimits{0.0, 0.6 * at_start},
                 .make = [&p](Particles<Dim> all) { return gas_of<Dim>(p, std::move(all)); }});
    plan.record({{"entropy", entropy<Dim>}});
}

/// What rezoning did, beside another program that merged pairs into one and turned their neighbours.
template <int Dim>
void judge_rezoning(const Findings& findings, const Parameters& p, const RunRecord& run,
                    bool standard) {
    const History& h = run.history;
    standard = standard && Dim == 2;
    findings.measure_last(h, {"particles", "splits", "merges", "entropy"});
    findings.measure("heat_of_merges", h.last("rezoning_heat") / h.first("energy"),
                     "by the energy of the cloud");
    for (const Drift& drift : run.drifts)
        if (drift.name == "angular momentum")
            findings.claim("angular_momentum_change", drift.change, 0.0, 1e-12,
                           "by sum m |x||v|: splits and merges keep it", standard);
    if (!p.returns)
        return findings.claim("particles_by_start", h.last("particles") / h.first("particles"),
                              16.06, 0.5, "another program", standard);
    findings.claim("particles_left", h.last("particles"), 632.0, 367.0, "below 1,000 again",
                   standard);
    const double paired[] = {2.054, 1.128};
    for (int a = 0; a < 2; ++a)
        findings.claim(fmt::format("{}_beside_pairs", names[a]), h.last(names[a]), paired[a], 0.03,
                       "another program, pairs merged into one", standard);
}

template <int Dim>
void compute(Session& session, const Parameters& p) {
    const double size = p.size.value_or(session.common().smoke ? 3.0 : Dim == 3 ? 4.0 : 10.0);
    const double time = p.time.value_or(session.common().smoke ? 1.0 : usual_time<Dim>(p));
    // Merged particles are no mirror images of each other, and RK4 keeps their angular momentum by its order alone.
    if (p.rezone && p.returns) session.prefer_step(0.05);
    std::vector<Cloud<Dim>> clouds{make_cloud<Dim>(p, size)};
    Cloud<Dim>& cloud = clouds.front();
    if (p.gradient_axes > 0.0) {
        std::vector<double> rates(cloud.y0.size());
        cloud.model->rates(0.0, cloud.y0, rates);
        if (const auto& why = cloud.model->failure(); !why.empty())
            refuse("gradient-axes: {:g} makes ellipses too narrow at the start ({}); give less",
                   p.gradient_axes, why);
    }
    const double t_end = session.common().t_end.value_or((p.returns ? 2.0 : 1.0) * time * size);
    cloud.half_time = p.returns ? 0.5 * t_end : std::numeric_limits<double>::infinity();
    if (const auto every = session.common().output_every; p.returns && every) {
        // Velocities are reversed at a row.
        const double rows = cloud.half_time / *every;
        if (std::abs(rows - std::round(rows)) > 1e-9 * rows)
            refuse(
                "output-every: {:g} does not divide {:g}, where velocities are reversed; give a part of that, "
                "as {:g}",
                *every, cloud.half_time, cloud.half_time / std::ceil(rows));
    }
    Plan<Dim> plan;
    plan.t_end = t_end;
    for (int a = 0; a < Dim; ++a)
        plan.record({{names[a], [a, size](const Model<Dim>& model, std::span<const double> y) {
                          return semi_axes(model, y, size)[a];
                      }}});
    if (p.rezone) rezone(plan, p, size);
    // Where particles are split the end is what is to be seen, there and back.
    cloud.drawn = p.rezone ? states_at<Dim>({0.0, 1.0 / 4.0, 1.0 / 2.0, 1.0}, t_end)
                           : states_at<Dim>({0.0, 1.0 / 8.0, 1.0 / 4.0, 1.0 / 2.0}, t_end);
    plan.snapshot_every = t_end / 16.0;
    plan.observe(keep_nearest<Dim>(cloud.drawn));
    double reversed_at = 0.0;  // 0 before
    if (p.returns)
        plan.observe(
            {.revise =
                 [&](double t, Model<Dim>& model, std::span<double> y) {
                     if (reversed_at > 0.0 || t < cloud.half_time * (1.0 - 1e-12)) return false;
                     reversed_at = cloud.half_time;
                     State<Dim>(model.layout(), y).velocity() *= -1.0;
                     return true;
                 },
             .memory =
                 [&](Archive& archive) {
                     archive(reversed_at);
                     if (reversed_at > 0.0 && reversed_at != cloud.half_time)
                         throw InputError(fmt::format(
                             "t-end: {:g}, but velocities have been reversed at t = {:g}, halfway "
                             "to an earlier end; leave --t-end out, or begin anew",
                             t_end, reversed_at));
                 }});
    const RunRecord run = session.run(*cloud.model, cloud.y0, std::move(plan));
    const Findings findings(session);
    const History& h = run.history;
    const auto others = known(p, size);
    const bool usual_run = run.complete && !session.common().smoke && time == usual_time<Dim>(p) &&
                           cloud.axes == usual<Dim>() &&
                           session.at_default({"kernel", "range", "gradient-axes", "aspect",
                                               "largest-volume", "t-end"}) &&
                           !others.empty();
    const bool standard = usual_run && !p.returns;
    for (int a = 0; a < Dim; ++a) {
        const double error = 100.0 * (h.last(names[a]) / cloud.exact(h.last("t"))[a] - 1.0);
        findings.measure(names[a], h.last(names[a]),
                         "second moments, by the shortest at the start");
        findings.claim(fmt::format("{}_error_percent", names[a]), error,
                       standard ? others[static_cast<std::size_t>(a)] : 0.0, 1.0,
                       "of the exact solution; expected: another program", standard);
    }
    findings.claim("energy_change", h.largest_change("energy") / h.first("energy"), 0.0, 1e-7,
                   "to the error of RK4", usual_run);
    if (p.rezone) judge_rezoning<Dim>(findings, p, run, usual_run);
    // Where nothing is lost: the equations are reversible, and chaos has had no time.
    if (p.returns && !p.rezone)
        for (int a = 0; a < Dim; ++a)
            findings.claim(fmt::format("{}_back", names[a]), h.last(names[a]) / h.first(names[a]),
                           1.0, 1e-3, "by the start", run.complete);
    findings.check_promises(run);
    if (session.plots()) draw(session, cloud, run);
}

}  // namespace
}  // namespace gas_cloud

int main(int argc, char** argv) {
    using namespace gas_cloud;
    Problem problem("gas_cloud", "an ellipsoid of gas flies apart in the void", 0.1);
    problem.units(fluid_units());
    Parameters p;
    auto& options = problem.options();
    options.integer("dimension", p.dimension, "3: an ellipsoid; 2: an ellipse in the plane",
                    between(2, 3));
    options.text(
        "axes", p.axes,
        "semi-axes along x, y and z, in proportion to each other (default 4,2,1; in the plane "
        "2,1)");
    options.number("size", p.size,
                   "the shortest semi-axis, in spacings (default 4; in the plane 10)",
                   between(2.0, 1000.0));
    options.number(
        "time", p.time,
        "how long it flies, in the shortest semi-axis by the speed of sound (default 8; in "
        "the plane 4)",
        between(1e-3, 1000.0));
    options.choice<Kernel>("kernel", p.kernel, all_kernels(), "weight function");
    options.number(
        "range", p.range,
        "range h of the weight function; with --ranges density or ellipses that at the start",
        between(1.5, 10.0));
    options.choice<Ranges>(
        "ranges", p.ranges, {Ranges::fixed, Ranges::density, Ranges::ellipses},
        "range of a particle: the same for all, range (m/rho)^(1/dimension), or an ellipse that is drawn "
        "out with the gas");
    options.number(
        "gradient-axes", p.gradient_axes,
        "how much shorter ellipses begin along the gradient of the density: by 1/(1 + this |grad rho| "
        "range/rho)",
        between(0.0, 10.0));
    options.number("aspect", p.aspect, "largest ratio of the axes of an ellipse (default: none)",
                   between(1.01, 1e6));
    options.only_when(
        {"gradient-axes", "aspect"}, {"ranges"}, [&p] { return p.ranges == Ranges::ellipses; },
        "has a meaning with --ranges ellipses alone; leave it out");
    options.flag(
        "rezone", p.rezone,
        "split particles where the gas has become thin, and merge them where it is dense again");
    options
        .number(
            "largest-volume", p.largest_volume,
            "m/rho above which a particle is split into 4 (8 in space); below a quarter (an eighth) of it "
            "groups are merged into two (default 4; in the plane 2)",
            between(0.1, 1000.0))
        .needs("rezone");
    options.flag("return", p.returns, "reverse all velocities then, and fly as long again");
    options.one_of({"time", "t-end"}, "the end of the run");
    return problem.main(argc, argv, [&](Session& session) {
        p.dimension == 3 ? compute<3>(session, p) : compute<2>(session, p);
    });
}
