// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: steady stress of a rotating elastic disk against elasticity, [HHM04] VI; 2 s
//
// The stationary stress of a rotating elastic body, [HHM04] VI.
//
//          . o o .         A disk (or a hexagon) of triangular lattice turns with angular velocity
//        o o o o o o       omega and stretches until its stress holds the centrifugal force:
//       o o o x o o o
//        o o o o o o           d sigma_rr/dr + (sigma_rr - sigma_tt)/r + rho omega^2 r = 0
//          . o o .
//
// For lambda = eta and a disk of radius R, free at its rim, linear elasticity says
//
//     u_r      = (rho r omega^2/eta) (5 R^2 - 2 r^2)/48        (printed otherwise, rotating_disk.hpp)
//     sigma_rr = (5 rho omega^2/12) (R^2 - r^2)
//     sigma_tt = (5 rho omega^2/12) (R^2 - 3 r^2/5)
//
// The body starts unstrained in rigid rotation, so that nothing of this is put in. It would vibrate
// for long; a friction of all that is not rigid motion takes the vibration away and leaves rotation
// and angular momentum alone (external/friction.hpp). R: of a disk of the same area.
//
// Molecular dynamics (its stress is the virial of the bonds) comes to rest there within a per cent.
// Smooth particles come near it in two sound traversals, and never to rest: at the rim, where half of
// the neighbours are missing, the sums take part of the rotation for a strain, which winds up a shear
// sigma_rt in proportion to the angle turned.
#include "rotating_disk/rotating_disk.hpp"

#include "rotating_disk/polar_stress.hpp"
#include <spam/external/friction.hpp>

namespace {

using namespace spam;

enum class Shape { disk, hexagon };
enum class Which { both, md, spam };
std::string_view to_string(Shape shape) { return shape == Shape::disk ? "disk" : "hexagon"; }
std::string_view to_string(Which which) {
    return which == Which::both ? "both" : which == Which::md ? "md" : "spam";
}

const double rho = triangular_density;  // stress-free; mass and spacing are 1
const double eta = triangular_modulus;  // = lambda
const double c_L = std::sqrt(3.0 * eta / rho);

struct Parameters {
    double radius = 12.0;  // of the outermost particles
    double speed = 0.1;    // at that radius
    std::optional<double> damping;
    Shape shape = Shape::disk;
    Which model = Which::both;

    double omega() const { return speed / radius; }
    double traversal() const { return 2.0 * radius / c_L; }  // of the body, by sound
};

/// A body, its elasticity, and where its rim begins: a range of smooth particles away from its edge.
struct Body : Variant<2> {
    double R, rim;
};

/// Stresses are measured in the mean over the rim and over what is inside of it.
void refuse_empty(const Parameters& p, const Scheme& scheme, const Points<2>& x, double rim) {
    const auto r = x.colwise().norm();
    if (!(r.minCoeff() < rim))
        refuse(
            "range: no particle of a {} of radius {:g} is farther than h = {:g} from the rim, and "
            "nothing is inside; choose a shorter --range or a larger --radius",
            to_string(p.shape), p.radius, scheme.range);
    if (!(r.maxCoeff() >= rim))
        refuse(
            "range: no particle of a {} of radius {:g} is within h = {:g} of the rim; choose a "
            "longer --range",
            to_string(p.shape), p.radius, scheme.range);
}

Body make_body(const Parameters& p, const Scheme& scheme, bool md) {
    auto particles =
        make_particles<2>(p.shape == Shape::disk ? triangular_disk(p.radius)
                                                 : triangular_hexagon(static_cast<int>(p.radius)),
                          1.0);
    const double R = std::sqrt(static_cast<double>(particles.size()) / (rho * std::numbers::pi));
    Body body{{}, R, R - scheme.range};
    body.call(md ? "md" : "spam");
    body.title = md ? "molecular dynamics" : "SPAM";
    if (md)
        body.model = std::make_unique<BondedModel<2>>(std::move(particles), HarmonicSpring{});
    else
        body.model = std::make_unique<SmoothParticleModel<2>>(
            std::move(particles), ElasticSolid::triangular_lattice(), scheme);
    refuse_empty(p, scheme, body.model->particles().reference_position, body.rim);
    if (*p.damping > 0.0) body.model->add(std::make_unique<Friction<2>>(*p.damping));
    body.y0 = lattice_state(*body.model, rigid_rotation(p.omega()));
    return body;
}

/// Elasticity of a body that turns as fast as this one does by now.
RotatingDisk elasticity(const Body& body, std::span<const double> y) {
    const ConstState<2> state(body.model->layout(), y);
    const auto x = state.position(), v = state.velocity();
    const Points<2> from_centre = x.colwise() - Point<2>(x.rowwise().mean());
    const double L =
        (from_centre.row(0).cwiseProduct(v.row(1)) - from_centre.row(1).cwiseProduct(v.row(0)))
            .sum();
    return {rho, eta, L / from_centre.squaredNorm(), body.R};
}

struct Component {
    const char* name;
    std::vector<double> PolarStress::*measured;
    double (RotatingDisk::*exact)(double r) const;
};
constexpr Component components[] = {{"radial", &PolarStress::radial, &RotatingDisk::radial_stress},
                                    {"hoop", &PolarStress::hoop, &RotatingDisk::hoop_stress},
                                    {"shear", &PolarStress::shear, &RotatingDisk::shear_stress}};

/// Root mean square deviation from elasticity of the particles of the rim or of those inside,
/// divided by the stress at the centre.
double deviation(const Body& body, std::span<const double> y, const Component& component,
                 bool of_rim) {
    const auto stress = polar_stress(*body.model, y, rho);
    const auto exact = elasticity(body, y);
    const auto& measured = stress.*component.measured;
    double sum = 0.0, n = 0.0;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        if ((stress.r[i] >= body.rim) != of_rim) continue;
        const double off = measured[i] - (exact.*component.exact)(stress.r[i]);
        sum += off * off;
        n += 1.0;
    }
    return std::sqrt(sum / n) / exact.centre_stress();
}

