// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a drop of liquid that flies apart breaks into pieces and vapour, [HH01]; 5 s
//
// "The breakup of a cavitating fluid", [HH01]: a disk of van der Waals' liquid in the void, every particle of which
// moves away from the middle, the faster the farther out it is.
//
//         o o o               triangular lattice within `radius` of its middle, of the density of the liquid that is
//       o o o o o  ->         in equilibrium with its vapour; v = gamma r
//        o o o o o  ->
//         o o o               m v_dot_i = -d Phi/d r_i,   Phi = sum_i m e(rho_i),
//                             e = -T ln((1 - b rho)/(b rho)) - a rho,   P = rho T/(1 - b rho) - a rho^2
//
// Where it is slow the liquid holds together, and swings. Faster, its density falls below that at which the liquid
// bears the largest tension (spinodal), and it breaks: into a few pieces, into many small ones, and then into vapour
// alone. Runs last 3/gamma. A piece is linked by pairs nearer than 1, the spacing of particles at the critical
// density, and counts where it has ten particles or more: in the vapour there are pairs and small groups as well.
// vapour: the share of particles whose density is below the critical one.
//
//     --compare       gamma from 0.015 to 0.4, five seeds of each (--samples), means and deviations; 2 min
#include "breaking/pieces.hpp"
#include "van_der_waals.hpp"

namespace cavitating_drop {
namespace {

using namespace spam;

struct Parameters : VanDerWaalsMatter {
    Parameters() : VanDerWaalsMatter{0.6, 3.0} {}

    double radius = 22.0, rate = 0.07;
    double disorder = 0.05;
    int seed = 1;
    std::optional<int> samples;
    bool compare = false;

