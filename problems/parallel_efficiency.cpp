// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: what processes gain by sharing particles, [HH07] 10: ./spam run parallel_efficiency --ranks 2; 30 s
//
// Speed-up S = t_1/t_P = P E of P processes, [HH07] 10. "Communication time reduces parallel efficiency": a process
// computes for its n particles, and exchanges images of those near its borders,
//
//     +------+------+      t_P = n a + G c,   1/E = 1 + (c/a) G/n:      surface by volume, ~ n^(-1/2) in the plane
//     |  n   o o    |
//     |    G o o    |      a: a particle and right-hand side,   G: images,   c: one of these
//     +------+------+
//
// Two systems go by rk4, on one process and on P in turn, --turns times each:
//     solid     a rotating hexagon of elastic particles (Monaghan's velocity), of the numbers that --sizes gives
//     gas       --cells by --cells particles of the Lucy gas, P = rho^2/2, which expands freely, [HH01]
//
// strong: E = t_1(N)/(P t_P(N)). weak: t_1(N/P)/t_P(N), of hexagons with N/P and N particles.
// t_P is the processor time that the busiest process needs outside of exchanges, and what steps would spend in these
// were each the quickest: copies, messages and waiting, by the clock. Of both the least of all turns counts, which
// leaves out what other programs take of the machine. Lists that are made anew count as work, their exchanges do not.
// Beside it E by the clock, which says little where others use the machine, or there are more processes than cores.
//
// owners: the gas on P processes until it has filled its box, every particle by the process that owns it.
// Without --ranks one process is compared with itself, which shows how well times are known.
#include "common.hpp"
#include "parallel_efficiency/times.hpp"

#include <algorithm>
#include <charconv>

namespace parallel_efficiency {
namespace {

using namespace spam;

struct Parameters {
    std::string sizes = "20000,200000";
    int cells = 128;
    int turns = 8;
    int steps = 5;
};

std::vector<int> sizes_of(const Parameters& p) {
    std::vector<int> sizes;
    for (std::size_t at = 0; at <= p.sizes.size();) {
        const std::size_t end = std::min(p.sizes.find(',', at), p.sizes.size());
        const char *const first = p.sizes.data() + at, *const last = p.sizes.data() + end;
        int size = 0;
        const auto [stop, error] = std::from_chars(first, last, size);
        if (error != std::errc() || stop != last || size < 100 || size > 20000000)
            refuse(
                "sizes: '{}' is no whole number between 100 and 20000000; give numbers of particles as "
                "in --sizes 20000,200000",
                std::string(first, last));
        if (std::ranges::find(sizes, size) != sizes.end())
            refuse("sizes: {} is given twice; leave one out", size);
        sizes.push_back(size);
        at = end + 1;
    }
    return sizes;
}

/// A model at its start.
struct System {
    std::unique_ptr<ParticleModel<2>> model;
    std::vector<double> y0;
    double step;

    std::size_t particles() const { return model->particles().size(); }
};

/// The hexagon of 1 + 3 n + 3 n^2 particles that is next to `size`.
System make_solid(int size) {
    const int n =
        std::max(1, static_cast<int>(std::lround(std::sqrt(size / 3.0 - 1.0 / 12.0) - 0.5)));
    System solid{std::make_unique<SmoothParticleModel<2>>(
                     make_particles<2>(triangular_hexagon(n), 1.0),
                     ElasticSolid::triangular_lattice(), Scheme{.transport = Transport::monaghan}),
                 {},
                 0.5};
    solid.y0 = lattice_state(*solid.model, rigid_rotation(0.1 / n));
    return solid;
}

/// At rest in the middle of a periodic box of twice its side, every particle a little off its site.
System make_gas(int cells) {
    const Box<2> box({2.0 * cells, 2.0 * cells});
    Points<2> x = square_lattice<2>({cells, cells});
    x.array() += 0.5 * (cells + 1.0);
    auto particles = make_particles<2>(x, 1.0, 1.0, box);
    displace(x, 0.05, 4);
    auto model = std::make_unique<FluidModel<2>>(
        std::move(particles), Fluid{LucyGas{}},
        Scheme{.density = Density::summed, .kernel = Kernel::lucy, .range = 6.0}, box);
    auto y0 = model->state(x, Points<2>::Zero(2, x.cols()));
    return {std::move(model), std::move(y0), 0.25};
}

IntegratorOptions steps_of(const System& system) { return {.method = "rk4", .dt = system.step}; }

struct Measured {
    std::string name;
    std::size_t particles = 0;
    std::size_t different = 0;  ///< numbers of the state that are not those of one process
    double images = 0.0, bytes = 0.0,
           exchanges = 0.0;                 ///< by particle and right-hand side; by right-hand side
    Times one{}, parted{}, one_of_share{};  ///< the last of N/P particles, where measured

