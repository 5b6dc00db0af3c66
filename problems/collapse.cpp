// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a cold ball falls together by its own gravity, beside the exact motion; 4 s
//
// A ball of particles at rest, of the same density everywhere, falls together by its gravity.
//
//       o o o            cubic lattice of mass and spacing 1, all sites within `radius` of its middle,
//      o o o o o         G = 1,   Phi = -sum_pairs m_i m_j/sqrt(r^2 + eps^2)
//      o o o o o
//       o o o            no pressure: particles are molecules of a dust
//
// A ball of constant density keeps it constant, and all shells fall alike until they meet at one time t_ff:
//     r = R cos^2 q,   t = (2/pi) t_ff (q + sin(2q)/2),   t_ff = (pi/2) sqrt(R^3/2GM)
//
// R is by second moments, R^2 = 5/3 <r^2>. The run ends where the exact radius is half of that at the start. The
// ball of particles is behind: a particle does not attract itself, as the part of space that it stands for would,
// and less so with more particles, N^(-2/3). Softening adds to that.
//
//     --compare       1,208 and 3,648 particles, and the order of the error
#include "common.hpp"
#include <spam/rhs/pair_potentials.hpp>

namespace collapse {
namespace {

using namespace spam;

struct Parameters {
    double radius = 6.6, softening = 0.1;
    bool compare = false;
};

struct Ball : Variant<3> {
    double radius;  ///< by second moments, at the start
    double fall;    ///< t_ff

    /// Of the exact ball, by bisection: time grows with q.
    double exact(double t) const {
        using std::numbers::pi;
        double low = 0.0, high = 0.5 * pi;
        for (int k = 0; k < 60; ++k) {
            const double q = 0.5 * (low + high);
            (2.0 / pi * (q + 0.5 * std::sin(2.0 * q)) * fall < t ? low : high) = q;
        }
        return radius * std::cos(low) * std::cos(low);
    }
    /// When it is half as large.
    double half_time() const { return fall * (0.5 + std::numbers::inv_pi); }
};

double radius_of(const Model<3>& model, std::span<const double> y) {
    const Points<3> x = centred<3>(ConstState<3>(model.layout(), y).position());
    return std::sqrt(5.0 / 3.0 * x.colwise().squaredNorm().mean());
}

Ball make_ball(const Parameters& p, double radius) {
    Ball ball;
    const int cells = 2 * static_cast<int>(std::ceil(radius));
    const Points<3> sites =
        ball_of(centred<3>(cubic_lattice(CubicLattice::sc, {cells, cells, cells})), radius);
    ball.model = std::make_shared<ParticleModel<3>>(one_body(make_particles<3>(sites, 1.0)));
    ball.model->add_term<LongRange<3>>(LongRangeScheme{-1.0, p.softening});
    ball.y0 = initial_state<3>(*ball.model, 1.0, 1.0, at_rest<3>());
    ball.radius = radius_of(*ball.model, ball.y0);
    const auto mass = static_cast<double>(sites.cols());
    ball.fall = 0.5 * std::numbers::pi * std::sqrt(std::pow(ball.radius, 3) / (2.0 * mass));
    ball.model->layout().set_scale(Field::velocity, ball.radius / ball.fall);
    ball.title = fmt::format("{} particles", sites.cols());
    return ball;
}

/// How much larger it is than it should be, in %, by the latest row.
double behind(const Ball& ball, const History& h) {
    return 100.0 * (h.last("radius") / ball.exact(h.last("t")) - 1.0);
}

void report(Session& session, const Parameters& p, const Ball& ball, const RunRecord& run) {
    const Findings findings(session, ball.prefix);
    // What another program found at half the radius.
    const auto size = ball.model->particles().size();
    const bool known = run.complete && !session.common().smoke && !session.given("t-end") &&
                       p.softening == 0.1 && (size == 1208 || size == 3648);
    findings.measure("particles", static_cast<double>(size));
    findings.measure("free_fall_time", ball.fall);
    findings.measure("radius", run.history.last("radius"));
    if (run.history.last("t") < ball.fall)  // behind it there is no exact radius
        findings.claim(
            "behind_percent", behind(ball, run.history), size == 3648 ? 0.92 : 1.85, 0.15,
            known ? "another program, at half the exact radius" : "of the exact radius at the end",
            known);
    findings.check_promises(run);
}

void draw(Session& session, const std::vector<Ball>& balls, const std::vector<RunRecord>& runs) {
    std::vector<CurvePanel> panels{
        frame("radius (dashed: exact)", "t by the time of free fall", "R/R₀"),
        frame("more than the exact one", "t by the time of free fall", "%")};
    for (std::size_t n = 0; n < runs.size(); ++n) {
        const Ball& ball = balls[n];
        const auto t = runs[n].history.column("t"), R = runs[n].history.column("radius");
        Curve found{.title = ball.title, .x = {}, .y = {}}, more = found, exact{"", {}, {}};
        exact.like = static_cast<int>(n) + 1;
        for (std::size_t k = 0; k < t.size(); ++k) {
            const double wanted = ball.exact(t[k]);
            add_point(found, t[k] / ball.fall, R[k] / ball.radius);
            if (!(t[k] < ball.fall)) continue;
            add_point(exact, t[k] / ball.fall, wanted / ball.radius);
            add_point(more, t[k] / ball.fall, 100.0 * (R[k] / wanted - 1.0));
        }
        panels[0].curves.push_back(std::move(found));
        panels[0].curves.push_back(std::move(exact));
        panels[1].curves.push_back(std::move(more));
    }
    draw_curves(session, "radius", "A cold ball falls together by its gravity", panels);
}

void compute(Session& session, const Parameters& p) {
    std::vector<Ball> balls;
    for (const double radius : p.compare ? std::vector{6.6, 9.6} : std::vector{p.radius}) {
        balls.push_back(make_ball(p, radius));
        if (p.compare) balls.back().call(std::to_string(balls.back().model->particles().size()));
    }
    const auto runs = run_all(session, balls, [&](const Ball& ball) {
        Plan<3> plan;
        plan.t_end = session.end(ball.half_time(), 0.2 * ball.fall);
        plan.record({{"radius", radius_of}});
        return plan;
    });
    for (std::size_t n = 0; n < runs.size(); ++n) report(session, p, balls[n], runs[n]);
    if (runs.size() == 2)
        Findings(session).measure(
            "order_in_particles",
            std::log(behind(balls[1], runs[1].history) / behind(balls[0], runs[0].history)) /
                std::log(static_cast<double>(balls[1].model->particles().size()) /
                         static_cast<double>(balls[0].model->particles().size())),
            "- 2/3: a particle does not attract itself");
    if (session.plots()) draw(session, balls, runs);
}

}  // namespace
}  // namespace collapse

int main(int argc, char** argv) {
    using namespace collapse;
    Problem problem("collapse", "a cold ball falls together by its own gravity", 0.0025);
    problem.units(reduced_units("the mass of a particle, the spacing and the constant of gravity"));
    Parameters p;
    auto& options = problem.options();
    options.number("radius", p.radius, "radius of the ball in spacings; 6.6 are 1,208 particles",
                   between(1.0, 60.0));
    options.number(
        "softening", p.softening,
        "eps of the forces, in spacings: particles nearer than that pass through each other",
        between(1e-3, 10.0));
    options.flag("compare", p.compare, "compute 1,208 and 3,648 particles");
    options.exclude("compare", {"radius"}, "has no effect with {by} (two sizes); leave one out");
    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("radius", p.radius, 3.0);
        compute(session, p);
    });
}