/// radial_inner, radial_rim, hoop_inner, ...
std::vector<Column<2>> deviation_columns(const Body& body) {
    std::vector<Column<2>> columns;
    for (const Component& component : components)
        for (const bool rim : {false, true})
            columns.push_back({fmt::format("{}_{}", component.name, rim ? "rim" : "inner"),
                               [&body, component, rim](const Model<2>&, std::span<const double> y) {
                                   return deviation(body, y, component, rim);
                               }});
    return columns;
}

/// The case whose numbers are known.
bool is_known(const Session& session) {
    auto options = Problem::scheme_option_names();
    options.insert(options.end(),
                   {"shape", "radius", "speed", "damping", "kernel", "range", "t-end"});
    options.insert(options.end(), IntegratorSettings::names().begin(),
                   IntegratorSettings::names().end());
    return session.when_default(options);
}

void check(Session& session, const Body& body, const RunRecord& run, double omega, bool known) {
    const bool md = body.label == "md";
    for (const Component& component : components)
        for (const std::string where : {"inner", "rim"}) {
            const auto column = fmt::format("{}_{}", component.name, where);
            // The rim, and the shear of smooth particles, are what discrete bodies do otherwise.
            session.claim({fmt::format("{}_{}", body.label, column), run.history.last(column), 0.0,
                           md ? 0.03 : 0.12, "[HHM04] VI: the stresses of the disk"},
                          known && where == "inner" && (md || column != "shear_inner"));
        }
    const auto measured = [&](const char* name, double value) {
        session.measure(fmt::format("{}_{}", body.label, name), value);
    };
    measured("closest_pair", run.history.smallest("closest_pair"));
    if (session.scheme().closest_approach > 0.0 && !md)
        measured("reflections", static_cast<double>(run.statistics.events));
    if (!md && run.complete)
        session.measure("spam_shear_rim_per_radian",
                        run.history.last("shear_rim") / (omega * run.statistics.t_end),
                        "measured: rotation taken for strain");
    session.check_promises(run, body.label + "_");
}

// ---- pictures ----

Curve exact_curve(const RotatingDisk& exact, const Component& component) {
    return graph(
        "elasticity", 0.0, 1.0, 60,
        [&](double r) { return (exact.*component.exact)(r * exact.R) / exact.centre_stress(); }, 1);
}