    double density() const { return coexistence(law()).liquid; }
    double spacing() const { return std::sqrt(triangular_density / density()); }
};

constexpr std::size_t least = 10;  // particles of a piece
constexpr double reach = 1.0;      // of pairs in one

/// Pieces and share of vapour at the end, by another program: means of several seeds.
struct Known {
    double rate;
    std::optional<double> pieces;
    double pieces_tolerance;
    std::optional<double> vapour;
    double vapour_tolerance;
};
const std::vector<Known> all_known{{0.015, 1.0, 0.0, {}, 0.0},  {0.035, 11.0, 3.0, {}, 0.0},
                                   {0.05, 37.5, 7.5, {}, 0.0},  {0.07, 75.0, 10.0, {}, 0.0},
                                   {0.1, 112.5, 12.5, {}, 0.0}, {0.4, {}, 0.0, 0.95, 0.05}};

struct Drop : Variant<2> {
    double rate;
};

Drop make_drop(const Parameters& p, double rate, int seed) {
    Drop drop;
    drop.rate = rate;
    drop.title = fmt::format("γ = {:g}", rate);
    const double d = p.spacing();
    auto particles = one_body(make_particles<2>(triangular_disk(p.radius, d), 1.0, d));
    Points<2> x = particles.reference_position;
    displace(x, p.disorder * d, seed);
    x = centred<2>(x);
    drop.model = std::make_shared<DensityPotentialModel<2>>(std::move(particles), p.potentials());
    drop.y0 = initial_state<2>(*drop.model, p.density(), 1.0, at_rest<2>());
    const State<2> state(drop.model->layout(), drop.y0);
    state.position() = x;
    state.velocity() = rate * x;
    drop.model->layout().set_scale(Field::velocity, rate * p.radius);
    return drop;
}

double vapour_share(const Model<2>& model, std::span<const double> y) {
    const auto rho = model.density(y);
    const auto thin =
        std::count_if(rho.begin(), rho.end(), [](double one) { return one < critical_density; });
    return static_cast<double>(thin) / static_cast<double>(rho.size());
}

double step_of(double rate) { return 0.05 * relative_step(rate, 0.3); }

Plan<2> plan_of(const Session& session, const Parameters& p, Drop& drop) {
    using State = std::span<const double>;
    Plan<2> plan;
    plan.t_end = session.end(3.0 / drop.rate, 0.15 / drop.rate);
    if (p.compare)
        plan.step = step_of(drop.rate) * step_of_short_range(p.range, Parameters{}.range);
    plan.record(
        {{"pieces",
          [](const Model<2>& model, State y) {
              return static_cast<double>(
                  breaking::piece_sizes(model, y, least, reach / model.particles().spacing).size());
          }},
         {"vapour", vapour_share}});
    drop.drawn = states_at<2>({0.0, 1.0 / 6.0, 0.5, 1.0}, plan.t_end);
    plan.observe(keep_nearest<2>(drop.drawn,
                                 [](const Model<2>& model, State y) { return model.density(y); }));
    return plan;
}

// ---- what was found ----

bool is_known(const Session& session, const RunRecord& run, double rate) {
    return session.when_default({"radius", "temperature", "kernel", "range", "disorder"}) &&
           run.complete && run.statistics.t_end >= 2.99 / rate;
}

void report(Session& session, const Drop& drop, const RunRecord& run) {
    const Findings findings(session, drop.prefix);
    findings.measure("particles", static_cast<double>(run.statistics.particles));
    findings.measure_last(run.history, {"pieces", "vapour"});
    const bool known = is_known(session, run, drop.rate) && drop.rate <= 0.1;
    for (const Drift& drift : run.drifts)
        if (drift.name == "energy")
            findings.claim(
                "energy_change_per_particle",
                drift.change * drift.scale / static_cast<double>(run.statistics.particles), 0.0,
                1e-4, "forces of a potential", known);
    findings.check_promises(run);
}

/// What each run has for the most part at its end: the median over the last tenth of its time. A thin place of a drop
/// that holds together is counted as a gap in one row, and as none in the next.
std::vector<double> usual_at_end(const std::vector<RunRecord>& runs, std::string_view column) {
    std::vector<double> values;
    for (const auto& run : runs) {
        auto rows = run.history.column(column);
        const auto t = run.history.column("t");
        rows.erase(rows.begin(),
                   rows.begin() + (std::ranges::lower_bound(t, 0.9 * t.back()) - t.begin()));
        const auto middle = rows.begin() + static_cast<std::ptrdiff_t>(rows.size() / 2);
        std::ranges::nth_element(rows, middle);
        values.push_back(*middle);
    }
    return values;
}

/// Means over the seeds of every rate, in their order.
void report_rates(Session& session, const std::vector<Drop>& drops,
                  const std::vector<RunRecord>& runs, std::size_t seeds) {
    double vapour_before = -1.0, least_growth = HUGE_VAL;
    for (std::size_t k = 0; k + seeds <= runs.size(); k += seeds) {
        const double rate = drops[k].rate;
        const Findings findings(session, fmt::format("rate_{:g}_", rate));
        const auto known = std::find_if(all_known.begin(), all_known.end(), [&](const Known& one) {
            return one.rate == rate && seeds >= 5 && is_known(session, runs[k], rate);
        });
        const auto of_seeds = [&](const char* column, std::optional<double> expected,
                                  double tolerance) {
            const auto values = usual_at_end(runs, column);
            const OfSeeds all({values.begin() + static_cast<std::ptrdiff_t>(k),
                               values.begin() + static_cast<std::ptrdiff_t>(k + seeds)});
            findings.claim(fmt::format("{}_mean", column), all.mean, expected.value_or(0.0),
                           tolerance,
                           expected ? "another program" : fmt::format("of {} seeds", seeds),
                           expected.has_value());
            findings.measure(fmt::format("{}_deviation", column), all.deviation, "of one seed");
            return all.mean;
        };
        const bool there = known != all_known.end();
        of_seeds("pieces", there ? known->pieces : std::nullopt,
                 there ? known->pieces_tolerance : 0.0);
        const double vapour = of_seeds("vapour", there ? known->vapour : std::nullopt,
                                       there ? known->vapour_tolerance : 0.0);
        if (k > 0) least_growth = std::min(least_growth, vapour - vapour_before);
        vapour_before = vapour;
    }
    if (std::isfinite(least_growth))
        Findings(session).claim("vapour_grows", least_growth > 0.0 ? 1.0 : 0.0, 1.0, 0.0,
                                "the share of vapour grows with gamma throughout",
                                is_known(session, runs.front(), drops.front().rate));
}

void draw(Session& session, const std::vector<Drop>& drops, const std::vector<RunRecord>& runs,
          std::size_t seeds) {
    std::vector<ConfigurationPanel> panels;
    const auto add = [&panels](const Drop& drop, const NearestState<2>& state) {
        if (state.there())
            panels.push_back({fmt::format("{}, γt = {:.2g}", drop.title, drop.rate * state.t),
                              state.position,
                              state.values,
                              {}});
    };
    if (runs.size() > seeds)  // the rates between the slowest and the fastest
        for (std::size_t k = seeds; k + seeds < runs.size(); k += seeds)
            add(drops[k], drops[k].drawn[2]);
    else
        for (const auto& state : drops.front().drawn) add(drops.front(), state);
    draw_configurations(session, "configurations", "A drop of liquid flies apart", panels, 2,
                        "density");
    CurvePanel pieces = frame("", "γt", "pieces"), vapour = frame("", "γt", "share of vapour");
    for (std::size_t k = 0; k < runs.size(); k += seeds)
        for (auto* panel : {&pieces, &vapour}) {
            Curve curve =
                over_time(drops[k].title, runs[k].history, panel == &pieces ? "pieces" : "vapour");
            curve.x = divided(curve.x, 1.0 / drops[k].rate);
            panel->curves.push_back(std::move(curve));
        }
    draw_curves(session, "pieces", "A drop of liquid flies apart", {pieces, vapour});
}

void compute(Session& session, const Parameters& p) {
    const int seeds = p.samples.value_or(p.compare ? 5 : 1);
    std::vector<Drop> drops;
    std::vector<double> rates{p.rate};
    if (p.compare) {
        rates.clear();
        for (const Known& one : all_known) rates.push_back(one.rate);
    }
    for (const double rate : rates)
        for (int k = 0; k < seeds; ++k) {
            drops.push_back(make_drop(p, rate, p.seed + k));
            if (p.compare)
                drops.back().call(fmt::format("rate_{:g}_seed_{}", rate, p.seed + k));
            else if (seeds > 1)
                drops.back().call(fmt::format("seed_{}", p.seed + k));
        }
    const auto runs =
        run_all(session, drops, [&](Drop& drop) { return plan_of(session, p, drop); });
    for (std::size_t k = 0; k < runs.size(); ++k) report(session, drops[k], runs[k]);
    if (seeds > 1) report_rates(session, drops, runs, static_cast<std::size_t>(seeds));
    if (session.plots() && runs.size() == drops.size())
        draw(session, drops, runs, static_cast<std::size_t>(seeds));
}

void add_options(Options& options, Parameters& p) {
    options.number("rate", p.rate, "gamma, velocity at the start by distance from the middle",
                   between(1e-3, 10.0));
    options.flag("compare", p.compare, "compute six rates, from 0.015 to 0.4");
    options.exclude("compare", {"rate"},
                    "has no effect with {by}, which has six rates; leave one out");
    options.integer(
        "samples", p.samples,
        "number of runs, of seeds one after the other (default: 1; with --compare 5 of each rate)",
        between(1, 25));
    options.number("radius", p.radius,
                   "radius of the drop; at the critical density a particle has the area 1",
                   between(3.0, 300.0));
    p.add_options(options);
    add_disorder_options(options, p.disorder, p.seed,
                         "largest random displacement from the lattice, in spacings", 0.5, "0.05");
}

}  // namespace
}  // namespace cavitating_drop

int main(int argc, char** argv) {
    using namespace cavitating_drop;
    Problem problem("cavitating_drop", "a drop of liquid flies apart, [HH01]", 0.05,
                    "0.05, shorter where the drop flies apart faster");
    problem.units(van_der_waals_units());
    Parameters p;
    add_options(problem.options(), p);
    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("radius", p.radius, 6.0);
        p.refuse_one_phase();
        if (!(p.range > p.spacing()))
            refuse(
                "range: {:g} must lie above the spacing {:.3g} of the liquid (else no particle has a "
                "neighbour); 4 "
                "spacings are usual",
                p.range, p.spacing());
        session.prefer_step(step_of(p.rate) * step_of_short_range(p.range, Parameters{}.range));
        compute(session, p);
    });
}
