// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: particles fill an irregular shape evenly by viscous relaxation, [HH07] 7; 5 s
//
// A mesh for an irregular shape by viscous relaxation, [HH07] 7: "use viscous relaxation techniques
// from molecular dynamics".
//
//        . -- .            N particles of mass 1, anywhere in a shape of area N, repel each other and
//      /  o  o  \ _        lose their motion to friction. They come to rest as evenly as they can.
//     | o  o  o   o \      Outside the shape lies matter of the same density that repels them as they
//      \  o  o  o  o |     repel each other (a fixed lattice smeared out): the border is then no surface
//        ` - . _ o_ /      for them, and the density is the same up to it.
//
//     v_dot_i = -sum_j grad_i w_ij - closed integral of w(|r_i - s|) n ds - gamma v_i,  Lucy's w
//
// Lengths are in units of sqrt(area of a particle); mesh.csv, a lattice to start from, is in those of
// the outline given. Names in result.json: density_scatter is the standard deviation of densities
// (Lucy, range 3) over their mean: of all particles, the wall's part included, and of those off the
// border by more than the range.
#include "common.hpp"
#include "relaxation/quality.hpp"
#include <spam/external/friction.hpp>
#include <spam/rhs/pair_potentials.hpp>

#include <filesystem>

namespace {

using namespace relaxation;

constexpr double at_rest_below = 1e-5;  // rms speed, of that of sound: the run ends
constexpr double longest = 1000.0;      // a late defect may still move

enum class Start { random, lattice };
std::string_view to_string(Start start) { return start == Start::random ? "random" : "lattice"; }

struct Parameters {
    int particles = 400, lobes = 3, seed = 1;
    double depth = 0.2, range = 1.5, damping = 0.1;
    std::string outline;
    Start start = Start::random;
};

Region region_of(const Parameters& p) {
    const Region any =
        p.outline.empty() ? lobed_region(p.lobes, p.depth) : region_from_file(p.outline);
    return any.of_area(p.particles);
}

/// Of rk4. Frequencies go as 1 over the range squared and repulsion of short ranges is stronger besides; weak friction
/// leaves particles fast, for longer, and each closest approach adds an error of the energy (measured at ranges 1.1 to
/// 1.5, frictions .001 to 100 and six seeds: at most 5.4e-5); strong friction is stiff.
double step_of(const Parameters& p) {
    return 0.1 *
           std::min({1.0, std::pow(p.range / 1.5, 3), std::cbrt(p.damping / 0.1), 2.5 / p.damping});
}

double rms_speed(const Model<2>& model, std::span<const double> y) {
    const ConstState<2> state(model.layout(), y);
    return std::sqrt(state.velocity().squaredNorm() /
                     static_cast<double>(model.particles().size()));
}

bool is_at_rest(const History& h) {
    return h.last("t") > 10.0 && h.last("rms_speed") < at_rest_below;
}

/// Friction takes energy: the largest rise from one row to the next, of the difference of the largest
/// and the least energy. Where that is next to nothing, in a short run or of a friction next to none,
/// rises are errors of the steps, and nothing is claimed of them.
Check energy_rise(const History& h) {
    const auto energy = h.column("energy");
    const double largest = h.largest("energy"), change = largest - h.smallest("energy");
    double rise = 0.0;
    for (std::size_t k = 1; k < energy.size(); ++k)
        rise = std::max(rise, energy[k] - energy[k - 1]);
    Check check{"energy_rise", change > 0.0 ? rise / change : change, {}, 1e-6, "measured"};
    if (!(change < 1e-3 * largest)) {
        check.expected = 0.0;
        check.source = "friction takes energy";
    }
    return check;
}

/// At rest all are inside where the border is smooth on the scale of the range: the weight of what is
/// outside is then 1/2 all along it. (2 of 400 rest outside the border of --lobes 12 --depth 0.6.)
void claim_all_inside(Session& session, const OuterMatter& wall, const History& h, int outside) {
    session.claim({"particles_outside", double(outside), 0.0, 0.0, "the wall holds them"},
                  is_at_rest(h) && std::abs(wall.least_weight_on_border() - 0.5) < 0.1);
}

/// What the defaults reach; shapes and ranges of others may hold more defects.
bool is_known(const Session& session, const Parameters& p, const RunRecord& run) {
    return session.when_default({"outline", "lobes", "depth", "range", "damping"}) &&
           p.particles >= 200 && session.common().t_end.value_or(longest) >= longest &&
           run.complete;
}

void report(Session& session, const Parameters& p, const OuterMatter& wall, const RunRecord& run,
            const Quality& before, const Quality& after) {
    const auto measured = [&](const char* name, double value) {
        if (std::isfinite(value)) session.measure(name, value);
    };
    const bool known = is_known(session, p, run);
    claim_all_inside(session, wall, run.history, after.outside);
    session.check(energy_rise(run.history));
    measured("density_scatter_before", before.scatter);
    measured("density_scatter_interior_before", before.interior);
    const auto claim = [&](const char* name, double value, double limit, const char* source) {
        if (known || std::isfinite(value)) session.claim({name, value, 0.0, limit, source}, known);
    };
    claim("residual_speed", run.history.last("rms_speed"), at_rest_below,
          "of the speed of sound: at rest");
    claim("density_scatter", after.scatter, 0.02, "measured before");
    claim("density_scatter_interior", after.interior, 0.015, "measured before");
    measured("nearest_neighbour_before", before.nearest);
    measured("nearest_neighbour", after.nearest);
    measured("six_neighbours_before", before.six);
    measured("six_neighbours", after.six);
}

/// Where the particles are, in units of the outline, and how they fit.
void write_mesh(const RunFolder& folder, const Particles<2>& particles, const Region& region,
                const Ruler& ruler, const Points<2>& x) {
    CsvWriter csv(folder / "mesh.csv",
                  {"id", "x", "y", "density", "neighbours", "distance_from_border"});
    const auto rho = ruler.density(x), distance = ruler.distances_from_border(x);
    const auto neighbours = ruler.neighbours(x);
    for (std::size_t i = 0; i < rho.size(); ++i) {
        const Point<2> r = (x.col(static_cast<Eigen::Index>(i)) + region.shift()) / region.scale();
        csv.add(std::vector<double>{double(particles.id[i]), r.x(), r.y(), rho[i],
                                    double(neighbours[i]), distance[i] / region.scale()});
    }
}

void draw(Session& session, const Region& region, const Ruler& ruler, const RunRecord& run,
          const Points<2>& x_0, const Points<2>& x) {
    const auto panel = [&](const std::string& title, const Points<2>& at,
                           std::vector<double> colour) {
        return ConfigurationPanel{.title = title,
                                  .position = at,
                                  .colour = std::move(colour),
                                  .outlines = {region.polygon()}};
    };
    const auto percent = [&](const Points<2>& at) { return 100.0 * scatter(ruler.density(at)); };
    const auto before = fmt::format("t = 0: density scatter {:.3g} %", percent(x_0));
    const auto after = fmt::format("t = {:g}: {:.2g} %", run.history.last("t"), percent(x));
    draw_configurations(session, "configurations",
                        fmt::format("{} particles before and after viscous relaxation", x.cols()),
                        {panel(before, x_0, ruler.density(x_0)), panel(after, x, ruler.density(x))},
                        2, "density");
    const auto count = ruler.neighbours(x);
    draw_configurations(
        session, "neighbours", "Neighbours of particles",
        {panel("off the border six, but for defects", x, {count.begin(), count.end()})}, 1,
        "nearer than 1.47");
    const History& h = run.history;
    const CurvePanel evenness = over_time("evenness", h, "relative standard deviation",
                                          {{"density", "density_scatter"}}, true);
    const CurvePanel motion = over_time("motion", h, "rms speed", {{"speed", "rms_speed"}}, true);
    draw_curves(session, "relaxation", "Coming to rest", {evenness, motion});
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("relaxation", "a mesh for an irregular shape by viscous relaxation, [HH07] 7");
    problem.units(reduced_units(
        "the mass of a particle, its area and the energy of two by the integral of their weight"));
    Parameters p;
    auto& options = problem.options();
    options.integer("particles", p.particles, "number of particles that fill the shape",
                    between(20, 1e6));
    options.integer("lobes", p.lobes,
                    "number of lobes of the shape, r = 1 + depth (cos(lobes a) + sin(2a)/2)",
                    between(1, 12));
    options.number("depth", p.depth, "depth of the lobes; 0 gives a circle", between(0.0, 0.6));
    options.text("outline", p.outline, "file with the corners of another shape, one x,y per line")
        .excludes({"lobes", "depth"});
    options.only_when(
        {"lobes"}, {"depth"}, [&p] { return p.depth > 0.0; },
        "a circle (--depth 0) has none; leave one out");
    options.choice<Start>(
        "start", p.start, {Start::random, Start::lattice},
        "particles start at random places, or on a triangular lattice cut at the border");
    options.number("range", p.range, "range of the repulsion, in units of sqrt(area of a particle)",
                   between(1.1, 20.0));
    options.number("damping", p.damping, "gamma of the friction -gamma v", between(1e-3, 100.0));
    options.integer("seed", p.seed, "seed of the random initial places", between(0.0, 1e9));

    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("particles", p.particles, 80);
        // case.toml must find it from any other folder.
        if (!p.outline.empty()) p.outline = std::filesystem::absolute(p.outline).string();
        session.prefer_step(step_of(p));
        // shape and places
        const Region region = region_of(p);
        auto particles = make_particles<2>(p.start == Start::random
                                               ? random_places(region, p.particles, p.seed)
                                               : lattice_places(region, p.particles, p.seed),
                                           1.0);
        particles.body.assign(particles.size(), 0);  // random places make no bodies
        const Points<2> x_0 = particles.reference_position;
        const Ruler ruler(region);

        // repulsion, wall, friction
        PairPotentialModel<2> model(std::move(particles), p.range);
        model.add(std::make_unique<OuterMatter>(region, p.range));
        if (p.damping > 0.0)
            model.add(std::make_unique<Friction<2>>(p.damping, FrictionOf::all_motion));
        auto y0 = initial_state<2>(model, 1.0, 1.0, at_rest<2>());
        Plan<2> plan;
        plan.t_end = session.common().smoke ? 40.0 : longest;
        plan.output_every = 1.0;
        plan.snapshot_every = 0.05 * plan.t_end;
        plan.observe({.columns = {{"rms_speed", rms_speed},
                                  {"density_scatter",
                                   [&ruler](const Model<2>& m, std::span<const double> y) {
                                       return scatter(
                                           ruler.density(ConstState<2>(m.layout(), y).position()));
                                   }}},
                      .enough = is_at_rest});
        const RunRecord run = session.run(model, std::move(y0), std::move(plan));

        // what came out
        const Points<2> x = ConstState<2>(model.layout(), run.y).position();
        report(session, p, OuterMatter(region, p.range), run, measure(ruler, x_0),
               measure(ruler, x));
        write_mesh(session.folder(), model.particles(), region, ruler, x);
        if (session.plots()) draw(session, region, ruler, run, x_0, x);
    });
}