/// Stress against radius, and the bodies coloured by it; in units of R and of the stress at the
/// centre.
void draw(Session& session, const std::vector<Body>& bodies, const std::vector<RunRecord>& runs) {
    const RotatingDisk exact = elasticity(bodies.front(), runs.front().y);
    const double unit = exact.centre_stress();
    std::vector<CurvePanel> curves;
    std::vector<ConfigurationPanel> configurations;
    for (const Component& component : components) {
        CurvePanel panel = frame(fmt::format("{} stress", component.name), "r / R", "stress / σ₀");
        for (std::size_t k = runs.size(); k-- > 0;) {  // the narrower cloud on top
            const auto s = polar_stress(*bodies[k].model, runs[k].y, rho);
            panel.curves.push_back({bodies[k].title, divided(s.r, exact.R),
                                    divided(s.*component.measured, unit), Mark::points,
                                    bodies[k].label == "md" ? 3 : 2});
        }
        panel.curves.push_back(exact_curve(exact, component));
        curves.push_back(panel);
        for (std::size_t k = 0; k < runs.size(); ++k) {
            const auto s = polar_stress(*bodies[k].model, runs[k].y, rho);
            configurations.push_back(
                {fmt::format("{}, {} stress", bodies[k].title, component.name),
                 ConstState<2>(bodies[k].model->layout(), runs[k].y).position(),
                 divided(s.*component.measured, unit),
                 {}});
        }
    }
    const auto title =
        fmt::format("Rotating elastic body, {} particles, after {:.2f} rad",
                    runs.front().statistics.particles, exact.omega * runs.front().statistics.t_end);
    draw_curves(session, "stress", title, curves);
    draw_configurations(session, "configurations", title, configurations, runs.size(),
                        "stress / σ₀");
}

/// Every particle: distance and stress.
void write_stress(const RunFolder& folder, const Body& body, const RunRecord& run) {
    CsvWriter csv(folder / fmt::format("stress_{}.csv", body.label),
                  {"r", "radial", "hoop", "shear", "radial_exact", "hoop_exact"});
    const auto s = polar_stress(*body.model, run.y, rho);
    const auto exact = elasticity(body, run.y);
    for (std::size_t i = 0; i < s.r.size(); ++i)
        csv.add(std::vector<double>{s.r[i], s.radial[i], s.hoop[i], s.shear[i],
                                    exact.radial_stress(s.r[i]), exact.hoop_stress(s.r[i])});
}

void refuse_impossible(const Parameters& p) {
    if (p.shape == Shape::hexagon && p.radius != std::floor(p.radius))
        refuse("radius: {} must be a whole number of spacings for --shape hexagon", p.radius);
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("rotating_disk", "steady stress of a rotating elastic disk, [HHM04] VI");
    problem.units(lattice_units());
    Parameters p;
    auto& options = problem.options();
    options.choice<Shape>("shape", p.shape, {Shape::disk, Shape::hexagon},
                          "a disk, or a hexagon with its corners at the radius");
    options.number("radius", p.radius, "distance of the outermost particles from the centre",
                   between(6, 1000));
    options.number("speed", p.speed, "speed at the radius", between(1e-6, 1e3));
    options.number("damping", p.damping,
                   "rate of the friction on motion that is not rigid (default 3 c_L/radius)",
                   between(0.0, 1e3));
    options.choice<Which>("model", p.model, {Which::both, Which::md, Which::spam},
                          "smooth particles, molecular dynamics with springs, or both");
    Scheme standard;
    standard.transport = Transport::monaghan;
    standard.angular_momentum = AngularMomentum::torque_pair;
    problem.use_scheme(standard);
    auto of_smooth_particles = Problem::scheme_option_names();
    of_smooth_particles.emplace_back("kernel");  // --range says how wide the rim is
    options.only_when(
        of_smooth_particles, {"model"}, [&p] { return p.model != Which::md; },
        "has no meaning for --model md (springs between initial neighbours); leave "
        "it out");

    return problem.main(argc, argv, [&](Session& session) {
        refuse_impossible(p);
        session.smoke_default("radius", p.radius, 7.0);
        if (!p.damping) p.damping = 3.0 * c_L / p.radius;

        std::vector<Body> bodies;
        for (const Which which : {Which::md, Which::spam})
            if (p.model == which || p.model == Which::both)
                bodies.push_back(make_body(p, session.scheme(), which == Which::md));
        const auto runs = run_all(session, bodies, [&](const Body& body) {
            Plan<2> plan;
            plan.t_end = 2.0 * p.traversal();
            plan.record(deviation_columns(body));
            plan.record({closest_pair_column<2>()});
            return plan;
        });
        for (std::size_t k = 0; k < runs.size(); ++k) {
            check(session, bodies[k], runs[k], p.omega(), runs[k].complete && is_known(session));
            write_stress(session.folder(), bodies[k], runs[k]);
        }
        if (session.plots()) draw(session, bodies, runs);
    });
}
