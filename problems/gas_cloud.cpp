// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: an ellipsoid of gas flies apart in the void, beside Dyson's exact solution; 2 s
//
// An ellipse or an ellipsoid of gas with semi-axes a, b, c is let go in the void.
//
//        . o o o .          rho = rho_c (1 - x^2/a^2 - y^2/b^2 - z^2/c^2), e = rho/2, gamma = 2: P = rho^2/2
//      . o o o o o .        on the isentrope, and the speed of sound is 1 in the middle
//        . o o o .
//
// It stays an ellipsoid with a profile of that form. Every particle of the gas moves in proportion to the semi-axes,
//     x_i(t) = a_i(t)/a_i(0) x_i(0),    d2 a_i/dt2 = 2 rho_c (product of all a(0))/(product of all a)/a_i,
// which is exact, nonlinear, has a free surface, and knows no scale (Dyson, J. Math. Mech. 18, 91, 1968; Ovsiannikov
// 1956). Pressure is steepest along the shortest axis, which becomes the longest one.
//
// Particles begin on a square or cubic lattice of spacing 1, with masses in proportion to the density. Of the gas that
// moves semi-axes are measured by second moments, a_i^2 = (D + 4) sum m x_i^2/sum m, in units of the shortest at the
// start; times are in that by the speed of sound.
//
//     --dimension 2 --axes 2,1     an ellipse in the plane
//     --ranges ellipses            particles are ellipses that are drawn out with the gas (physics/ellipse.hpp)
//     --ranges density             h = range/rho^(1/D): as many neighbours in the thin gas as in the dense
//     --return                     velocities are reversed halfway: the gas comes back to where it began
#include "common.hpp"
#include "ranges.hpp"
#include <spam/core/rigid_motion.hpp>
#include <spam/material/gamma_gas.hpp>
#include <spam/rhs/ellipses.hpp>
#include <spam/rhs/own_ranges.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <charconv>
#include <limits>

namespace gas_cloud {
namespace {

using namespace spam;

struct Parameters {
    int dimension = 3;
    std::string axes;
    std::optional<double> size{}, time{};
    Kernel kernel = Kernel::w4;
    double range = 3.0;
    Ranges ranges = Ranges::fixed;
    bool returns = false;
    bool rezone = false;
    std::optional<double> largest_volume{};
    double gradient_axes = 0.0;
    std::optional<double> aspect{};  ///< none
};

/// The numbers of --axes.
std::vector<double> numbers_of(const Parameters& p) {
    std::vector<double> axes;
    std::string words = p.axes.empty() ? (p.dimension == 3 ? "4,2,1" : "2,1") : p.axes;
    while (!words.empty()) {
        const auto comma = words.find(',');
        const std::string word = words.substr(0, comma);
        double value = 0.0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc{} || end != word.data() + word.size() ||
            !(value >= 0.1 && value <= 10.0))
            refuse("axes: '{}' is no number between 0.1 and 10; give the semi-axes as in --axes {}",
                   word, p.dimension == 3 ? "4,2,1" : "2,1");
        axes.push_back(value);
        words = comma == std::string::npos ? "" : words.substr(comma + 1);
    }
    if (static_cast<int>(axes.size()) != p.dimension)
        refuse("axes: {} numbers for {} dimensions; give one for each", axes.size(), p.dimension);
    return axes;
}

/// Dyson's semi-axes, and how fast they grow, in units of the shortest one and the speed of sound.
template <int Dim>
class Dyson {
  public:
    explicit Dyson(const Point<Dim>& axes) : start_(axes) {}

    /// By RK4, with an error below 1e-9.
    Point<Dim> axes(double t) const {
        const int steps = 1 + static_cast<int>(std::ceil(200.0 * t));
        const double h = t / steps;
        Point<Dim> a = start_, v = Point<Dim>::Zero();
        for (int k = 0; k < steps; ++k) {
            const Point<Dim> k1 = pull(a), k2 = pull(a + 0.5 * h * v),
                             k3 = pull(a + 0.5 * h * v + 0.25 * h * h * k1),
                             k4 = pull(a + h * v + 0.5 * h * h * k2);
            a += h * v + h * h / 6.0 * (k1 + k2 + k3);
            v += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        }
        return a;
    }

  private:
    Point<Dim> pull(const Point<Dim>& a) const {
        return (2.0 * start_.prod() / a.prod()) * a.cwiseInverse();
    }
    Point<Dim> start_;
};

template <int Dim>
struct Cloud : Variant<Dim> {
    Point<Dim> axes;   ///< by the shortest
    double size;       ///< of the shortest
    double half_time;  ///< where velocities are reversed; infinite where they are not

