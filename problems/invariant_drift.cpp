// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: drift of energy and angular momentum in long runs with many integrators; 1 min on 2 cores
//
// Every method integrates for a long time, all with the same number of right-hand sides per time
// (study/drift_study.hpp). With which methods does the energy keep drifting, with which
// does it stay near what it was?
//
//     total_lagrangian   the hexagon of [HHM04] VI as a total-Lagrangian solid, `turns` turns
//     material_vectors   the same with material vectors, whose neighbours may change
//     md                 the same of points and springs
//     wave               a standing wave in smooth particles, `periods` periods
//     hexagon            smooth particles, torques of pairs balanced: one turn, they last no longer
#include "common.hpp"
#include <spam/analysis/plane_wave.hpp>
#include <spam/study/drift_study.hpp>

namespace {

using namespace spam;
using std::numbers::pi;

struct Parameters {
    std::string problem = "all";
    int size = 8, cells = 12;
    double speed = 0.1, turns = 10.0, periods = 100.0;
    double turn() const { return 2.0 * pi * size / speed; }
};

std::vector<Trial<2>> systems(const Parameters& p) {
    const int n = p.size;
    const double v = p.speed;
    const Scheme ringing{.transport = Transport::monaghan};
    const Scheme balanced{.transport = Transport::monaghan,
                          .angular_momentum = AngularMomentum::torque_pair};
    const auto wave = [c = p.cells, ringing] { return ringing_lattice(c, 0.1, ringing); };
    // Of linear elasticity: a wave as long as `cells` rows are high.
    const double period = p.cells * std::sqrt(0.75) / std::sqrt(3.0 / 8.0);
    return {
        {"total_lagrangian", "Total-Lagrangian hexagon", [=] { return lagrangian_hexagon(n, v); },
         p.turns * p.turn()},
        {"material_vectors", "Hexagon with material vectors",
         [=] { return material_vector_hexagon(n, v); }, p.turns * p.turn()},
        {"md", "Molecular dynamics: springs", [=] { return bonded_hexagon(n, v); },
         p.turns * p.turn()},
        {"wave", "Standing wave", wave, p.periods * period, "the border of the range is passed"},
        {"hexagon", "Smooth particles, pair torques",
         [=] { return smooth_hexagon(n, v, balanced); }, std::min(1.0, p.turns) * p.turn(),
         "the border of the range is passed"},
    };
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("invariant_drift", "drifts of energy and angular momentum in long runs");
    problem.units(lattice_units());
    Parameters p;
    DriftStudy study;
    auto& options = problem.options();
    std::vector<std::string> names;
    for (const auto& system : systems(p)) names.push_back(system.name);
    add_system_option(options, names, p.problem);
    options.integer("size", p.size, "n of the hexagons, which have 1 + 3n + 3n^2 particles",
                    between(2, 50));
    options.number("speed", p.speed, "speed of the corners of the hexagons", between(1e-6, 1e3));
    options.number("turns", p.turns, "number of nominal turns of hexagons", positive());
    options.integer("cells", p.cells, "cells x cells particles of the wave (an even number)",
                    between(8, 200));
    options.number("periods", p.periods, "number of periods of the wave", positive());
    options.only_when(
        {"size", "speed", "turns"}, {"problem"}, [&p] { return p.problem != "wave"; },
        "is of the hexagons, there are none with {by}; leave it out");
    options.only_when(
        {"cells", "periods"}, {"problem"},
        [&p] { return p.problem == "wave" || p.problem == "all"; },
        "is of the wave, there is none with {by}; leave it out");
    study.add_options(options);

    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("size", p.size, 3);
        session.smoke_default("turns", p.turns, 0.2);
        session.smoke_default("periods", p.periods, 2.0);
        auto trials = systems(p);
        if (p.problem != "all")
            std::erase_if(trials, [&](const auto& trial) { return trial.name != p.problem; });
        study.run<2>(session, trials);
    });
}
