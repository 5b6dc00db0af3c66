// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: Lyapunov exponents: how fast motions that begin alike part from each other; 2 min
//
// Tangents v to a motion y, dv/dt = J(y) v, grow or shrink at the rates of the Lyapunov exponents. M of them take
// the same steps as y and are made orthogonal again and again (study/lyapunov.hpp; Benettin and others, Meccanica
// 15, 9, 1980).
//
//     --case soft_disks   n x n disks in a periodic box of density 1 with energy 1 each, phi = 100 (1 - r^2)^4: the
//                         potential of Posch and Hoover. 36 disks have 144 exponents: they come in pairs whose sums
//                         are 0, and six vanish, for the centre of mass, its velocity, the energy and the time
//     --case lucy_gas     the same of particles whose weight function is their potential, [HH01]
//     --case hexagon      the rotating hexagon of [HHM04] with its schemes: are late states functions of the input, or
//                         samples of an ensemble? Averaged velocities keep neighbours apart that plain ones let part
//
// The first window of the hexagon has in it what the tangent at the start makes: 0.014 to 0.022 with averaged
// velocities for eight seeds. Twins are two runs whose starts differ by 1e-12.
//
// exponents.csv has the exponents of each window of time; at its end a snapshot is written whose field leading_share is
// the part of each particle in the leading tangent, |dx|^2 + |dv|^2 by the scales of y: it shows which particles carry
// the instability (Hoover, Hoover, arXiv:1302.2533). The hexagon has a folder for each of its schemes.
#include "common.hpp"
#include <spam/io/snapshot.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/study/lyapunov.hpp>