    double strong(std::size_t count) const {
        return one.without_others() / (static_cast<double>(count) * parted.without_others());
    }
    double by_clock(std::size_t count) const {
        return one.clock / (static_cast<double>(count) * parted.clock);
    }
    double weak() const { return one_of_share.without_others() / parted.without_others(); }
};

/// `make(share)`: the system of all particles, or of one share of them where asked; of this there may be none.
Measured measure(Timed& all, const Parameters& p, std::string name,
                 const std::function<std::optional<System>(bool share)>& make) {
    std::optional<System> whole = make(false), reference, share;
    std::optional<PartedMotion<2>> one, one_of_share;
    const auto begin_alone = [&](std::optional<System>& system,
                                 std::optional<PartedMotion<2>>& motion, bool of_share) {
        if (all.own() > 0) return;
        system = make(of_share);
        if (system)
            motion.emplace(*system->model, system->y0, steps_of(*system), Parts::alone_here());
    };
    begin_alone(reference, one, false);
    begin_alone(share, one_of_share, true);
    PartedMotion<2> parted(*whole->model, whole->y0, steps_of(*whole), all);
    Measured found{.name = std::move(name), .particles = whole->particles()};
    for (int turn = 0; turn <= p.turns; ++turn) {
        const Times now = alone(all, one, p.steps), of_share = alone(all, one_of_share, p.steps),
                    of_all = together(all, parted, p.steps);
        if (turn == 0) continue;  // which allocates
        found.one.keep_least(now);
        found.one_of_share.keep_least(of_share);
        found.parted.keep_least(of_all);
    }
    const auto y = parted.y();
    if (one)
        for (std::size_t k = 0; k < y.size(); ++k) found.different += y[k] != one->y()[k];
    found.different = all.total(found.different);
    const auto traffic = parted.exchanges();
    const auto evaluations = static_cast<double>(parted.statistics().rhs_evaluations);
    found.images = parted.sharing().images;
    found.exchanges = static_cast<double>(traffic.exchanges) / evaluations;
    found.bytes =
        static_cast<double>(traffic.bytes) / evaluations / static_cast<double>(found.particles);
    return found;
}

void report(Session& session, std::size_t count, const Measured& found) {
    const Findings findings(session, found.name + "_");
    findings.check("different_numbers", static_cast<double>(found.different), 0.0, 0.0,
                   "the state does not depend on the number of processes");
    // A short turn may take no time at all by the clock of the processor, and there may be no share.
    const auto measure = [&](const char* what, double ratio, const char* remark) {
        if (std::isfinite(ratio) && ratio > 0.0) findings.measure(what, ratio, remark);
    };
    measure("efficiency", found.strong(count), "strong: processor time and least exchanges");
    measure("efficiency_by_clock", found.by_clock(count), "of the least turns");
    measure("speed_up", static_cast<double>(count) * found.strong(count), "measured");
    measure("weak_efficiency", found.weak(), "one process with an equal share");
    findings.measure("images_per_particle", found.images);
    findings.measure("exchanges_per_rhs", found.exchanges, "of each process");
    findings.measure("bytes_per_particle_and_rhs", found.bytes);
    measure("nanoseconds_per_particle_and_rhs",
            1e9 * found.one.busy / 4.0 / static_cast<double>(found.particles), "of one process");
}

void write(const RunFolder& folder, const std::vector<Measured>& all, std::size_t count) {
    CsvWriter csv(
        folder / "efficiency.csv",
        {"ranks", "particles", "images_per_particle", "seconds_of_one", "seconds_of_share",
         "busy_seconds", "exchange_seconds", "clock_seconds_of_one", "clock_seconds"});
    for (const Measured& m : all)
        csv.add(std::vector<double>{static_cast<double>(count), static_cast<double>(m.particles),
                                    m.images, m.one.busy, m.one_of_share.busy, m.parted.busy,
                                    m.parted.exchanges, m.one.clock, m.parted.clock});
}

// ---- owners ----

struct Owned {
    double t;
    Points<2> position;
    std::vector<double> owner;
};

/// The gas at four times, among all processes; they are parted anew where it has mixed.
std::vector<Owned> owners_of(Session& session, Parts& all, int cells) {
    System gas = make_gas(cells);
    PartedMotion<2> motion(*gas.model, gas.y0, steps_of(gas), all);
    std::vector<Owned> owned;
    const double last = session.common().smoke ? 0.05 : 1.0;  // in the time of sound along the gas
    constexpr int rows = 32;                                  // between two of the times
    for (const double part : {0.0, 0.25, 0.5, 1.0}) {
        for (int row = 0; row < rows; ++row) {
            const Parts::Here here(all);
            const double from = owned.empty() ? 0.0 : owned.back().t, to = part * last * cells;
            const double t = from + (to - from) * (row + 1) / rows;
            while (motion.t() < t - 1e-9) motion.integrator().step(t);
            const Parts::Here as_a_whole(Parts::alone_here());
            motion.y();
        }
        const auto y = motion.y();
        std::vector<double> own(all.alone() ? gas.particles() : all.numbers().size(),
                                static_cast<double>(all.own()));
        owned.push_back({motion.t(),
                         gas.model->box().wrapped(ConstState<2>(gas.model->layout(), y).position()),
                         all.by_number(std::span<const double>(own))});
    }
    const auto sharing = motion.sharing();
    const Findings findings(session, "expansion_");
    findings.measure("images_per_particle", sharing.images, "the most at a row, periodic ones too");
    findings.measure("load", sharing.load, "largest by mean, pairs summed over");
    findings.measure("moved_per_partition", sharing.moved, "part of all particles");
    return owned;
}

// ---- pictures ----

/// 1/E - 1 = k G/N by least squares.
double cost_of_image(const std::vector<Measured>& all, std::size_t count) {
    double product = 0.0, square = 0.0;
    for (const Measured& m : all) {
        product += m.images * (1.0 / m.strong(count) - 1.0);
        square += m.images * m.images;
    }
    return square > 0.0 ? product / square : 0.0;
}

void draw(Session& session, const std::vector<Measured>& solids, const Measured& gas,
          const std::vector<Owned>& owned, std::size_t count) {
    CurvePanel surface = frame("surface by volume", "images by particles", "efficiency"),
               size = frame("size", "log10 of particles", "efficiency");
    double most = gas.images;
    for (const Measured& m : solids) most = std::max(most, m.images);
    const auto add = [&](const std::string& title, const std::vector<Measured>& all, int style) {
        Curve points{title, {}, {}, Mark::points, style};
        for (const Measured& m : all) add_point(points, m.images, m.strong(count));
        const double k = cost_of_image(all, count);
        surface.curves.push_back(std::move(points));
        surface.curves.push_back(graph(
            fmt::format("1/(1 + {:.2g} G/N)", k), 0.0, 1.1 * most, 60,
            [k](double x) { return 1.0 / (1.0 + k * x); }, style));
    };
    add("elastic hexagon", solids, 1);
    add("gas", {gas}, 2);
    Curve strong{"strong", {}, {}, Mark::points, 1}, weak{"weak", {}, {}, Mark::points, 3},
        clock{"strong, by the clock", {}, {}, Mark::points, 4};
    for (const Measured& m : solids) {
        const double x = std::log10(static_cast<double>(m.particles));
        add_point(strong, x, m.strong(count));
        add_point(weak, x, m.weak());
        add_point(clock, x, m.by_clock(count));
    }
    size.curves = {strong, weak, clock};
    draw_curves(session, "efficiency", fmt::format("Efficiency of {} processes", count),
                {surface, size});
    std::vector<ConfigurationPanel> panels;
    for (const Owned& one : owned)
        panels.push_back({fmt::format("t = {:.3g}", one.t), one.position, one.owner, {}});
    draw_configurations(session, "owners",
                        fmt::format("A gas that expands, among {} processes", count), panels, 4,
                        "process");
}

void compute(Session& session, const Parameters& p) {
    const auto sizes = sizes_of(p);
    Timed all(session.processes());
    const std::size_t count = all.count();
    session.prefer_one_thread();
    RunStatistics& statistics = session.begin_analysis(
        {fmt::format("systems     hexagons of some {} particles, {} of a gas", p.sizes,
                     p.cells * p.cells),
         all.alone() ? std::string("ranks       1, beside itself; give --ranks 2 for more")
                     : fmt::format("ranks       {} beside one", count)},
        "rk4, dt = 0.5 (solid) and 0.25 (gas)");
    std::vector<Measured> solids;
    for (const int size : sizes)
        solids.push_back(measure(all, p, fmt::format("solid_{}", size), [&](bool share) {
            return std::optional(make_solid(share ? size / static_cast<int>(count) : size));
        }));
    const Measured gas = measure(all, p, "gas", [&](bool share) {
        return share ? std::optional<System>() : std::optional(make_gas(p.cells));
    });
    for (const Measured& solid : solids) report(session, count, solid);
    report(session, count, gas);
    const auto owned = owners_of(session, all, p.cells);
    statistics.particles = solids.front().particles;
    auto every = solids;
    every.push_back(gas);
    write(session.folder(), every, count);
    if (session.plots()) draw(session, solids, gas, owned, count);
}

}  // namespace
}  // namespace parallel_efficiency

int main(int argc, char** argv) {
    using namespace parallel_efficiency;
    Problem problem("parallel_efficiency", "what processes gain by sharing particles, [HH07]");
    problem.units(lattice_units());
    Parameters p;
    auto& options = problem.options();
    options.text("sizes", p.sizes, "numbers of particles of the elastic hexagons, about");
    options.integer("cells", p.cells, "particles along an edge of the gas", between(7, 4000));
    options.integer("turns", p.turns, "how often times are taken, the least of which counts",
                    between(1, 1000));
    options.integer("steps", p.steps, "steps of rk4 a turn", between(1, 1000));
    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("sizes", p.sizes, "400,1200");
        session.smoke_default("cells", p.cells, 16);
        session.smoke_default("turns", p.turns, 2);
        compute(session, p);
    });
}
