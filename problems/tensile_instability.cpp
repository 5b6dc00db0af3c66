// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: tensile instability of a stretched lattice, disturbed by one particle, [HHM04] Fig. 1; 6 s
//
// Tensile instability, [HHM04] IV and Fig. 1.
//
//       o   o   o   o        A periodic triangular lattice of cells x cells smooth particles, at
//         o   o   o          rest under hydrostatic tension. One particle gets the speed 1e-10,
//       o   o ↑ o   o        across the rows. The lattice should ring; with plain velocities its
//         o   o   o          kinetic energy K grows by many orders of magnitude instead, until the
//                            particles have clumped. Averaged velocities stop that for hundreds of
//                            collision times, though not for ever.
//
//     v_dot = sum m (sigma_i/rho_i^2 + sigma_j/rho_j^2) . grad w_ij     sigma = s I, s > 0: attraction
//
// The linear analysis (analysis/lattice_modes.hpp) foretells K(t) as a sum over all wave vectors
// of the sample, without anything fitted, and in the end d ln K/dt = 2 x the largest growth rate.
// The measured rate is the slope of a line through log K where the fastest waves have taken over and
// the motion is still linear: from where the sum's own d ln K/dt has come within 3 % of its limit,
// up to where a particle has moved by 2 % of the spacing. (In a 24 x 24 sample many waves grow
// almost as fast as the fastest; 1 % would come too late.)
// Without --stress and scheme options it draws the figure: tension 0.01 and 0.02, and
// <v>_Monaghan at 0.02. Names in result.json without a prefix belong to plain velocities at 0.02.
//
// --dimension 3 --lattice sc, fcc or bcc: a cubic lattice in space of cells^3 of its cells, one particle kicked
// along z. The range is 2 unless --range says another: at 3 waves grow three to eight times more slowly, and with
// averaged velocities at a fourteenth of the rate of plain ones, at 2 at 0.56 (sc) or 0.31 (fcc, bcc) of it. The run
// ends where the slowest of plain velocities has left the linear motion, at 450 the latest. Components of the
// fastest wave vector are in pi by the edge of a cell.
#include "tensile_instability/sample.hpp"

