// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: error against work of many integrators on many systems; 3 min on 2 cores
//
// Which integrator for which accuracy? Every method integrates every system with smaller and smaller
// steps, fixed ones and those it chooses itself; the error at the end is that against a reference
// (problem/work_precision.hpp says how it is found, and how errors and seconds are measured).
#include <spam/problem/work_precision.hpp>
#include <spam/spam.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace {

using namespace spam;

struct Parameters {
    std::string problem = "all";
    int size = 5, cells = 12, gas = 14;
    double speed = 0.1, shake = 0.1;
};

std::vector<Trial<2>> systems(const Parameters& p) {
    const Scheme averaged{.transport = Transport::monaghan, .range = 3.2};
    Scheme border = averaged, particle = averaged, reflected = averaged;
    border.range = 3.0;
    particle.angular_momentum = AngularMomentum::torque_particle;
    reflected.transport = Transport::plain;
    reflected.closest_approach = 0.85;
    const int n = p.size;
    const double v = p.speed, k = p.shake;
    return {
        {"hexagon", "Smooth particles, averaged velocities",
         [=] { return shaken(smooth_hexagon(n, v, averaged), k); }, 20.0},
        {"wave", "Standing wave", [=, c = p.cells] { return ringing_lattice(c, 0.1, averaged); },
         20.0},
        {"total_lagrangian", "Total-Lagrangian hexagon", [=] { return shaken(lagrangian_hexagon(n, v), k); },
         20.0},
        {"md", "Molecular dynamics", [=] { return shaken(bonded_hexagon(n, v), k); }, 20.0},
        {"border", "Neighbours at the border of the range",
         [=] { return shaken(smooth_hexagon(n, v, border), k); }, 20.0, "border"},
        {"expansion", "Expanding gas", [=, c = p.gas] { return expanding_gas(c); }, 10.0,
         "particles pass the range, where Lucy's force has a kink in its slope"},
        {"torque_particle", "Particle torques", [=] { return shaken(smooth_hexagon(n, v, particle), k); },
         20.0, "forces jump where the torque of a particle changes sign"},
        {"reflection", "Reflection", [=] { return shaken(smooth_hexagon(n, v, reflected), k); }, 10.0,
         "pairs are reflected"},
    };
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("integrator_accuracy", "error against work of many integrators");
    Parameters p;
    WorkPrecision study;
    study.standard_methods = {"leapfrog",
                              "rk4",
                              "arkode:HEUN_EULER_2_1_2",
                              "arkode:BOGACKI_SHAMPINE_4_2_3",
                              "arkode:CASH_KARP_6_4_5",
                              "arkode:DORMAND_PRINCE_7_4_5",
                              "arkode:VERNER_8_5_6",
                              "arkode:FEHLBERG_13_7_8",
                              "arkode:ZONNEVELD_5_3_4",
                              "gsl:rk8pd",
                              "cvode:adams"};
    auto& options = problem.options();
    std::vector<std::string> names{"all"};
    for (const auto& system : systems(p)) names.push_back(system.name);
    options.choice(
        "problem", names, "which system, or all of them",
        [&p, names](std::size_t k) { p.problem = names[k]; },
        [&p, names] {
            return static_cast<std::size_t>(std::find(names.begin(), names.end(), p.problem) -
                                            names.begin());
        });
    options.integer("size", p.size, "of hexagons: 1 + 3n + 3n^2 particles", between(2, 50));
    options.number("speed", p.speed, "of their corners", positive());
    options.number("shake", p.shake, "random speeds", positive());
    study.add_options(options);

    return problem.main(argc, argv, [&](Session& session) {
        if (session.common().smoke && !session.given("problem")) p.problem = "md";
        auto trials = systems(p);
        if (p.problem != "all")
            std::erase_if(trials, [&](const auto& trial) { return trial.name != p.problem; });
        study.run<2>(session, trials);
    });
}
