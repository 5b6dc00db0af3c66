// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a chemical reaction spreads as a front, beside its exact speed; 1 s
//
// A reaction A -> B that spreads by diffusion: c is the share of B in the mass of a particle.
//
//     o o o o o o o o o o          c_dot = D lap c + r c (1 - c)(c - a),   a = 1/4
//     o o o o o o o o o o
//     o o o o o o o o o o          c = 1/(1 + exp((x - s t)/sqrt(2D/r))),   s = sqrt(r D/2)(1 - 2a)
//     c = 1    s ->    c = 0
//
// Fick's flux is a sum over neighbours, and its divergence another one ([HH01]; rhs/reaction.hpp): waves of c are seen
// through the weight function twice. The front is slower than it should be by a part that goes with the square of
// the range by its width, sqrt(8 D/r).
//
// On a lattice that does not move nothing else happens. With --heat the particles are a gas, P = rho e at rest with
// e = 1, and the reaction gives that heat to its energy: pressure waves run ahead, and energy is kept.
//
//     --compare       widths 20, 10 and 5, and the order of the error
#include "common.hpp"
#include <spam/material/gamma_gas.hpp>
#include <spam/rhs/reaction.hpp>
#include <spam/rhs/smooth_particles.hpp>

namespace reaction_front {
namespace {

using namespace spam;

struct Parameters {
    double width = 10.0, threshold = 0.25, heat = 0.0, range = 3.0;
    Kernel kernel = Kernel::lucy;
    int rows = 8;
    bool compare = false;
};

/// Front at x = `start`, in a channel of `length` widths.
constexpr double start = 3.0, length = 12.0;

struct Front : Variant<2> {
    double width, threshold;
    double D() const { return width * width / 8.0; }  // r = 1
    double speed() const { return std::sqrt(0.5 * D()) * (1.0 - 2.0 * threshold); }
    double concentration(double x) const {
        return 1.0 / (1.0 + std::exp((x - start * width) / std::sqrt(2.0 * D())));
    }
};

std::span<const double> concentrations(const Model<2>& model, std::span<const double> y) {
    const double* c = ConstState<2>(model.layout(), y).find(field_kind::concentration);
    return {c, model.particles().size()};
}

Front make_front(const Parameters& p, double width) {
    Front front;
    front.width = width;
    front.threshold = p.threshold;
    front.title = fmt::format("width {:g}", width);
    const int columns = static_cast<int>(std::lround(length * width));
    Box<2> box({0.0, static_cast<double>(p.rows)});
    box.set_wall(0, false, {WallKind::mirror, 0.0});
    box.set_wall(0, true, {WallKind::mirror, static_cast<double>(columns)});
    auto particles = one_body(make_particles<2>(cell_centres<2>({columns, p.rows}), 1.0, 1.0, box));
    const Points<2> x = particles.reference_position;
    front.model = std::make_shared<ParticleModel<2>>(std::move(particles), box);
    if (p.heat != 0.0)
        front.model->add_term<SmoothParticles<2>>(
            Fluid{GammaGas{2.0}},
            Scheme{.density = Density::summed, .kernel = p.kernel, .range = p.range});
    front.model->add_term<Reaction<2>>(
        ReactionScheme{front.D(), 1.0, p.threshold, p.heat, p.kernel, p.range});
    front.y0 = initial_state<2>(*front.model, 1.0, 1.0, at_rest<2>());
    const State<2> state(front.model->layout(), front.y0);
    double* c = state.find(field_kind::concentration);
    for (Eigen::Index i = 0; i < x.cols(); ++i) c[i] = front.concentration(x(0, i));
    if (p.heat != 0.0) state.energy().setOnes();
    return front;
}

Plan<2> plan_of(const Session& session, const Parameters& p, Front& front) {
    Plan<2> plan;
    plan.t_end =
        session.end(0.6 * length * front.width / front.speed(), 0.1 * front.width / front.speed());
    plan.record({{"front", [rows = p.rows](const Model<2>& model, std::span<const double> y) {
                      double sum = 0.0;
                      for (const double c : concentrations(model, y)) sum += c;
                      return sum / rows;
                  }}});
    front.drawn = states_at<2>({0.0, 0.5, 1.0}, plan.t_end);
    plan.observe(keep_nearest<2>(front.drawn, [](const Model<2>& model, std::span<const double> y) {
        const auto c = concentrations(model, y);
        return std::vector<double>(c.begin(), c.end());
    }));
    return plan;
}

/// By the exact one, from the second half of the rows.
double speed_of(const Front& front, const History& h) {
    const auto t = h.column("t"), x = h.column("front");
    const std::size_t from = t.size() / 2;
    if (t.size() - from < 3) return 0.0;
    return fit_line(std::span(t).subspan(from), std::span(x).subspan(from)).slope / front.speed();
}

void report(Session& session, const Parameters& p, const Front& front, const RunRecord& run) {
    const Findings findings(session, front.prefix);
    const History& h = run.history;
    const double others = front.width == 10.0 ? 0.990 : 0.963;
    const bool known = run.complete && !session.common().smoke && !session.given("t-end") &&
                       h.rows().size() >= 12 && p.heat == 0.0 &&
                       (front.width == 10.0 || front.width == 5.0) &&
                       session.at_default({"threshold", "kernel", "range"});
    findings.claim("speed_ratio", speed_of(front, h), known ? others : 1.0, 0.005,
                   known ? "by the exact one; expected: another program" : "by the exact one",
                   known);
    findings.check_promises(run);
}

void draw(Session& session, const std::vector<Front>& fronts, const std::vector<RunRecord>& runs) {
    std::vector<CurvePanel> panels;
    for (std::size_t n = 0; n < runs.size(); ++n) {
        CurvePanel panel = frame(fronts[n].title + " (line: exact)", "x", "c");
        for (const auto& state : fronts[n].drawn) {
            if (!state.there()) continue;
            Curve found{fmt::format("t = {:.3g}", state.t), {}, {}, Mark::points},
                exact{"", {}, {}};
            exact.like = static_cast<int>(panel.curves.size() / 2) + 1;
            for (Eigen::Index i = 0; i < state.position.cols(); ++i)
                add_point(found, state.position(0, i), state.values[static_cast<std::size_t>(i)]);
            for (double x = 0.0; x <= length * fronts[n].width; x += 0.05 * fronts[n].width)
                add_point(exact, x, fronts[n].concentration(x - fronts[n].speed() * state.t));
            panel.curves.push_back(std::move(found));
            panel.curves.push_back(std::move(exact));
        }
        panels.push_back(std::move(panel));
    }
    draw_curves(session, "front", "A reaction spreads", panels);
}

void compute(Session& session, const Parameters& p) {
    std::vector<Front> fronts;
    for (const double width : p.compare ? std::vector{20.0, 10.0, 5.0} : std::vector{p.width}) {
        fronts.push_back(make_front(p, width));
        if (p.compare) fronts.back().call(fmt::format("width_{:g}", width));
    }
    const auto runs =
        run_all(session, fronts, [&](Front& front) { return plan_of(session, p, front); });
    for (std::size_t n = 0; n < runs.size(); ++n) report(session, p, fronts[n], runs[n]);
    if (runs.size() == 3) {
        const auto slower = [&](std::size_t n) {
            return 1.0 - speed_of(fronts[n], runs[n].history);
        };
        Findings(session).measure("order",
                                  std::log2((slower(2) - slower(1)) / (slower(1) - slower(0))),
                                  "of what the width changes");
    }
    if (session.plots()) draw(session, fronts, runs);
}

}  // namespace
}  // namespace reaction_front

int main(int argc, char** argv) {
    using namespace reaction_front;
    Problem problem("reaction_front", "a chemical reaction spreads as a front", 0.05);
    problem.units(
        reduced_units("the mass of a particle, the spacing and the rate of the reaction"));
    Parameters p;
    auto& options = problem.options();
    options.number("width", p.width, "width of the front, sqrt(8 D/r), in spacings; r is 1",
                   between(2.0, 100.0));
    options.number("threshold", p.threshold, "a: below this concentration B goes back to A",
                   between(0.0, 0.45));
    options.number("heat", p.heat,
                   "heat of the reaction by mass: the particles are then a gas with e = 1",
                   between(0.0, 10.0));
    options.choice<Kernel>("kernel", p.kernel, all_kernels(), "weight function");
    options.number("range", p.range, "range h of the weight function", between(1.5, 6.0));
    options.integer("rows", p.rows, "particles across the channel, which is periodic there",
                    between(1, 200));
    options.flag("compare", p.compare, "compute widths 20, 10 and 5");
    options.exclude("compare", {"width", "heat"}, "has no effect with {by}; leave one out");
    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("width", p.width, 4.0);
        compute(session, p);
    });
}
