// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: smooth-particle fluids that move like molecules, until rounding errors have grown; 8 s
//
// Isomorphisms, [HH01] and [HH07] 6: with the right equation of state smooth particles ARE molecules.
//
//     Lucy gas        P = rho^2/2                            pair potential  m^2 w(r)
//     embedded atom   P = B0 (rho^3/rho0^3 - rho^2/rho0^2)   potential       sum m e(rho),
//                                                            e = (B0/2 rho0) (rho/rho0 - 1)^2
//
//     + + + + +      A square lattice in a periodic box, the same velocities at random in three systems:
//     + + + + +      the fluid (density summed, pressure, energy integrated), the molecules (forces of
//     + + + + +      the potential; another model, other sums), and the molecules once more, one of them
//     + + + + +      moved by `perturbation`. They are parts of one model and take the same steps.
//
// Fluid and molecules differ by rounding. In a chaotic system every difference grows like
// exp(lambda t), lambda the largest Lyapunov exponent: that of rounding as fast as that of the moved
// molecule.
#include "common.hpp"
#include <spam/material/embedded_atom.hpp>
#include <spam/rhs/density_potentials.hpp>
#include <spam/rhs/pair_potentials.hpp>

namespace {

using namespace spam;

enum class Law { both, lucy, embedded_atom };

std::string_view to_string(Law law) {
    return law == Law::both ? "both" : law == Law::lucy ? "lucy" : "embedded_atom";
}

struct Parameters {
    Law law = Law::both;
    int cells = 16;
    double speed = 0.3, range = 3.0, perturbation = 1e-8;
};

constexpr std::size_t fluid = 0, molecules = 1, moved = 2;

/// Components even between -1 and 1, their mean taken off, then `speed` in the root mean square.
Points<2> random_velocities(Eigen::Index n, double speed) {
    std::mt19937_64 random(6);
    Points<2> v(2, n);
    for (auto& c : v.reshaped()) c = 2.0 * drawn(random) - 1.0;
    v.colwise() -= v.rowwise().mean().eval();
    return speed * std::sqrt(static_cast<double>(n) / v.squaredNorm()) * v;
}

using Experiment = Variant<2>;

/// The same particles three times, one set behind the other.
Particles<2> three_times(const Particles<2>& one) {
    const auto n = static_cast<std::int64_t>(one.size());
    Particles<2> all{.reference_position = one.reference_position.replicate(1, 3),
                     .spacing = one.spacing};
    for (const std::int64_t k : {0, 1, 2}) {
        all.mass.insert(all.mass.end(), one.mass.begin(), one.mass.end());
        all.body.insert(all.body.end(), one.body.begin(), one.body.end());
        for (const std::int64_t id : one.id) all.id.push_back(id + k * n);
    }
    return all;
}

/// A fluid and twice its molecules: terms among a third of the particles each.
Experiment prepare(const Parameters& p, Law law) {
    const double side = p.cells;
    const Box<2> box({side, side});
    const auto particles = make_particles<2>(square_lattice<2>({p.cells, p.cells}), 1.0, 1.0, box);
    const std::size_t n = particles.size();
    const Scheme scheme{.density = Density::summed, .range = p.range};
    const Fluid matter = law == Law::lucy ? Fluid{LucyGas{}} : Fluid{EmbeddedAtom{}};

    Experiment e;
    if (p.law == Law::both) e.call(std::string(to_string(law)));
    e.title = law == Law::lucy ? "Lucy gas" : "embedded atoms";
    e.model = std::make_shared<ParticleModel<2>>(three_times(particles), box);
    e.model->add_term_among<SmoothParticles<2>>(fluid * n, n, matter, scheme);
    for (const std::size_t k : {molecules, moved})
        if (law == Law::lucy)
            e.model->add_term_among<WeightPotential<2>>(k * n, n, p.range);
        else
            e.model->add_term_among<DensityPotentialTerm<2>>(
                k * n, n, DensityPotentials{.state = EmbeddedAtom{}, .range = p.range});

    const Points<2> x = particles.reference_position;
    const Points<2> v = random_velocities(x.cols(), p.speed);
    FluidModel<2> alone(particles, matter, scheme, box);
    const auto y_fluid = alone.state(x, v);
    e.y0.assign(e.model->layout().size(), 0.0);
    const State<2> all(e.model->layout(), e.y0);
    all.position() = x.replicate(1, 3);
    all.velocity() = v.replicate(1, 3);
    all.part(fluid * n, n).energy() = ConstState<2>(alone.layout(), y_fluid).energy();
    all.part(moved * n, n).position()(0, 0) += p.perturbation;
    for (const Field field : {Field::position, Field::velocity, Field::energy})
        e.model->layout().set_scale(field, alone.layout().find(field)->scale);
    return e;
}

/// sqrt of the mean square distance between the particles of two of the three systems.
Column<2> separation_column(const char* name, std::size_t a, std::size_t b) {
    return {name, [a, b](const Model<2>& model, std::span<const double> y) {
                const std::size_t n = model.particles().size() / 3;
                const ConstState<2> all(model.layout(), y);
                const Points<2> r = all.part(a * n, n).position() - all.part(b * n, n).position();
                return std::sqrt(r.squaredNorm() / static_cast<double>(n));
            }};
}

/// Exponential growth while a separation is far above where it began and far below the spacing: the rows
/// from the last below `low` to the first above `high`.
std::optional<LineFit> growth(const History& h, const char* column, double low, double high) {
    const auto t = h.column("t"), d = h.column(column);
    std::size_t begin = 0, end = 0;
    while (end < d.size() && d[end] < high) ++end;
    for (std::size_t k = 0; k < end; ++k)
        if (d[k] < low) begin = k + 1;
    if (end == d.size() || end < begin + 5) return {};
    std::vector<double> time(t.begin() + static_cast<std::ptrdiff_t>(begin),
                             t.begin() + static_cast<std::ptrdiff_t>(end)),
        log_d;
    for (std::size_t k = begin; k < end; ++k) log_d.push_back(std::log(d[k]));
    return fit_line(time, log_d);
}

struct Growth {
    std::optional<LineFit> rounding, moved;
};

Growth measure(const History& h) {
    return {growth(h, "separation", 1e-12, 1e-3), growth(h, "separation_moved", 1e-6, 1e-2)};
}

void report(Session& session, const Parameters& p, const Experiment& e, const RunRecord& run) {
    const Findings findings(session, e.prefix);
    const History& h = run.history;
    findings.check_promises(run);
    // Claimed where the exponent is known to leave ten orders of magnitude to t = 10.
    const bool known = p.speed <= 0.5 && p.range >= 2.5 && p.range <= 4.0;
    if (h.last("t") >= 10.0)
        findings.claim("separation_at_10", h.at(10.0, "separation"), 0.0, 1e-10,
                       "the same motion up to rounding, [HH07] 6", known);
    const Growth found = measure(h);
    if (found.moved)
        findings.measure("lyapunov_exponent", found.moved->slope,
                         "measured: growth of a displacement");
    // Slow molecules stay near their lattice for long, and the two growths are not those of one motion.
    const bool mixed = p.speed >= 0.1;
    if (found.rounding && found.moved)
        findings.claim("divergence_rate", found.rounding->slope, found.moved->slope,
                       0.15 * found.moved->slope, "rounding grows at the Lyapunov exponent",
                       mixed && p.perturbation <= 1e-6);
}

Curve fitted(const History& h, const char* column, const std::optional<LineFit>& fit, int like) {
    Curve line{"", {}, {}, Mark::line, 0, like};
    if (!fit) return line;
    const auto t = h.column("t");
    for (const double time : {t.front(), t.back()}) {
        add_point(line, time, std::exp(fit->intercept + fit->slope * time));
    }
    // Only where there is something to compare with.
    const double low = 0.3 * std::max(h.smallest(column), 1e-16), high = 3.0 * h.largest(column);
    for (std::size_t k = 0; k < 2; ++k) {
        const double y = std::clamp(line.y[k], low, high);
        line.x[k] = (std::log(y) - fit->intercept) / fit->slope;
        line.y[k] = y;
    }
    return line;
}

void draw(Session& session, const std::vector<Experiment>& experiments,
          const std::vector<RunRecord>& runs) {
    std::vector<CurvePanel> panels;
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const History& h = runs[k].history;
        const Growth found = measure(h);
        CurvePanel panel = over_time(
            experiments[k].title, h, "rms distance",
            {{"fluid and molecules", "separation"}, {"molecules, one moved", "separation_moved"}},
            true);
        panel.curves.push_back(fitted(h, "separation", found.rounding, 1));
        panel.curves.push_back(fitted(h, "separation_moved", found.moved, 2));
        if (found.rounding && found.moved)
            panel.title +=
                fmt::format(": λ = {:.3f} and {:.3f}", found.rounding->slope, found.moved->slope);
        panels.push_back(panel);
    }
    draw_curves(session, "divergence",
                "Smooth particles and molecules part at the Lyapunov exponent", panels);
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("isomorphism", "smooth-particle fluids that move like molecules, [HH07] 6",
                    0.05);
    problem.units(fluid_units());
    Parameters p;
    auto& options = problem.options();
    options.choice<Law>("law", p.law, {Law::both, Law::lucy, Law::embedded_atom},
                        "the gas of Lucy's potential, embedded atoms, or both");
    options.integer("cells", p.cells, "n x n particles at spacing 1", between(4, 400));
    options.number("speed", p.speed, "root mean square of the initial velocities",
                   between(1e-6, 1.0));
    options.number("range", p.range, "range h of Lucy's weight function", between(1.2, 20.0));
    options.number("perturbation", p.perturbation,
                   "initial displacement of one molecule of the second copy", between(1e-12, 1e-2));

    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("cells", p.cells, 8);
        if (p.cells <= 2.0 * p.range)
            refuse(
                "cells: a box of {} must be wider than twice the range {:g}; give at least {} "
                "cells, or a shorter --range",
                p.cells, p.range, static_cast<int>(2.0 * p.range) + 1);
        // Short ranges have steep slopes.
        session.prefer_step(0.05 * std::min(1.0, p.range / 2.0));
        std::vector<Experiment> experiments;
        for (const Law law : {Law::lucy, Law::embedded_atom})
            if (p.law == law || p.law == Law::both) experiments.push_back(prepare(p, law));
        const auto runs = run_all(session, experiments, [&](const Experiment&) {
            Plan<2> plan;
            plan.t_end = session.end(200.0, 12.0);
            plan.output_every = 0.5;
            plan.record({separation_column("separation", fluid, molecules),
                         separation_column("separation_moved", molecules, moved)});
            return plan;
        });
        for (std::size_t k = 0; k < runs.size(); ++k) report(session, p, experiments[k], runs[k]);
        if (session.plots()) draw(session, experiments, runs);
    });
}