namespace lyapunov {
namespace {

using namespace spam;
using std::numbers::pi;

enum class System { soft_disks, lucy_gas, hexagon };
std::string_view to_string(System s) {
    return s == System::soft_disks ? "soft_disks" : s == System::lucy_gas ? "lucy_gas" : "hexagon";
}

struct Parameters {
    System system = System::soft_disks;
    std::optional<int> size, exponents;
    std::optional<double> time, interval;
    double speed = 0.1;
    int seed = 5;
};

struct Measured {
    std::string name, title;
    std::shared_ptr<Model<2>> model;
    std::vector<double> y0;
    double unit;  ///< of times in pictures
    LyapunovOptions options;
    LyapunovSpectrum spectrum{};
    std::vector<double> share{};  ///< of particles in the leading tangent at the end
};

/// A periodic square of n x n particles with random velocities, whose kinetic energy is `energy` by particle.
Measured make_gas(const Parameters& p, int n) {
    const bool disks = p.system == System::soft_disks;
    const Box<2> box({static_cast<double>(n), static_cast<double>(n)});
    auto model = std::make_shared<ParticleModel<2>>(
        one_body(make_particles<2>(cell_centres<2>({n, n}), 1.0, 1.0, box)), box);
    if (disks)
        model->add_term<Core<2>>(CorePotential{100.0, 1.0});
    else
        model->add_term<WeightPotential<2>>(3.0);
    Measured gas{
        std::string(to_string(p.system)), disks ? "soft disks" : "Lucy gas", {}, {}, 1.0, {}};
    gas.y0 = initial_state<2>(*model, 1.0, 1.0, at_rest<2>());
    auto v = State<2>(model->layout(), gas.y0).velocity();
    std::mt19937 random(static_cast<std::uint32_t>(p.seed));
    std::normal_distribution<double> normal;
    for (double& number : v.reshaped()) number = normal(random);
    v.colwise() -= Point<2>(v.rowwise().mean());
    v *= std::sqrt((disks ? 1.0 : 0.1) * 2.0 * n * n / v.squaredNorm());
    model->layout().set_scale(Field::velocity, 1.0);
    gas.model = std::move(model);
    gas.options.exponents = static_cast<std::size_t>(4 * n * n);
    gas.options.duration = disks ? 300.0 : 1500.0;
    gas.options.interval = disks ? 0.1 : 1.0;
    return gas;
}

std::vector<Measured> make_hexagons(const Parameters& p, int n) {
    const auto solid = ElasticSolid::triangular_lattice();
    const auto particles = make_particles<2>(triangular_hexagon(n), 1.0);
    std::vector<Measured> all;
    const auto add = [&](const char* name, const char* title, std::shared_ptr<Model<2>> model) {
        Measured one{name, title, std::move(model), {}, 2.0 * pi * n / p.speed, {}};
        one.y0 = lattice_state(*one.model, rigid_rotation(p.speed / n));
        // Tangents are measured in reduced units, whatever the speed.
        for (const auto& block : one.model->layout().blocks())
            one.model->layout().set_scale(block.field, 1.0);
        one.options.duration = 5.5 * one.unit;
        one.options.window = 0.5 * one.unit;
        one.options.interval = one.unit / 250.0;
        all.push_back(std::move(one));
    };
    add("plain", "plain velocity",
        std::make_shared<SmoothParticleModel<2>>(particles, solid, Scheme{}));
    add("average", "averaged velocity",
        std::make_shared<SmoothParticleModel<2>>(particles, solid,
                                                 Scheme{.transport = Transport::average}));
    add("total_lagrangian", "total Lagrangian",
        std::make_shared<TotalLagrangianModel<2>>(
            particles, StVenantKirchhoff::like(solid),
            TotalLagrangianScheme{triangular_density, 3.0, 0.1}));
    return all;
}

void write_windows(const RunFolder& folder, const LyapunovSpectrum& spectrum) {
    std::vector<std::string> names{"t"};
    for (std::size_t m = 0; m < spectrum.exponents.size(); ++m)
        names.push_back(fmt::format("exponent_{}", m + 1));
    CsvWriter csv(folder / "exponents.csv", names);
    for (const auto& window : spectrum.windows) {
        std::vector<double> row{window.t};
        row.insert(row.end(), window.exponents.begin(), window.exponents.end());
        csv.add(row);
    }
}

/// Exponents, with a snapshot at the end of each window that has the share of each particle in the leading tangent.
void measure(const RunFolder& folder, const UnitNames& units, Measured& one,
             const IntegratorOptions& integrator) {
    SnapshotSeries<2> snapshots(folder, *one.model, units);
    one.options.at_window = [&](double t, std::span<const double> y,
                                std::span<const double> leading) {
        one.share = shares(*one.model, leading);
        const ParticleNumbers share{"leading_share", one.share};
        snapshots.add(t, y, {&share, 1});
    };
    one.spectrum = lyapunov_spectrum<2>(*one.model, one.y0, integrator, one.options);
    write_windows(folder, one.spectrum);
}

/// What must hold of a whole spectrum of a gas, and what others found.
void report_gas(const Findings& findings, const Parameters& p, const Measured& gas, bool standard,
                bool full_length) {
    const auto& e = gas.spectrum.exponents;
    const bool disks = p.system == System::soft_disks;
    const bool hundred = disks && gas.model->particles().size() == 100;
    findings.claim("largest_exponent", e.front(),
                   !disks    ? 0.283
                   : hundred ? 3.09
                             : 3.07,
                   disks ? 0.05 : 0.01, "another program", standard || (hundred && full_length));
    findings.measure("largest_exponent_error", gas.spectrum.errors.front(), "from ten blocks");
    if (e.size() < gas.y0.size()) return;
    double positive = 0.0, all = 0.0, pairs = 0.0;
    std::vector<double> size;
    for (std::size_t m = 0; m < e.size(); ++m) {
        positive += std::max(e[m], 0.0);
        all += e[m];
        pairs = std::max(pairs, std::abs(e[m] + e[e.size() - 1 - m]));
        size.push_back(std::abs(e[m]));
    }
    std::sort(size.begin(), size.end());
    findings.claim("sum_of_positive", positive, disks ? 127.5 : 10.2, disks ? 1.0 : 0.3,
                   "another program", standard);
    findings.check("sum_of_all", all, 0.0, 1e-6, "volumes of phase space stay");
    findings.claim("trace", gas.spectrum.trace, 0.0, 1e-6, "the sum of all exponents", true);
    findings.claim("largest_pair_sum", pairs, 0.0, disks ? 0.04 : 0.01, "exponents come in pairs",
                   standard);
    if (!disks) return;
    findings.claim("sixth_smallest", size[5], 0.0, 0.03, "six vanish", standard);
    findings.claim("seventh_smallest", size[6], 0.11, 0.02, "another program", standard);
}

void report_hexagon(const Findings& findings, const Measured& one, bool standard) {
    const auto& windows = one.spectrum.windows;
    double largest = -1.0, mean = 0.0;
    for (const auto& window : windows) {
        largest = std::max(largest, window.exponents.front());
        mean += window.exponents.front() / static_cast<double>(windows.size());
    }
    const auto claim = [&](const char* name, double value, double expected, double tolerance) {
        findings.claim(one.name + "_" + name, value, expected, tolerance, "another program",
                       standard);
    };
    if (one.name == "plain")
        claim("mean", mean, 0.056, 0.02);
    else if (one.name == "average")
        claim("largest_window", largest, 0.0, 0.016);
    else {
        claim("first_window", windows.front().exponents.front(), 0.018, 0.005);
        claim("last_window", windows.back().exponents.front(), 0.0, 0.001);
    }
    findings.measure(one.name + "_exponent", one.spectrum.exponents.front(),
                     "of the whole run but a tenth");
}

/// Two runs whose starts differ by 1e-12, and the tangent along that difference: how far they are apart, and were if
/// tangents went on for ever.
struct Twins {
    double apart, foretold;
};
Twins twins_after(const Measured& one, double t, const IntegratorOptions& integrator) {
    const auto n = static_cast<Eigen::Index>(one.y0.size());
    std::mt19937 random(one.options.seed);
    std::normal_distribution<double> normal;
    Eigen::MatrixXd v(n, 1);
    for (double& number : v.reshaped()) number = normal(random);
    v /= v.norm();
    TangentMotion<2> motion(*one.model, one.y0, v, integrator);
    motion.advance_to(t);
    auto beside = one.y0;
    for (Eigen::Index k = 0; k < n; ++k) beside[static_cast<std::size_t>(k)] += 1e-12 * v(k, 0);
    Motion<2> twin(*one.model, beside, integrator);
    twin.advance_to(t);
    const auto y = motion.y();
    const Eigen::Map<const Eigen::VectorXd> first(y.data(), n), second(twin.y().data(), n);
    return {(first - second).norm(), 1e-12 * motion.tangents().norm()};
}

/// Late states of averaged velocities are functions of the input, those of plain ones are not.
void report_twins(const Findings& findings, const Measured& one,
                  const IntegratorOptions& integrator, bool standard) {
    const bool plain = one.name == "plain";
    if (!plain && one.name != "average") return;
    const Twins early = twins_after(one, (plain ? 1.0 : 4.0) * one.unit, integrator);
    findings.claim(one.name + "_twins_by_tangent", std::log10(early.apart / early.foretold), 0.0,
                   1.0, "decimal logarithm, as tangents foretell", standard);
    const double apart = plain ? twins_after(one, 2.0 * one.unit, integrator).apart : early.apart;
    findings.claim(one.name + "_twins_apart", plain ? 0.1 / apart : apart / 1e-8, 0.0, 1.0,
                   plain ? "0.1 by the distance of twins after two turns"
                         : "distance of twins after four turns by 1e-8",
                   standard);
}

void draw(Session& session, const std::vector<Measured>& all) {
    CurvePanel windows =
                   frame("by window", all.front().unit == 1.0 ? "t" : "turns", "largest exponent"),
               spectrum = frame("spectrum", "number", "exponent");
    std::vector<ConfigurationPanel> ends;
    for (const Measured& one : all) {
        Curve curve{.title = one.title, .x = {}, .y = {}}, points{one.title, {}, {}, Mark::points};
        for (const auto& window : one.spectrum.windows)
            add_point(curve, window.t / one.unit, window.exponents.front());
        for (std::size_t m = 0; m < one.spectrum.exponents.size(); ++m)
            add_point(points, static_cast<double>(m + 1), one.spectrum.exponents[m]);
        windows.curves.push_back(std::move(curve));
        spectrum.curves.push_back(std::move(points));
        ends.push_back({one.title,
                        ConstState<2>(one.model->layout(), one.spectrum.y).position(),
                        one.share,
                        {}});
    }
    std::vector<CurvePanel> panels{windows};
    if (all.front().spectrum.exponents.size() > 1) panels.push_back(spectrum);
    draw_curves(session, "exponents", "Lyapunov exponents", panels);
    draw_configurations(session, "leading", "The end, by the share in the leading tangent", ends,
                        ends.size(), "share");
}

void compute(Session& session, const Parameters& p) {
    const bool smoke = session.common().smoke, hexagon = p.system == System::hexagon;
    const int size = p.size.value_or(hexagon ? (smoke ? 2 : 4) : smoke ? 3 : 6);
    std::vector<Measured> all;
    if (hexagon)
        all = make_hexagons(p, size);
    else
        all.push_back(make_gas(p, size));
    std::vector<StudyTask> tasks;
    for (Measured& one : all) {
        if (p.exponents) one.options.exponents = static_cast<std::size_t>(*p.exponents);
        if (p.interval) one.options.interval = *p.interval;
        one.options.seed = static_cast<std::uint32_t>(p.seed);
        if (smoke) one.options.duration *= 0.01;
        if (p.time) one.options.duration = *p.time;
    }
    const double step = hexagon ? 0.5 : p.system == System::soft_disks ? 0.005 : 0.05;
    const IntegratorOptions integrator{.method = hexagon ? "rk4" : "leapfrog", .dt = step};
    for (const Measured& one : all)
        require_spectrum<2>(*one.model, integrator, one.options.exponents);
    RunStatistics& statistics = session.begin_analysis(
        {fmt::format("system      {}, {} particles", to_string(p.system),
                     all.front().model->particles().size()),
         fmt::format("model       {}", all.front().model->describe()),
         fmt::format("exponents   {}, to t = {:g}", all.front().options.exponents,
                     all.front().options.duration)},
        integrator.describe());
    const bool standard = !smoke && !p.time && size == (hexagon ? 4 : 6) &&
                          session.at_default({"speed", "exponents", "interval"});
    for (Measured& one : all) {
        measure(hexagon ? session.folder().inside(one.name) : session.folder(), session.units(),
                one, integrator);
        statistics.rhs_evaluations += one.spectrum.rhs_evaluations;
        statistics.particles = one.model->particles().size();
        const Findings findings(session);
        if (hexagon) {
            report_hexagon(findings, one, standard);
            report_twins(findings, one, integrator, standard);
        } else {
            report_gas(findings, p, one, standard, !smoke && !p.time);
        }
    }
    if (session.plots()) draw(session, all);
}

}  // namespace
}  // namespace lyapunov

