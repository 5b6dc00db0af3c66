// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: weight functions beside a Gaussian, and how even the density of lattices is, [HH01]; 2 s
//
// What the weight functions look like and how well they interpolate: exercises 2 and 3 of [HH01].
//
//     Lucy (w_3)   C (1 + 3u)(1 - u)^3            u = r/h
//     Monaghan     A (1 - 6u^2 + 6u^3), u < 1/2;  2A (1 - u)^3
//     w_n          C (1 + n u)(1 - u)^n           n is an option
//
// 1. w, its gradient w'(r) and its Laplacian w'' + (D-1) w'/r in D = 1, 2, 3 dimensions beside the
//    Gaussian of the same width. Lengths are measured in s, s^2 = <r^2>/D, so that one Gaussian,
//    exp(-r^2/2)/(2 pi)^(D/2), serves all.
// 2. The largest and smallest density sum_j w(|r - r_j|) anywhere between the particles of a line, a
//    square and a triangular lattice of spacing 1, relative to particles per volume, for ten ranges h.
//    Both would be 1 for infinitely many neighbours. Nothing moves here.
#include "common.hpp"
#include "kernels/lattices.hpp"
#include <spam/kernel/weight_integrals.hpp>

namespace {

using namespace spam;
using namespace kernels;
using std::numbers::pi;

struct Parameters {
    double smallest = 1.5, largest = 6.0;
    int ranges = 10, family = 5;

    std::vector<double> all_ranges() const {
        std::vector<double> h;
        for (int k = 0; k < ranges; ++k)
            h.push_back(smallest + (largest - smallest) * k / std::max(1, ranges - 1));
        return h;
    }
    /// As weight_function() knows them.
    std::vector<std::string> laws() const {
        return {"lucy", "monaghan", fmt::format("w{}", family)};
    }
};

std::string title_of(const std::string& law) {
    if (law == "lucy") return "Lucy";
    if (law == "monaghan") return "Monaghan";
    const std::vector<std::string> subscripts{"₂", "₃", "₄", "₅", "₆", "₇", "₈"};
    return "w" + subscripts[static_cast<std::size_t>(law[1] - '2')];
}
/// Colour of a law in every picture.
int style_of(const std::string& law) { return law == "lucy" ? 2 : law == "monaghan" ? 3 : 5; }

// ---- 1: beside a Gaussian ----

template <int Dim>
struct Gaussian {
    static double value(double r) { return std::exp(-0.5 * r * r) / std::pow(2.0 * pi, 0.5 * Dim); }
    static double slope(double r) { return -r * value(r); }
    static double laplacian(double r) { return (r * r - Dim) * value(r); }
};

/// w, w' and Laplacian of one law at range 1 against r, all in units of its width s.
template <int Dim>
struct Profile {
    double width;
    std::vector<double> r, value, slope, laplacian;