namespace {

using namespace spam;
using namespace tensile_instability;

constexpr double taken_over = 0.03;  // d ln K/dt this near to its limit
constexpr double linear = 0.02;      // largest displacement, in spacings
// Where a shell of neighbours lies at the range (h = 3), forces have terms in |displacement| times
// displacement: compressed, K is off by 5 % at 0.005, stretched by 0.1 % at 0.02.
constexpr double tiny = 5e-4;
constexpr double grows = 1e-5;  // growth rates below are round-off

template <int Dim>
Column<Dim> largest_displacement_column() {
    return {"largest_displacement", [](const Model<Dim>& model, std::span<const double> y) {
                const auto moved = ConstState<Dim>(model.layout(), y).position() -
                                   model.particles().reference_position;
                return moved.colwise().norm().maxCoeff() / model.particles().spacing;
            }};
}

// ---- what was found ----

/// Rows [first, last) of a run in which the motion is linear, and from `fastest` on the fastest
/// growing waves have taken over.
struct Window {
    std::size_t fastest, last;
    bool long_enough() const { return last >= fastest + 5; }
};

template <int Dim>
Window window_of(const Sample<Dim>& sample, const History& h) {
    const auto t = h.column("t"), moved = h.column("largest_displacement");
    Window window{0, 0};
    while (window.last < t.size() && moved[window.last] < linear) ++window.last;
    const double limit = 2.0 * sample.linear->fastest_rate();
    for (std::size_t r = 0; r < window.last; ++r)
        if (std::abs(sample.linear->kinetic_rate(t[r]) - limit) > taken_over * limit)
            window.fastest = r + 1;
    return window;
}

double slope_of_log(const std::vector<double>& t, std::vector<double> K, const Window& window) {
    for (double& value : K) value = std::log(value);
    const std::size_t n = window.last - window.fastest;
    return fit_line(std::span(t).subspan(window.fastest, n),
                    std::span(K).subspan(window.fastest, n))
        .slope;
}

template <int Dim>
void report(Session& session, const Parameters& p, const Sample<Dim>& sample,
            const RunRecord& run) {
    const Findings findings(session, sample.prefix);
    const History& h = run.history;
    const auto t = h.column("t"), K = h.column("kinetic"), moved = h.column("largest_displacement");
    const auto check = [&](const char* name, double value, std::optional<double> expected,
                           double tolerance, const char* source) {
        findings.check(name, value, expected, tolerance, source);
    };
    // The whole curve, as long as it is linear.
    const Window window = window_of(sample, h);
    std::vector<double> predicted;
    double error = 0.0;
    for (std::size_t r = 0; r < t.size(); ++r) {
        predicted.push_back(sample.linear->kinetic(t[r]));
        if (r < window.last && moved[r] < tiny)
            error = std::max(error, std::abs(K[r] / predicted[r] - 1.0));
    }
    check("kinetic_error_against_all_modes", error, 0.0, 0.02, "linear analysis, all wave vectors");
    // Its end.
    const double limit = 2.0 * sample.linear->fastest_rate();
    if (window.long_enough() && limit > grows) {
        const double rate = slope_of_log(t, K, window);
        if (sample.stress > 0.0)
            check("kinetic_growth_rate", rate, limit, 0.03 * limit,
                  "linear analysis, fastest wave vector of the sample");
        else
            findings.measure("kinetic_growth_rate", rate);
        findings.measure("kinetic_growth_rate_predicted", limit);
        findings.measure("kinetic_growth_rate_all_modes", slope_of_log(t, predicted, window));
        findings.measure("window_begin", t[window.fastest]);
        findings.measure("window_end", t[window.last - 1]);
    } else {
        findings.measure("kinetic_growth_rate_predicted", limit > grows ? limit : 0.0);
    }
    double ratio = 0.0;
    for (std::size_t r = 0; r < t.size(); ++r)
        if (t[r] <= 400.0) ratio = std::max(ratio, K[r] / K.front());
    const Scheme& scheme = sample.model->scheme();
    if (Dim == 2 && scheme == Scheme{.transport = Transport::monaghan} && p.cells == 24 &&
        sample.stress == 0.02 && t.back() >= 400.0)
        check("largest_kinetic_ratio", ratio, 2.5, 0.5,
              "[HHM04] Fig. 1: no instability to t = 400");
    else
        findings.measure("largest_kinetic_ratio", ratio);
    if (limit > grows) findings.measure("growth_time", 2.0 / limit);
    const Point<Dim> k = shortest(p, sample.linear->fastest());
    for (int a = 0; a < Dim; ++a)
        findings.measure(fmt::format("fastest_k_{}", "xyz"[a]), limit > grows ? k[a] : 0.0);
}

/// Measured and foretold side by side.
template <int Dim>
void write_comparison(const RunFolder& folder, const std::vector<Sample<Dim>>& samples,
                      const std::vector<RunRecord>& runs) {
    std::vector<std::string> names{"t"};
    for (std::size_t n = 0; n < runs.size(); ++n)
        for (const char* what : {"kinetic", "kinetic_predicted", "kinetic_rate_predicted"})
            names.push_back(samples[n].label.empty() ? what : samples[n].label + "_" + what);
    CsvWriter csv(folder / "comparison.csv", names);
    for (const double t : runs.front().history.column("t")) {
        std::vector<double> row{t};
        for (std::size_t n = 0; n < runs.size(); ++n) {
            row.push_back(runs[n].history.at(t, "kinetic"));
            row.push_back(samples[n].linear->kinetic(t));
            row.push_back(samples[n].linear->kinetic_rate(t));
        }
        csv.add(row);
    }
}

/// K(t) and the straight line of the fastest wave, which touches it where the linear motion ends.
template <int Dim>
void add_kinetic(CurvePanel& panel, const Sample<Dim>& sample, const History& h, int own) {
    const auto t = h.column("t"), K = h.column("kinetic");
    panel.curves.push_back({sample.title, t, K});
    const std::size_t end = std::max<std::size_t>(window_of(sample, h).last, 1) - 1;
    const double limit = 2.0 * sample.linear->fastest_rate();
    Curve line{"", {}, {}, Mark::line, 0, own};
    for (std::size_t r = 0; r < t.size() && limit > grows; ++r) {
        const double straight = K[end] * std::exp(limit * (t[r] - t[end]));
        if (straight < 0.1 * K.front() || t[r] > 1.05 * t[end]) continue;
        add_point(line, t[r], straight);
    }
    panel.curves.push_back(std::move(line));
}

/// d ln K/dt between rows, and its limit.
template <int Dim>
void add_rate(CurvePanel& panel, const Sample<Dim>& sample, const History& h, int own) {
    const auto t = h.column("t"), K = h.column("kinetic");
    Curve rate{sample.title, {}, {}}, limit{"", {}, {}, Mark::line, 0, own};
    // At the short range of space what clumps rebounds, and would hide the rest.
    const std::size_t end = Dim == 2 ? t.size() : window_of(sample, h).last;
    for (std::size_t r = 1; r < end; ++r) {
        add_point(rate, 0.5 * (t[r] + t[r - 1]), std::log(K[r] / K[r - 1]) / (t[r] - t[r - 1]));
        add_point(limit, rate.x.back(), 2.0 * sample.linear->fastest_rate());
    }
    panel.curves.push_back(std::move(rate));
    panel.curves.push_back(std::move(limit));
}

template <int Dim>
void draw(Session& session, const std::vector<Sample<Dim>>& samples,
          const std::vector<RunRecord>& runs) {
    CurvePanel kinetic{"kinetic energy (dashed: growth of the fastest wave)", "t", "K", true, {}};
    CurvePanel rate{"its growth (dashed: fastest wave)", "t", "d ln K/dt", false, {}};
    int drawn = 0;
    for (std::size_t n = 0; n < runs.size(); ++n) {
        const History& h = runs[n].history;
        add_kinetic(kinetic, samples[n], h, static_cast<int>(n) + 1);
        // A rate of something that only rings says nothing.
        if (window_of(samples[n], h).long_enough()) add_rate(rate, samples[n], h, ++drawn);
    }
    std::vector<CurvePanel> panels{kinetic};
    if (drawn > 0) panels.push_back(rate);
    draw_curves(session, "kinetic_energy",
                fmt::format("One moving particle in a lattice of {} under tension s",
                            runs.front().statistics.particles),
                panels);
}

template <int Dim>
void compute(Session& session, const Parameters& p, bool single) {
    // What is pulled as hard as it is stiff falls apart the faster, and short ranges make high frequencies.
    const double step = (Dim == 3 ? 0.05 : 0.1) * (std::abs(p.stress) > 0.5 ? 0.5 : 1.0);
    if (step < 0.1) session.prefer_step(step);
    Scheme scheme = session.scheme();
    if (Dim == 3 && !session.given("range")) {
        scheme.range = 2.0;
        session.leave_out_of_case({"range"});
    }
    std::vector<Sample<Dim>> samples;
    if (single)
        samples.push_back(make_sample<Dim>(p, p.stress, scheme));
    else
        samples = figure<Dim>(p, scheme);
    const double fastest = samples.front().linear->fastest_rate();
    const auto runs = run_all(session, samples, [&](const Sample<Dim>&) {
        Plan<Dim> plan;
        // In space rates differ by more: until the slowest of plain velocities have moved by spacings.
        const double growth = Dim == 2 ? HUGE_VAL : std::log1p(10.0 / p.speed) / fastest;
        plan.t_end = session.end(std::min(450.0, growth), 20.0);
        plan.record({largest_displacement_column<Dim>(), closest_pair_column<Dim>()});
        return plan;
    });
    for (std::size_t n = 0; n < runs.size(); ++n) report(session, p, samples[n], runs[n]);
    write_comparison(session.folder(), samples, runs);
    if (session.plots()) draw(session, samples, runs);
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("tensile_instability",
                    "one moving particle in a stretched periodic lattice, [HHM04] Fig. 1");
    problem.units(lattice_units());
    Parameters p;
    auto& options = problem.options();
    options.number("stress", p.stress, "hydrostatic stress; tension is positive",
                   between(-1.0, 1.0));
    options.integer(
        "cells", p.cells,
        "cells x cells particles (an even number); in space cells of the lattice along each axis "
        "(default 8; fcc and bcc 6)",
        between(2, 400));
    options.number(
        "speed", p.speed, "initial speed of the one moving particle",
        {[](double v) { return v >= 1e-12; }, "at least 1e-12 (round-off gives the others 1e-15)"});
    add_lattice_options(options, p.dimension, p.lattice,
                        "2: the triangular lattice; 3: a cubic one");
    problem.use_scheme();
    auto of_one = Problem::scheme_option_names();  // without any of these the figure is drawn
    of_one.emplace_back("stress");
    options.only_when(of_one, {}, [&] { return !options.first_given(of_one).empty(); }, {});

    return problem.main(argc, argv, [&](Session& session) {
        if (p.dimension == 2)
            session.smoke_default("cells", p.cells, 10);
        else if (!session.given("cells"))
            p.cells = p.lattice == CubicLattice::sc ? 8 : 6;
        if (p.dimension == 3 && p.cells > 40)
            refuse("cells: {} is above 40, too many wave vectors in space; 6 to 12 are usual",
                   p.cells);
        const bool single = !options.first_given(of_one).empty();
        p.dimension == 3 ? compute<3>(session, p, single) : compute<2>(session, p, single);
    });
}
