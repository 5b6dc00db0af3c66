// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: error against work: many integrators on eight systems, or one in space; 2 min on 2 cores
//
// Which integrator for which accuracy? Every method integrates every system with smaller and smaller
// steps, fixed ones and those it chooses itself; the error at the end is that against a reference
// (study/work_precision.hpp says how it is found, and how errors and seconds are measured).
//
// Smooth, orders claimed:       hexagon, total_lagrangian, md: turning, all their modes ringing
//                               wave: a standing wave in a periodic solid
// A force with a kink in its    range_at_shell: the range is a distance of the lattice, which pairs pass
// slope, as Lucy's at r = h:    to and fro; expansion: particles meet new ones. A step over a kink in
//                               the second derivative of y' errs by h^3, whatever the method
// A force that jumps:           torque_particle: order one
// Velocities that jump:         reflection: found in time, so that orders stay
// In space, with --problem cube alone (all others are in the plane): a cube that turns and rings, orders claimed
#include "common.hpp"
#include <spam/study/work_precision.hpp>

#include <Eigen/Geometry>

namespace {

using namespace spam;

struct Parameters {
    std::string problem = "all";
    int size = 5;
    double speed = 0.1;
};

/// Lattice distances are 3 and sqrt(12): nothing passes a range of 3.23 where particles stay near
/// their sites.
std::vector<Trial<2>> systems(const Parameters& p) {
    const int n = p.size;
    const double v = p.speed;
    const auto hexagon = [=](double range, AngularMomentum law) {
        const Scheme scheme{
            .transport = Transport::monaghan, .angular_momentum = law, .range = range};
        return [=] { return shaken(smooth_hexagon(n, v, scheme), 0.2 * v); };
    };
    const Scheme wave{.transport = Transport::monaghan, .range = 3.23};
    const Scheme reflected{.transport = Transport::plain, .closest_approach = 0.9, .range = 3.23};
    // Displacements of a millionth are known to fewer digits.
    const char* small = v < 1e-3 ? "so slow that positions keep few digits of the motion" : "";
    const char* kink = "pairs pass the range, where the slope of Lucy's force jumps";
    return {
        {"hexagon", "Smooth particles, averaged velocities, range 3.23",
         hexagon(3.23, AngularMomentum::free), 20.0, small},
        {"wave", "Standing wave, range 3.23", [=] { return ringing_lattice(12, 0.1, wave); }, 20.0},
        {"total_lagrangian", "Total-Lagrangian hexagon",
         [=] { return shaken(lagrangian_hexagon(n, v), v); }, 20.0, small},
        {"md", "Molecular dynamics: springs", [=] { return shaken(bonded_hexagon(n, v), v); }, 20.0,
         small},
        {"range_at_shell", "Smooth particles, range 3: a shell of neighbours",
         hexagon(3.0, AngularMomentum::free), 20.0, kink},
        {"expansion", "Expanding gas", [=] { return expanding_gas(14); }, 10.0, kink},
        {"torque_particle", "Particle torques", hexagon(3.23, AngularMomentum::torque_particle),
         20.0, "forces jump where the torque of a particle changes sign"},
        {"reflection", "Reflection at 0.9",
         [=] { return shaken(smooth_hexagon(n, v, reflected), 0.2 * v); }, 20.0,
         "velocities of pairs jump, at times found to 1e-12 of a length"},
    };
}

/// The same in space, the range between two shells of the simple cubic lattice.
Trial<3> cube(const Parameters& p) {
    const auto start = [n = p.size, v = p.speed] {
        const Scheme scheme{.transport = Transport::monaghan, .range = 2.63};
        const auto solid = ElasticSolid::triangular_lattice();
        auto particles = make_particles<3>(centred<3>(square_lattice<3>({n, n, n})), 1.0);
        const Point<3> omega =
            v / particles.reference_position.col(0).norm() * Point<3>(1, 2, 2) / 3;
        Start<3> begun{
            std::make_unique<SmoothParticleModel<3>>(std::move(particles), solid, scheme), {}};
        begun.y0 = initial_state<3>(
            *begun.model, 1.0, solid.eta, [=, turning = rigid_rotation(omega)](const Point<3>& x) {
                const Point<3> ringing(std::sin(7 * x.y()), std::sin(8 * x.z()),
                                       std::sin(9 * x.x()));
                return Point<3>(turning(x) + 0.2 * v * ringing);
            });
        return begun;
    };
    return {"cube", "Cube of smooth particles in space, averaged velocities, range 2.63", start,
            20.0};
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("integrator_accuracy", "error against work of many integrators");
    problem.units(lattice_units());
    Parameters p;
    WorkPrecision study;
    auto& options = problem.options();
    std::vector<std::string> names;
    for (const auto& system : systems(p)) names.push_back(system.name);
    names.emplace_back("cube");
    add_system_option(options, names, p.problem);
    options.integer(
        "size", p.size,
        "n of the hexagons, which have 1 + 3n + 3n^2 particles, and of the cube, which has n^3",
        between(2, 50));
    options.number("speed", p.speed, "speed of the corners of the hexagons and of the cube",
                   between(1e-6, 0.3));
    options.only_when(
        {"size", "speed"}, {"problem"},
        [&p] { return p.problem != "wave" && p.problem != "expansion"; },
        "is of the hexagons and the cube, there are none with {by}; leave it out");
    study.add_options(options);

    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("problem", p.problem, "md");
        if (p.problem == "md") session.smoke_default("size", p.size, 2);
        if (p.problem == "cube") return study.run<3>(session, {cube(p)});
        auto trials = systems(p);
        if (p.problem != "all")
            std::erase_if(trials, [&](const auto& trial) { return trial.name != p.problem; });
        study.run<2>(session, trials);
    });
}
