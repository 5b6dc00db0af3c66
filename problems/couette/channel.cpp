// SPDX-License-Identifier: GPL-3.0-or-later
#include "channel.hpp"

#include "../wall_step.hpp"
#include <spam/external/gravity.hpp>

namespace channel {
namespace {

using std::numbers::pi;

constexpr double drawn_at[] = {0.02, 0.08, 0.25, 1.0};  // of ExactFlow::time()

/// Root of the mean squared difference from the exact profile, by the speed of the drive.
Column<2> profile_error_column(const ExactFlow& exact, const std::shared_ptr<double>& now) {
    return {"profile_error", [exact, now](const Model<2>& model, std::span<const double> y) {
                const ConstState<2> state(model.layout(), y);
                double sum = 0.0;
                for (Eigen::Index i = 0; i < state.position().cols(); ++i) {
                    const double off =
                        state.velocity()(0, i) - exact.velocity(state.position()(1, i), *now);
                    sum += off * off;
                }
                return std::sqrt(sum / static_cast<double>(state.position().cols())) / exact.speed;
            }};
}

/// Mean velocity along the plates, by the speed of the drive: 1/2 (couette) or 2/3 (poiseuille) in the end.
Column<2> mean_velocity_column(double speed) {
    return {"mean_velocity", [speed](const Model<2>& model, std::span<const double> y) {
                const ConstState<2> state(model.layout(), y);
                return state.velocity().row(0).mean() / speed;
            }};
}

Plan<2> plan_of(const Session& session, Flow& flow) {
    Plan<2> plan;
    plan.t_end = session.end(flow.exact.time(), 0.02 * flow.exact.time());
    plan.snapshot_every = plan.t_end / 50.0;
    const auto now = std::make_shared<double>(0.0);
    plan.observe({.columns = {mean_velocity_column(flow.exact.speed)},
                  .on_row = [now](double t, const auto&, auto) { *now = t; }});
    if (flow.known) plan.record({profile_error_column(flow.exact, now)});
    for (const double part : drawn_at)
        if (part * flow.exact.time() <= plan.t_end * (1.0 + 1e-9))
            flow.drawn.push_back({part * flow.exact.time()});
    plan.observe(keep_nearest(flow.drawn));
    return plan;
}

/// Of one plate on the fluid along the plates, by their length: the mean over the last tenth of the run.
double plate_stress(const Flow& flow, const RunRecord& run, bool upper) {
    return run.history.mean_rate(upper ? "impulse_top_x" : "impulse_bottom_x", 0.9) / flow.exact.H;
}

void report(Session& session, const Flow& flow, const RunRecord& run) {
    const Findings findings(session, flow.prefix);
    const bool plate = flow.exact.drive == Drive::plate;
    findings.measure("reflections", static_cast<double>(flow.model->reflections()),
                     "particles that crossed a plate");
    findings.check_promises(run);
    if (!flow.known) return;
    const bool known =
        session.when_default({"speed", "reynolds", "density", "kernel", "range", "friction"}) &&
        run.complete && run.statistics.t_end >= 0.99 * flow.exact.time() && flow.exact.H >= 20.0;
    for (const bool upper : {false, true})
        if (run.complete)
            findings.claim(upper ? "stress_top" : "stress_bottom",
                           plate_stress(flow, run, upper) / flow.exact.stress(upper), 1.0, 0.02,
                           "force of the plate by that of the finished flow", known);
    findings.claim("profile_error", run.history.last("profile_error"), 0.0, 0.01,
                   plate ? "u = V y/H" : "u = 4 U (y/H)(1 - y/H)", known);
    findings.claim("mean_velocity", run.history.last("mean_velocity"), plate ? 0.5 : 2.0 / 3.0,
                   0.01, "of the exact flow", known);
    findings.measure("largest_profile_error", run.history.largest("profile_error"),
                     "start-up included");
}

/// Lines: exact. Points: particles.
void draw(Session& session, const Parameters& p, const Flow& flow) {
    CurvePanel panel = frame("", flow.exact.drive == Drive::plate ? "u/V" : "u/U", "y/H");
    const double H = flow.exact.H, U = flow.exact.speed;
    for (const auto& state : flow.drawn) {
        if (!state.there() || !flow.known) continue;
        Curve exact{fmt::format("t = {:.3g}", state.t), {}, {}};
        for (int k = 0; k <= 100; ++k)
            add_point(exact, flow.exact.velocity(0.01 * k * H, state.t) / U, 0.01 * k);
        panel.curves.push_back(exact);
    }
    for (int style = 1; const auto& state : flow.drawn) {
        if (!state.there()) continue;
        Curve particles{"", {}, {}, Mark::points, style++};
        for (Eigen::Index i = 0; i < state.position.cols(); ++i)
            add_point(particles, state.velocity(0, i) / U, state.position(1, i) / H);
        panel.curves.push_back(particles);
    }
    if (panel.curves.empty()) return;
    draw_curves(session, "profiles",
                fmt::format("{} particles, Re = {:g}{}", flow.model->particles().size(), p.reynolds,
                            flow.known ? ": lines exact" : ""),
                {panel});
}

void run(Session& session, const Parameters& p, Drive drive) {
    auto flows = by_size(p.cells, p.compare, [&](int cells) {
        return make_flow(p, drive, cells, session.common().dry_run);
    });
    // Rigid sides turn particles back within a step, which costs the method its order.
    const Box<2>& box = flows.front().model->box();
    bool rigid = false;
    for (int a = 0; a < 2; ++a)
        for (const bool upper : {false, true})
            rigid = rigid || box.wall(a, upper).kind == WallKind::rigid;
    session.prefer_step(
        std::min({rigid ? 0.125 : 0.25, 0.4 / flows.back().exact.nu, step_beside_walls(box)}));
    const auto runs = run_all(session, flows, [&](Flow& flow) { return plan_of(session, flow); });
    for (std::size_t k = 0; k < runs.size(); ++k) report(session, flows[k], runs[k]);
    if (runs.size() == 3 && flows.front().known)
        Findings(session).measure_orders(
            labels_of(flows), last_of(runs, "profile_error"),
            "of the profile's error against the number of particles across");
    if (session.plots() && !runs.empty()) draw(session, p, flows[runs.size() / 2]);
}

}  // namespace

double ExactFlow::velocity(double y, double t) const {
    if (t <= 0.0) return 0.0;
    const double part = y / H;
    double u = drive == Drive::plate ? part : 4.0 * part * (1.0 - part);
    for (int n = 1; n < 400; n += drive == Drive::plate ? 1 : 2) {
        const double k = n * pi, left = std::exp(-k * k * nu * t / (H * H));
        if (left < 1e-17) break;
        const double wave = left * std::sin(k * part);
        u += drive == Drive::plate ? (n % 2 == 0 ? 2.0 : -2.0) / k * wave
                                   : -32.0 / (k * k * k) * wave;
    }
    return speed * u;
}

namespace {

/// Whether the sides are plates at which the fluid sticks, the upper one with this velocity, and periods.
bool between_plates(const Box<2>& box, double speed) {
    const auto sticks = [&](bool upper, double V) {
        const Wall<2>& wall = box.wall(1, upper);
        return wall.kind == WallKind::no_slip && wall.velocity == Point<2>(V, 0.0);
    };
    return box.periodic(0) && sticks(false, 0.0) && sticks(true, speed);
}

Box<2> box_of(const Parameters& p, int cells) {
    return p.sides->box<2>(Point<2>::Zero(), Point<2>(cells, cells),
                           {{"moving", fmt::format("moving:{}", p.speed)}});
}

}  // namespace

Flow make_flow(const Parameters& p, Drive drive, int cells, bool only_described) {
    const double H = cells, nu = p.speed * H / p.reynolds;
    const bool plate = drive == Drive::plate;
    const auto box = box_of(p, cells);
    const Points<2> x = cell_centres<2>({cells, cells});
    const Fluid fluid{LucyGas{},
                      NewtonViscosity::shear_and_bulk(nu, 0.0, 2),
                      {},
                      p.friction == FrictionBy::pairs};
    auto model =
        std::make_unique<FluidModel<2>>(make_particles<2>(x, 1.0, 1.0, box), fluid, p.scheme, box);
    if (!plate)
        model->add(std::make_unique<Gravity<2>>(Point<2>(8.0 * nu * p.speed / (H * H), 0.0)));
    Flow flow;
    flow.exact = {drive, H, nu, p.speed};
    flow.known = between_plates(box, plate ? p.speed : 0.0);
    if (!only_described)
        flow.y0 = model->state(model->particles().reference_position, Points<2>::Zero(2, x.cols()));
    model->layout().set_scale(Field::velocity, p.speed);
    flow.model = std::move(model);
    return flow;
}

int main_of(int argc, char** argv, const std::string& name, const std::string& summary,
            Drive drive) {
    Problem problem(name, summary, 0.25,
                    "0.25, or shorter where friction is strong or a side moves fast");
    problem.units(fluid_units());
    Parameters p;
    auto& options = problem.options();
    options.integer("cells", p.cells, "particles from plate to plate, and as many along them",
                    between(8, 400));
    options.number("speed", p.speed,
                   drive == Drive::plate
                       ? "speed of the upper plate; that of sound is 1"
                       : "speed of the finished flow in the middle; that of sound is 1",
                   between(1e-6, 0.5));
    options.number("reynolds", p.reynolds,
                   "Reynolds number: speed times distance of the plates by "
                   "the kinematic viscosity",
                   between(0.01, 1e4));
    const bool plate = drive == Drive::plate;
    const Sides sides(options, {"periodic", "periodic", "no-slip", plate ? "moving" : "no-slip"},
                      {.temperatures = false, .own = "moving", .stands_for = "V is --speed"});
    p.sides = &sides;
    options.choice<Density>(
        "density", p.scheme.density, {Density::continuity, Density::summed},
        "by the continuity equation, or as a sum over neighbours; where it is not given, "
        "summed if the left and right sides are not periodic");
    add_friction_option(options, p.friction);
    options.choice<Kernel>("kernel", p.scheme.kernel, all_kernels(), "weight function");
    options.number("range", p.scheme.range, "range h of the weight function", between(1.2, 6.0));
    options.flag("compare", p.compare,
                 "compute half as many and twice as many particles across as well");
    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("cells", p.cells, 10);
        // Stirred between walls on all sides particles lose the densities that continuity gives them.
        if (!session.given("density") && !box_of(p, p.cells).periodic(0))
            p.scheme.density = Density::summed;
        run(session, p, drive);
    });
}

}  // namespace channel
