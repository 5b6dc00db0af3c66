// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a bar at rest under a growing load: equilibria without motion, beside damped motion; 2 s
//
// Quasistatic tension: a total-Lagrangian bar is held at one end, and the load on the other grows in steps.
//
//     |o o o o o o o o ->      the first two columns of a triangular lattice are held, on each particle of the last
//     |o o o o o o o o ->      three acts `load`; every state is the equilibrium next to the one before it
//     |o o o o o o o o ->
//
// [HHM04] leaves quasistatic tension to methods that are not explicit. Here Newton's method finds where no particle
// feels a force, with conjugate gradients for its linear equations (study/equilibrium.hpp): 290 right-hand sides
// for 240 particles in one step. --damped does the same with damped leapfrog steps at five frictions, as explicit
// codes do.
// --modes 3: the three lowest frequencies of the loaded bar, by Lanczos' method (study/lowest_modes.hpp).
#include "common.hpp"
#include <spam/external/external.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/study/equilibrium.hpp>
#include <spam/study/lowest_modes.hpp>

namespace loaded_bar {
namespace {

using namespace spam;

struct Parameters {
    int columns = 40, rows = 6, steps = 1, modes = 0;
    double load = 0.002, tolerance = 2e-9;
    bool damped = false;
};

/// A force along x on some particles, which can be changed.
class Pull final : public External<2> {
  public:
    explicit Pull(std::vector<bool> on) : on_(std::move(on)) {}
    void add(const Now& now, Eigen::Index first, Eigen::Index last) const override {
        auto v_dot = now.rate.velocity();
        for (Eigen::Index i = first; i < last; ++i)
            if (on_[static_cast<std::size_t>(i)])
                v_dot(0, i) += force / now.particles.mass[static_cast<std::size_t>(i)];
    }
    std::string describe() const override { return fmt::format("force {:g} on the end", force); }
    double force = 0.0;

  private:
    std::vector<bool> on_;
};

struct Bar {
    std::shared_ptr<ParticleModel<2>> model;
    Pull* pull;
    std::vector<bool> held;
    std::vector<double> y;