    /// a_i by the shortest, where they should be.
    Point<Dim> exact(double t) const {
        return Dyson<Dim>(axes).axes(std::min(t, 2.0 * half_time - t) / size);
    }
};

/// The gas of these particles; at rest on its isentrope in `y0`, where that is wanted.
template <int Dim>
std::shared_ptr<ParticleModel<Dim>> gas_of(const Parameters& p, Particles<Dim> particles,
                                           std::vector<double>* y0 = nullptr) {
    auto model = std::make_shared<ParticleModel<Dim>>(std::move(particles));
    const Fluid gas{GammaGas{2.0}};
    const auto begin = [&](auto& law) {
        if (y0 == nullptr) return;
        const Points<Dim> x = model->particles().reference_position;
        *y0 = law.start(x, Points<Dim>::Zero(Dim, x.cols()), 1.0);
        const State<Dim> state(model->layout(), *y0);
        const auto rho = model->density(*y0);
        for (Eigen::Index i = 0; i < x.cols(); ++i)
            state.energy()(0, i) = 0.5 * rho[static_cast<std::size_t>(i)];
    };
    if (p.ranges == Ranges::density)
        begin(
            model->template add_term<OwnRanges<Dim>>(gas, VariableRangeScheme{p.range, p.kernel}));
    else if (p.ranges == Ranges::ellipses)
        begin(model->template add_term<Ellipses<Dim>>(
            gas, EllipseScheme{.range = p.range,
                               .kernel = p.kernel,
                               .gradient_share = p.gradient_axes,
                               .largest_aspect =
                                   p.aspect.value_or(std::numeric_limits<double>::infinity())}));
    else
        begin(model->template add_term<SmoothParticles<Dim>>(
            gas, Scheme{.density = Density::summed, .kernel = p.kernel, .range = p.range}));
    return model;
}

/// Sites inside of the ellipsoid, the middle of the lattice's cell at its centre or a site.
template <int Dim>
Cloud<Dim> make_cloud(const Parameters& p, double size) {
    Cloud<Dim> cloud;
    const auto numbers = numbers_of(p);
    for (int a = 0; a < Dim; ++a) cloud.axes[a] = numbers[static_cast<std::size_t>(a)];
    cloud.axes /= cloud.axes.minCoeff();
    cloud.size = size;
    std::array<int, Dim> cells;
    for (int a = 0; a < Dim; ++a)
        cells[static_cast<std::size_t>(a)] = 2 * static_cast<int>(std::ceil(size * cloud.axes[a]));
    const Points<Dim> sites = centred<Dim>(square_lattice<Dim>(cells));
    std::vector<Eigen::Index> inside;
    const auto depth = [&](const auto& x) {
        return 1.0 - (x.array() / (size * cloud.axes.array())).matrix().squaredNorm();
    };
    for (Eigen::Index k = 0; k < sites.cols(); ++k)
        if (depth(sites.col(k)) > 0.0) inside.push_back(k);
    auto particles = one_body(make_particles<Dim>(sites(Eigen::all, inside), 1.0));
    for (std::size_t i = 0; i < particles.size(); ++i)
        particles.mass[i] = depth(particles.reference_position.col(static_cast<Eigen::Index>(i)));
    cloud.model = gas_of<Dim>(p, std::move(particles), &cloud.y0);
    return cloud;
}

/// By second moments about the centre of mass.
template <int Dim>
Point<Dim> semi_axes(const Model<Dim>& model, std::span<const double> y, double size) {
    const ConstState<Dim> state(model.layout(), y);
    const auto& mass = model.particles().mass;
    const Point<Dim> centre = mean_by_mass<Dim>(mass, state.position());
    Points<Dim> squares = (state.position().colwise() - centre).array().square();
    return ((Dim + 4.0) * mean_by_mass<Dim>(mass, squares)).cwiseSqrt() / size;
}

/// e by what it is on the isentrope of the start, a mean by mass.
template <int Dim>
double entropy(const Model<Dim>& model, std::span<const double> y) {
    const auto rho = model.density(y);
    const ConstState<Dim> state(model.layout(), y);
    Eigen::RowVectorXd s = 2.0 * state.energy();
    for (std::size_t i = 0; i < rho.size(); ++i) s[static_cast<Eigen::Index>(i)] /= rho[i];
    return mean_by_mass<1>(model.particles().mass, s)[0];
}

const char* const names[] = {"axis_1", "axis_2", "axis_3"};

template <int Dim>
void draw(Session& session, const Cloud<Dim>& cloud, const RunRecord& run) {
    std::vector<CurvePanel> panels{frame("semi-axes", "t c/s", "a/s"),
                                   frame("less the exact ones", "t c/s", "%")};
    const auto t = run.history.column("t");
    for (int a = 0; a < Dim; ++a) {
        const auto found = run.history.column(names[a]);
        Curve off{.title = fmt::format("{:g}", cloud.axes[a]), .x = {}, .y = {}};
        Curve curve = off, exact = off;
        exact.title.clear();
        exact.like = a + 1;
        for (std::size_t k = 0; k < t.size(); ++k) {
            const double wanted = cloud.exact(t[k])[a];
            add_point(curve, t[k] / cloud.size, found[k]);
            add_point(exact, t[k] / cloud.size, wanted);
            add_point(off, t[k] / cloud.size, 100.0 * (found[k] / wanted - 1.0));
        }
        panels[0].curves.push_back(std::move(curve));
        panels[0].curves.push_back(std::move(exact));
        panels[1].curves.push_back(std::move(off));
    }
    draw_curves(session, "semi_axes", "A cloud of gas flies apart (dashed: exact)", panels);
    const auto& reference = cloud.model->particles().reference_position;
    std::vector<ConfigurationPanel> configurations;
    for (const auto& state : cloud.drawn) {
        if (!state.there()) continue;
        // In space the layer of sites that is next to the plane of the longest and the shortest axis at the start.
        std::vector<Eigen::Index> near;
        for (Eigen::Index i = 0; i < reference.cols(); ++i)
            if (Dim == 2 || (reference(1, i) > 0.0 && reference(1, i) < 1.0)) near.push_back(i);
        ConfigurationPanel panel{fmt::format("t c/s = {:.3g}", state.t / cloud.size), {}, {}, {}};
        panel.position.resize(2, static_cast<Eigen::Index>(near.size()));
        for (std::size_t k = 0; k < near.size(); ++k) {
            const auto to = static_cast<Eigen::Index>(k);
            panel.position.col(to) << state.position(0, near[k]), state.position(Dim - 1, near[k]);
            panel.colour.push_back(state.velocity.col(near[k]).norm());
        }
        configurations.push_back(std::move(panel));
    }
    draw_configurations(session, "configurations",
                        fmt::format("{}{} particles: the longest axis becomes the shortest",
                                    Dim == 3 ? "A layer of " : "", cloud.model->particles().size()),
                        configurations, configurations.size(), "speed");
}

template <int Dim>
Point<Dim> usual() {
    Point<Dim> axes;
    for (int a = 0; a < Dim; ++a) axes[a] = std::pow(2.0, Dim - 1 - a);
    return axes;
}

/// What another program found with the defaults, in % of the exact axes.
std::vector<double> known(const Parameters& p, double size) {
    const bool fixed = p.ranges == Ranges::fixed;
    if (p.ranges == Ranges::ellipses) {
        if (p.dimension == 2 && size == 10.0) return {-0.23, -0.31};
        if (size == 4.0) return {-2.0, -3.1, -3.5};
        return size == 6.0 ? std::vector{-0.9, -1.4, -1.5} : std::vector<double>{};
    }
    if (p.dimension == 3 && size == 4.0)
        return fixed ? std::vector{8.8, 0.0, -18.3} : std::vector{2.1, 0.6, -7.3};
    if (p.dimension == 3 && size == 6.0 && !fixed) return {2.1, 1.6, -4.3};
    if (p.dimension == 2 && size == 10.0)
        return fixed ? std::vector{1.6, -10.3} : std::vector{0.7, -0.9};
    return {};
}

template <int Dim>
void compute(Session& session, const Parameters& p) {
    const double size = p.size.value_or(session.common().smoke ? 3.0 : Dim == 3 ? 4.0 : 10.0);
    const double time = p.time.value_or(session.common().smoke ? 1.0 : Dim == 3 ? 8.0 : 4.0);
    std::vector<Cloud<Dim>> clouds{make_cloud<Dim>(p, size)};
    Cloud<Dim>& cloud = clouds.front();
    const double t_end = session.common().t_end.value_or((p.returns ? 2.0 : 1.0) * time * size);
    cloud.half_time = p.returns ? 0.5 * t_end : std::numeric_limits<double>::infinity();
    Plan<Dim> plan;
    plan.t_end = t_end;
    for (int a = 0; a < Dim; ++a)
        plan.record({{names[a], [a, size](const Model<Dim>& model, std::span<const double> y) {
                          return semi_axes(model, y, size)[a];
                      }}});
    if (p.rezone) {
        const double most = p.largest_volume.value_or(Dim == 3 ? 4.0 : 2.0);
        plan.rezone({.every = 0.05 * size,
                     .volume = RezoningLimits{most, 0.8 * most / (1 << Dim)},
                     .make = [&p](Particles<Dim> all) { return gas_of<Dim>(p, std::move(all)); }});
        plan.record({{"entropy", [](const Model<Dim>& model, std::span<const double> y) {
                          return entropy(model, y);
                      }}});
    }
    cloud.drawn = states_at<Dim>({0.0, 1.0 / 8.0, 1.0 / 4.0, 1.0 / 2.0}, t_end);
    plan.snapshot_every = t_end / 16.0;
    plan.observe(keep_nearest<Dim>(cloud.drawn));
    bool reversed = false;
    if (p.returns)
        plan.observe({.revise =
                          [&](double t, Model<Dim>& model, std::span<double> y) {
                              if (reversed || t < cloud.half_time * (1.0 - 1e-12)) return false;
                              reversed = true;
                              State<Dim>(model.layout(), y).velocity() *= -1.0;
                              return true;
                          },
                      .memory = [&](Archive& archive) { archive(reversed); }});
    const RunRecord run = session.run(*cloud.model, cloud.y0, std::move(plan));
    const Findings findings(session);
    const History& h = run.history;
    const auto others = known(p, size);
    const bool standard = run.complete && !session.common().smoke && !p.returns &&
                          time == (Dim == 3 ? 8.0 : 4.0) && cloud.axes == usual<Dim>() &&
                          session.at_default({"kernel", "range", "gradient-axes", "aspect"}) &&
                          !others.empty();
    for (int a = 0; a < Dim; ++a) {
        const double error = 100.0 * (h.last(names[a]) / cloud.exact(h.last("t"))[a] - 1.0);
        findings.measure(names[a], h.last(names[a]),
                         "second moments, by the shortest at the start");
        findings.claim(fmt::format("{}_error_percent", names[a]), error,
                       standard ? others[static_cast<std::size_t>(a)] : 0.0, 1.0,
                       "of the exact solution; expected: another program", standard);
    }
    findings.claim("energy_change", h.largest_change("energy") / h.first("energy"), 0.0, 1e-7,
                   "to the error of RK4", standard);
    // Where nothing is lost: the equations are reversible, and chaos has had no time.
    if (p.returns)
        for (int a = 0; a < Dim; ++a)
            findings.claim(fmt::format("{}_back", names[a]), h.last(names[a]) / h.first(names[a]),
                           1.0, 1e-3, "by the start", run.complete);
    findings.check_promises(run);
    if (session.plots()) draw(session, cloud, run);
}

}  // namespace
}  // namespace gas_cloud