int main(int argc, char** argv) {
    using namespace lyapunov;
    Problem problem("lyapunov", "Lyapunov exponents of gases and of the rotating hexagon");
    problem.units(lattice_units());
    Parameters p;
    auto& options = problem.options();
    options.choice<System>("case", p.system,
                           {System::soft_disks, System::lucy_gas, System::hexagon}, "what moves");
    options.integer(
        "size", p.size,
        "particles along an edge of the box (default 6), or n of the hexagon (default 4)",
        between(2, 40));
    options.integer("exponents", p.exponents,
                    "how many (default: all of a gas, one of the hexagon)", between(1, 2000));
    options.number("time", p.time, "how long tangents grow (default: 300, 1500, or 5.5 turns)",
                   between(1.0, 1e6));
    options.number("interval", p.interval, "time between orthogonalisations", between(1e-3, 1e3));
    options.number("speed", p.speed, "of the corners of the hexagon", between(1e-3, 1.0));
    options.integer("seed", p.seed, "of the tangents at the start, and of the velocities of a gas",
                    between(0, 1000000000));
    options.only_when(
        {"speed"}, {"case"}, [&p] { return p.system == System::hexagon; },
        "has a meaning with --case hexagon alone; leave it out");
    return problem.main(argc, argv, [&](Session& session) { compute(session, p); });
}