    /// Largest displacement along x.
    double tip(std::span<const double> at) const {
        const auto x = ConstState<2>(model->layout(), at).position();
        return (x - model->particles().reference_position).row(0).maxCoeff();
    }
};

Bar make_bar(const Parameters& p) {
    Bar bar;
    bar.model = std::make_shared<ParticleModel<2>>(
        make_particles<2>(triangular_block(p.columns, p.rows), 1.0));
    bar.model->add_term<TotalLagrangian<2>>(
        StVenantKirchhoff::like(ElasticSolid::triangular_lattice()),
        TotalLagrangianScheme{triangular_density, 3.0, 0.1});
    const auto x = bar.model->particles().reference_position.row(0).array();
    std::vector<bool> loaded;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        bar.held.push_back(x[i] < 1.75);
        loaded.push_back(x[i] > x.maxCoeff() - 2.75);
    }
    auto pull = std::make_unique<Pull>(std::move(loaded));
    bar.pull = pull.get();
    bar.model->add(std::move(pull));
    bar.y = lattice_state(*bar.model, at_rest<2>());
    return bar;
}

struct DampedRun {
    std::size_t rhs_evaluations = 0;
    double tip = 0.0;
};

/// Leapfrog steps with friction until no force is left; 0 evaluations where that takes too long.
DampedRun damped(Bar& bar, double friction, double tolerance) {
    constexpr double dt = 0.5;
    constexpr std::size_t most = 200000;
    auto y = bar.y;
    std::vector<double> y_dot(y.size());
    const State<2> state(bar.model->layout(), y), rate(bar.model->layout(), y_dot);
    const auto& mass = bar.model->particles().mass;
    DampedRun run;
    while (++run.rhs_evaluations < most) {
        bar.model->rates(0.0, y, y_dot);
        double force = 0.0;
        for (std::size_t i = 0; i < bar.held.size(); ++i) {
            const auto k = static_cast<Eigen::Index>(i);
            if (bar.held[i]) rate.velocity().col(k).setZero();
            force = std::max(force, mass[i] * rate.velocity().col(k).cwiseAbs().maxCoeff());
        }
        if (force < tolerance) break;
        state.velocity() =
            (1.0 - 0.5 * friction * dt) / (1.0 + 0.5 * friction * dt) * state.velocity() +
            dt / (1.0 + 0.5 * friction * dt) * rate.velocity();
        state.position() += dt * state.velocity();
    }
    if (run.rhs_evaluations >= most) run.rhs_evaluations = 0;
    run.tip = bar.tip(y);
    return run;
}

/// The lowest frequencies of the bar as it is.
void report_modes(Session& session, RunStatistics& statistics, Bar& bar, int count) {
    const LowestModes modes =
        lowest_modes<2>(*bar.model, bar.y, bar.held, static_cast<std::size_t>(count));
    statistics.rhs_evaluations += modes.rhs_evaluations;
    CsvWriter csv(session.folder() / "modes.csv", {"mode", "omega_squared"});
    for (std::size_t k = 0; k < modes.omega_squared.size(); ++k) {
        const double squared = modes.omega_squared[k];
        csv.add(std::vector<double>{static_cast<double>(k + 1), squared});
        session.measure(fmt::format("omega_{}", k + 1),
                        std::copysign(std::sqrt(std::abs(squared)), squared),
                        "of the loaded bar; below 0: a rate of growth");
    }
    session.measure("modes_rhs_evaluations", static_cast<double>(modes.rhs_evaluations),
                    "of the modes");
}

void compute(Session& session, const Parameters& p) {
    Bar bar = make_bar(p);
    const auto free = 2 * std::count(bar.held.begin(), bar.held.end(), false);
    if (p.modes > free)
        refuse("modes: {} is more than the {} motions of the free particles; give fewer", p.modes,
               free);
    RunStatistics& statistics =
        session.begin_analysis({fmt::format("bar         {} x {} particles, load {:g} in {} steps",
                                            p.columns, p.rows, p.load, p.steps)});
    statistics.particles = bar.model->particles().size();
    CsvWriter csv(session.folder() / "equilibria.csv",
                  {"load", "tip", "largest_force", "newton_steps", "rhs_evaluations"});
    Curve curve{.title = "equilibria", .x = {0.0}, .y = {0.0}};
    Equilibrium rest;
    const auto start = bar.y;
    std::size_t evaluations = 0;
    for (int step = 1; step <= p.steps; ++step) {
        bar.pull->force = p.load * step / p.steps;
        rest = equilibrium<2>(*bar.model, bar.y, bar.held, p.tolerance);
        bar.y = rest.y;
        evaluations += rest.rhs_evaluations;
        csv.add(std::vector<double>{bar.pull->force, bar.tip(bar.y), rest.largest_force,
                                    static_cast<double>(rest.newton_steps),
                                    static_cast<double>(rest.rhs_evaluations)});
        add_point(curve, bar.pull->force, bar.tip(bar.y));
    }
    statistics.rhs_evaluations += evaluations;
    const Findings findings(session);
    const double tip = bar.tip(bar.y);
    const bool known =
        p.columns == 40 && p.rows == 6 && p.load == 0.002 && p.tolerance == Parameters{}.tolerance;
    findings.claim("tip", tip, 0.23645, 1e-5, "another program", known);
    findings.check("largest_force", rest.largest_force, 0.0, p.tolerance, "as asked for");
    findings.claim("newton_steps", static_cast<double>(rest.newton_steps), 0.0, 6.0, "at most",
                   known && p.steps == 1);
    findings.claim("rhs_evaluations", static_cast<double>(evaluations), 0.0, 400.0, "at most",
                   known && p.steps == 1);
    if (p.modes > 0) report_modes(session, statistics, bar, p.modes);
    if (p.damped) {
        bar.y = start;
        DampedRun best;
        for (const double friction : {0.0025, 0.005, 0.01, 0.02, 0.04}) {
            const DampedRun run = damped(bar, friction, p.tolerance);
            findings.measure(fmt::format("damped_{:g}", friction),
                             static_cast<double>(run.rhs_evaluations),
                             "right-hand sides; 0: more than 200,000");
            if (run.rhs_evaluations > 0 &&
                (best.rhs_evaluations == 0 || run.rhs_evaluations < best.rhs_evaluations))
                best = run;
        }
        findings.claim("newton_by_damped",
                       static_cast<double>(evaluations) / static_cast<double>(best.rhs_evaluations),
                       0.0, 0.4, "right-hand sides by those of the best friction",
                       known && p.steps == 1);
        findings.claim("damped_tip", best.tip, tip, 1e-4, "the equilibrium",
                       p.tolerance <= Parameters{}.tolerance);
    }
    if (session.plots()) {
        CurvePanel panel =
            frame("tension", "load on each particle of the end", "displacement of the tip");
        panel.curves.push_back(std::move(curve));
        draw_curves(session, "equilibria", "A bar at rest under a growing load", {panel});
    }
}

}  // namespace
}  // namespace loaded_bar

int main(int argc, char** argv) {
    using namespace loaded_bar;
    Problem problem("loaded_bar", "a bar at rest under a growing load");
    problem.units(lattice_units());
    Parameters p;
    auto& options = problem.options();
    options.integer("columns", p.columns, "particles along the bar", between(8, 2000));
    options.integer("rows", p.rows, "particles across the bar", between(2, 200));
    options.number("load", p.load, "force on each particle of the last three columns",
                   between(1e-9, 0.05));
    options.integer("steps", p.steps, "steps in which the load grows", between(1, 1000));
    options.number("tolerance", p.tolerance, "largest force that may be left",
                   between(1e-12, 1e-3));
    options.integer("modes", p.modes, "how many of the lowest frequencies of the loaded bar",
                    between(0, 30));
    options.flag("damped", p.damped, "find the same with damped motion at five frictions");
    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("columns", p.columns, 12);
        compute(session, p);
    });
}