int main(int argc, char** argv) {
    using namespace gas_cloud;
    Problem problem("gas_cloud", "an ellipsoid of gas flies apart in the void", 0.1);
    problem.units(fluid_units());
    Parameters p;
    auto& options = problem.options();
    options.integer("dimension", p.dimension, "3: an ellipsoid; 2: an ellipse in the plane",
                    between(2, 3));
    options.text(
        "axes", p.axes,
        "semi-axes along x, y and z, in proportion to each other (default 4,2,1; in the plane "
        "2,1)");
    options.number("size", p.size,
                   "the shortest semi-axis, in spacings (default 4; in the plane 10)",
                   between(2.0, 1000.0));
    options.number(
        "time", p.time,
        "how long it flies, in the shortest semi-axis by the speed of sound (default 8; in "
        "the plane 4)",
        between(1e-3, 1000.0));
    options.choice<Kernel>("kernel", p.kernel, all_kernels(), "weight function");
    options.number("range", p.range, "range h where the density is 1", between(1.5, 10.0));
    options.choice<Ranges>(
        "ranges", p.ranges, {Ranges::fixed, Ranges::density, Ranges::ellipses},
        "range of a particle: the same for all, range/rho^(1/dimension), or an ellipse that is drawn "
        "out with the gas");
    options.number(
        "gradient-axes", p.gradient_axes,
        "how much shorter ellipses begin along the gradient of the density: by 1/(1 + this |grad rho| "
        "range/rho)",
        between(0.0, 10.0));
    options.number("aspect", p.aspect, "largest ratio of the axes of an ellipse (default: none)",
                   between(1.01, 1e6));
    options.only_when(
        {"gradient-axes", "aspect"}, {"ranges"}, [&p] { return p.ranges == Ranges::ellipses; },
        "has a meaning with --ranges ellipses alone; leave it out");
    options.flag(
        "rezone", p.rezone,
        "split particles where the gas has become thin, and merge them where it is dense again");
    options
        .number(
            "largest-volume", p.largest_volume,
            "m/rho above which a particle is split into 4 (8 in space); below a quarter (an eighth) of it "
            "groups are merged into two (default 4; in the plane 2)",
            between(0.1, 1000.0))
        .needs("rezone");
    options.flag("return", p.returns, "reverse all velocities then, and fly as long again");
    options.one_of({"time", "t-end"}, "the end of the run");
    return problem.main(argc, argv, [&](Session& session) {
        p.dimension == 3 ? compute<3>(session, p) : compute<2>(session, p);
    });
}