    explicit Profile(const AnyWeight<Dim>& w) : width(std::sqrt(moment(w, 2) / Dim)) {
        const double end = 1.1 * w.range();
        for (int k = 0; k <= 440; ++k) {
            const double x = end * k / 440, s = width;
            r.push_back(x / s);
            value.push_back(w.value(x) * std::pow(s, Dim));
            slope.push_back(-x * w.minus_slope_over_r(x) * std::pow(s, Dim + 1));
            laplacian.push_back(spam::laplacian<Dim>(w, x) * std::pow(s, Dim + 2));
        }
    }
    /// Largest distance from the Gaussian, in units of its value at the middle.
    double from_gaussian() const {
        double worst = 0.0;
        for (std::size_t k = 0; k < r.size(); ++k)
            worst = std::max(worst, std::abs(value[k] - Gaussian<Dim>::value(r[k])));
        return worst / Gaussian<Dim>::value(0.0);
    }
};

template <int Dim>
void compare_with_gaussian(Session& session, const Parameters& p) {
    const char* const powers[] = {"", "²", "³", "⁴", "⁵"};
    std::vector<CurvePanel> panels{
        frame("weight function", "r/s", fmt::format("w s{}", powers[Dim - 1])),
        frame("gradient", "r/s", fmt::format("w' s{}", powers[Dim])),
        frame("Laplacian", "r/s", fmt::format("∇²w s{}", powers[Dim + 1]))};
    panels[0].curves.push_back(graph("Gaussian", 0.0, 4.0, 400, Gaussian<Dim>::value));
    panels[1].curves.push_back(graph("Gaussian", 0.0, 4.0, 400, Gaussian<Dim>::slope));
    panels[2].curves.push_back(graph("Gaussian", 0.0, 4.0, 400, Gaussian<Dim>::laplacian));
    for (const auto& law : p.laws()) {
        const AnyWeight<Dim> w = weight_function<Dim>(law, 1.0);
        const Profile<Dim> profile(w);
        const Findings findings(session, fmt::format("{}_{}d_", law, Dim));
        findings.check("integral", moment(w, 0), 1.0, 1e-13, "[HH01] eq 7");
        findings.measure("width", profile.width, "s/h, measured");
        findings.measure("from_gaussian", profile.from_gaussian(), "of w(0), measured");
        const auto add = [&](CurvePanel& panel, const std::vector<double>& y) {
            panel.curves.push_back({title_of(law), profile.r, y, Mark::line, style_of(law)});
        };
        add(panels[0], profile.value);
        add(panels[1], profile.slope);
        add(panels[2], profile.laplacian);
    }
    if (session.plots())
        draw_curves(session, fmt::format("weight_functions_{}d", Dim),
                    fmt::format("Weight functions in {0} dimension{1} beside a "
                                "Gaussian of the same width, s² = ⟨r²⟩{2}",
                                Dim, Dim == 1 ? "" : "s", Dim == 1 ? "" : fmt::format("/{}", Dim)),
                    panels);
}

// ---- 2: lattices ----

/// The extremes of one lattice at some ranges, law by law.
struct Table {
    std::string lattice;
    std::vector<double> h;
    std::vector<std::vector<Extremes>> of_law;
};

template <int Dim>
Table tabulate(const Lattice<Dim>& lattice, const Parameters& p, const std::vector<double>& h) {
    Table table{lattice.name, h, {}};
    for (const auto& law : p.laws()) {
        table.of_law.emplace_back();
        for (const double range : h)
            table.of_law.back().push_back(
                density_extremes(lattice, weight_function<Dim>(law, range)));
    }
    return table;
}

std::vector<Table> tabulate_all(const Parameters& p, const std::vector<double>& h) {
    return {tabulate(line(), p, h), tabulate(square(), p, h), tabulate(triangular(), p, h)};
}

/// Six digits; tests/problem/lattice_sums.cpp finds them on a grid of points.
struct Known {
    std::string lattice, law;
    double h, least, largest;
};
const std::vector<Known> known{{"line", "lucy", 3.0, 0.997299, 1.003086},
                               {"square", "lucy", 1.5, 0.989534, 1.023762},
                               {"square", "lucy", 3.0, 0.998033, 1.002930},
                               {"square", "lucy", 6.0, 0.999914, 1.000090},
                               {"triangular", "lucy", 3.0, 0.999933, 1.000334},
                               {"square", "monaghan", 3.0, 0.996192, 1.003440}};

/// What is claimed of one entry, if anything.
Check claim(const Table& table, const std::string& law, double h, bool least, double value) {
    Check item{fmt::format("{}_{}_h{:g}_{}", table.lattice, law, h, least ? "least" : "largest"),
               value,
               {},
               0.0,
               "measured"};
    for (const Known& one : known)
        if (one.lattice == table.lattice && one.law == law && std::abs(one.h - h) < 1e-12) {
            item.expected = least ? one.least : one.largest;
            item.tolerance = 1e-6;
            item.source = "[HH01] exercise 3, sums on a grid of points";
        }
    if (table.lattice == "line" && law == "monaghan" && std::fmod(h, 2.0) == 0.0) {
        item.expected = 1.0;
        item.tolerance = 1e-12;
        item.source = "cubic B-splines at their knots' distance add up to one";
    }
    return item;
}

void report(Session& session, const Parameters& p, const Table& table) {
    const auto laws = p.laws();
    for (std::size_t l = 0; l < laws.size(); ++l)
        for (std::size_t k = 0; k < table.h.size(); ++k)
            for (const bool least : {true, false}) {
                const Extremes& found = table.of_law[l][k];
                session.check(
                    claim(table, laws[l], table.h[k], least, least ? found.least : found.largest));
            }
}

void write_table(const RunFolder& folder, const Parameters& p, const std::vector<Table>& tables) {
    std::vector<std::string> names{"range"};
    for (const auto& table : tables)
        for (const auto& law : p.laws())
            for (const char* what : {"least", "largest"})
                names.push_back(fmt::format("{}_{}_{}", table.lattice, law, what));
    CsvWriter csv(folder / "density_extremes.csv", names);
    for (std::size_t k = 0; k < tables.front().h.size(); ++k) {
        std::vector<double> row{tables.front().h[k]};
        for (const auto& table : tables)
            for (const auto& law : table.of_law)
                row.insert(row.end(), {law[k].least, law[k].largest});
        csv.add(row);
    }
}

/// Largest minus smallest, NaN where nothing but rounding is left of it.
double visible_ripple(const Extremes& e) { return e.ripple() > 1e-12 ? e.ripple() : std::nan(""); }

void draw_table(Session& session, const Parameters& p, const std::vector<Table>& tables) {
    HeatMap map{{{"lattice", {}}, {"weight", {}}}, {{"range h", {}}}, {}, {}, "", true};
    map.value_label = "largest − smallest";
    for (const auto& law : p.laws()) map.rows[1].values.push_back(title_of(law));
    for (const double h : tables.front().h)
        map.columns[0].values.push_back(fmt::format("{:.4g}", h));
    for (const auto& table : tables) {
        map.rows[0].values.push_back(table.lattice);
        for (const auto& law : table.of_law)
            for (const Extremes& e : law) {
                map.value.push_back(visible_ripple(e));
                map.text.push_back(std::isnan(map.value.back())
                                       ? "1"
                                       : fmt::format("{:.6f}\n{:.6f}", e.least, e.largest));
            }
    }
    draw_heat_map(
        session, "density_extremes",
        "Smallest and largest density between particles at spacing 1, relative to the mean", map);
}

void draw_ripple(Session& session, const Parameters& p) {
    std::vector<double> h;
    const int steps = session.common().smoke ? 30 : 90;
    for (int k = 0; k <= steps; ++k) h.push_back(p.smallest + (p.largest - p.smallest) * k / steps);
    std::vector<CurvePanel> panels;
    for (const auto& table : tabulate_all(p, h)) {
        panels.push_back({table.lattice, "range h", "largest − smallest density", true, {}});
        for (std::size_t l = 0; l < table.of_law.size(); ++l) {
            const std::string law = p.laws()[l];
            Curve curve{.title = title_of(law), .x = h, .y = {}, .style = style_of(law)};
            for (const Extremes& e : table.of_law[l]) curve.y.push_back(visible_ripple(e));
            panels.back().curves.push_back(curve);
        }
    }
    draw_curves(session, "density_ripple", "How unevenly lattices of spacing 1 fill space", panels);
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("kernels",
                    "weight functions and the evenness of lattices, [HH01] exercises 2, 3");
    problem.units(
        reduced_units("the mass of a particle and the spacing of its lattice; nothing moves"));
    Parameters p;
    auto& options = problem.options();
    options.number("smallest-range", p.smallest, "smallest range h", between(1.1, 20.0));
    options.number("largest-range", p.largest, "largest range h", between(1.1, 20.0));
    options.integer("ranges", p.ranges, "number of ranges, equally spaced", between(1, 40));
    options.only_when(
        {"largest-range"}, {"ranges"}, [&p] { return p.ranges > 1; },
        "one range is the smallest; leave it out, or give more --ranges");
    options.integer("family", p.family, "n of the third weight function, w_n", between(2, 8));

    options.only_when(
        {"threads"}, {}, [] { return false; },
        "has no meaning: sums over one site are too short for threads; leave it out");

    return problem.main(argc, argv, [&](Session& session) {
        if (p.ranges > 1 && p.largest <= p.smallest)
            refuse("largest-range: {:g} is not above smallest-range, {:g}; give a larger one",
                   p.largest, p.smallest);
        session.begin_analysis(
            {fmt::format("weights     Lucy, Monaghan, w_{}", p.family),
             fmt::format("lattices    line, square, triangular, particles at spacing 1, {} ranges "
                         "from {:g} to {:g}",
                         p.ranges, p.smallest, p.largest)});
        compare_with_gaussian<1>(session, p);
        compare_with_gaussian<2>(session, p);
        compare_with_gaussian<3>(session, p);
        const std::vector<Table> tables = tabulate_all(p, p.all_ranges());
        for (const auto& table : tables) report(session, p, table);
        write_table(session.folder(), p, tables);
        if (!session.plots()) return;
        draw_table(session, p, tables);
        if (p.ranges > 1) draw_ripple(session, p);
    });
}
