// SPDX-License-Identifier: GPL-3.0-or-later
// What idle_options.cpp tries: another value of every option, in cases that leave different ones without
// effect.
#pragma once

#include "problem/option_values.hpp"

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace spam::test {

using Words = std::vector<std::string>;

/// How to run, not what to compute.
inline const std::set<std::string> no_part_of_the_case{
    "config",   "out",     "force", "dry-run", "smoke",   "quiet",   "help",
    "no-plots", "threads", "ranks", "jobs",    "version", "restart", "movie"};

/// Of the session and its integrator: they act, or are refused, in code that all cases of a program share. A case
/// that leaves the same kind of results as an earlier one (one run, several, none) does not try them again. What
/// a case has a say in is not among them: its end, its step, and the angular momentum, which a line has not.
inline const std::set<std::string> of_the_session{
    "integrator",     "output-every",  "snapshot-every", "checkpoint-every", "guard",
    "limit-momentum", "limit-energy",  "controller",     "safety",           "min-step",
    "max-step",       "initial-step",  "max-steps",      "relaxation",       "rtol",
    "atol",           "atol-position", "atol-velocity",  "atol-density",     "atol-stress",
    "atol-energy"};

/// What a program cannot show: its momentum is exactly zero at all times, by symmetry, and no limit is passed.
inline const std::set<std::pair<std::string, std::string>> cannot_show{
    {"colliding_rings", "limit-momentum"}};

/// What must happen for an option to show: given beside it, and to the run it is compared with.
inline const std::map<std::string, Words> beside{
    {"left", {"--right", "rigid"}},
    {"right", {"--left", "rigid"}},
    {"balance", {"--t-end", "80"}},  // the bar has broken
    {"guard", {"--limit-energy", "1e-300"}},
    {"gauss-singular", {"--t-end", "40"}},  // the constraint sets in at 14 and is singular at 36
};

/// Of one program alone: what keeps its runs short.
inline const std::map<std::pair<std::string, std::string>, Words> own_beside{
    {{"cantilever", "compare"}, {"--t-end", "0.005"}},
    {{"collapse", "compare"}, {"--t-end", "0.02"}},
    {{"plane_wave", "dimension"}, {"--t-end", "3"}},
    {{"taylor_bar", "compare"}, {"--t-end", "0.02"}},
    {{"tension_test", "dimension"}, {"--t-end", "20"}},
    {{"tension_test", "dt"}, {"--t-end", "20"}},
    {{"tension_test", "load-rate"}, {"--t-end", "20"}},  // else as long as it lasts
    {{"water_column", "compare"},
     {"--width", "4", "--samples", "1", "--relaxation-time", "0.5", "--t-end", "0.5"}},
};

/// Cases of problems that leave different options without effect.
inline const std::vector<std::pair<std::string, Words>> cases{
    {"rotating_hexagon", {}},
    {"rotating_hexagon", {"--model", "md"}},
    {"rotating_hexagon", {"--formulation", "total_lagrangian"}},
    {"rotating_hexagon", {"--formulation", "material_vectors"}},
    {"rotating_hexagon", {"--figure", "6"}},
    {"rotating_hexagon", {"--angular-momentum", "gauss", "--transport", "monaghan"}},
    {"rotating_hexagon", {"--integrator", "arkode:BOGACKI_SHAMPINE_4_2_3"}},
    {"rotating_body", {"--size", "4"}},
    {"rotating_body", {"--body", "block", "--formulation", "total_lagrangian", "--turns", "0.1"}},
    {"rotating_disk", {"--model", "md"}},
    {"rotating_disk", {"--model", "spam"}},
    {"plane_wave", {}},
    {"plane_wave", {"--polarization", "transverse"}},
    {"plane_wave", {"--perturb", "1e-6", "--t-end", "20"}},
    {"plane_wave",
     {"--compare-sizes", "--cells", "16", "--closest-approach", "0.5", "--polarization",
      "transverse"}},
    {"tensile_instability", {}},
    {"tensile_instability", {"--stress", "0.01", "--speed", "0.01"}},
    {"tensile_instability",
     {"--dimension", "3", "--stress", "0.02", "--cells", "6", "--speed", "0.01"}},
    {"stability", {}},
    {"stability", {"--transport", "monaghan"}},
    {"stability", {"--formulation", "material_vectors"}},
    {"material_vectors_study", {}},
    {"thousand_turns", {}},
    {"sheared_square", {"--cells", "10"}},
    {"counter_rotating", {}},
    {"counter_rotating", {"--angular-momentum", "gauss"}},
    {"fragmenting_bar", {}},
    {"fragmenting_bar", {"--formulation", "material_vectors"}},
    {"pierced_bar", {"--contact", "repulsive", "--t-end", "14"}},
    {"pierced_bar", {"--contact", "none", "--t-end", "14"}},
    {"algorithm_sweep", {"--size", "1", "--speed", "0.4", "--dt", "0.1"}},
    {"integrator_accuracy", {"--size", "2"}},
    {"invariant_drift", {}},
    {"kernels", {}},
    {"free_expansion", {"--t-end", "5"}},
    {"free_expansion", {"--dimension", "1"}},
    {"free_expansion", {"--dimension", "3", "--cells", "6", "--t-end", "4"}},
    {"free_expansion", {"--compare", "--t-end", "6"}},
    {"gas_cloud", {"--size", "3", "--time", "0.5"}},
    {"gas_cloud", {"--ranges", "ellipses", "--size", "3", "--time", "0.5"}},
    {"gas_cloud", {"--rezone", "--dimension", "2", "--size", "3", "--time", "1"}},
    {"gas_cloud", {"--return", "--size", "3", "--time", "0.5", "--axes", "2,1,1"}},
    {"cavitating_drop", {"--radius", "6", "--rate", "0.3"}},
    {"phase_separation", {"--cells", "12", "--t-end", "8"}},
    {"phase_separation", {"--wave", "3"}},
    {"phase_separation", {"--isolated", "--cells", "12"}},
    {"collapse", {}},
    {"loaded_bar", {}},
    {"lyapunov", {}},
    {"lyapunov", {"--case", "hexagon"}},
    {"parallel_efficiency", {"--sizes", "300", "--cells", "8", "--turns", "1"}},
    {"polytrope", {}},
    {"reaction_front", {"--heat", "0.5"}},
    {"torsion", {"--columns", "3", "--periods", "0.2"}},
    {"torsion", {"--columns", "3", "--periods", "0.1", "--formulation", "updated"}},
    {"isomorphism", {}},
    {"diffusion_waves", {"--density", "continuity"}},
    {"diffusion_waves",
     {"--wave", "shear", "--equation-of-state", "van_der_waals", "--density", "continuity"}},
    {"turns_survived", {"--turns", "0.2"}},
    {"string_phase", {"--t-end", "4"}},
    {"string_phase", {"--core", "0"}},
    {"drop", {}},
    {"drop", {"--core", "0.1", "--disorder", "0.1"}},
    {"md_fields", {}},
    {"md_fields", {"--system", "fluid"}},
    {"mesh_modes", {}},
    {"lattice_stability", {"--range", "2", "--cells", "6", "--block", "6", "--t-end", "0.1"}},
    {"lattice_stability", {"--potential", "both"}},
    {"lattice_stability", {"--potential", "density"}},
    {"relaxation", {"--t-end", "4"}},
    {"couette", {}},
    {"poiseuille", {}},
    {"taylor_green", {}},
    {"taylor_green", {"--disorder", "0.1"}},
    {"taylor_green", {"--transport", "plain"}},
    {"colliding_rings", {"--formulation", "total_lagrangian"}},
    {"colliding_rings", {"--formulation", "updated"}},
    {"cantilever", {"--formulation", "total_lagrangian"}},
    {"cantilever", {"--formulation", "updated"}},
    {"cantilever", {"--formulation", "material_vectors"}},
    {"crushed_sheet", {}},
    {"cavity", {"--density", "continuity"}},
    {"shock_tube", {}},
    {"shock_tube", {"--toro", "5", "--work", "mean"}},
    {"blast",
     {"--work", "mean", "--ratio", "10", "--range", "2.5", "--finer", "2", "--t-end", "0.003",
      "--cells", "16"}},
    {"rayleigh_benard", {"--density", "continuity"}},
    {"water_column", {"--width", "5", "--relaxation-time", "1"}},
    {"water_column",
     {"--width", "5", "--range", "2.5", "--model", "both", "--relaxation-time", "3"}},
    {"plastic_block", {}},
    {"plastic_block", {"--formulation", "total_lagrangian"}},
    {"plastic_block", {"--yield", "smooth"}},
    {"taylor_bar", {"--t-end", "1.5"}},
    {"water_column", {"--core", "0"}},
    {"tension_test", {"--columns", "12", "--rows", "4"}},
    {"tension_test", {"--model", "pair_md", "--columns", "12", "--rows", "4"}},
    {"tension_test", {"--dimension", "3", "--model", "pair_md", "--columns", "12", "--rows", "4"}},
    {"tension_test", {"--model", "embedded_atom", "--load-rate", "1e-3"}},
    {"tension_test",
     {"--model", "material_vectors", "--columns", "8", "--rows", "6", "--load-rate", "1e-3"}},
    {"ball_plate", {}},
    {"ball_plate", {"--model", "pair_md"}},
    {"ball_plate", {"--model", "embedded_atom", "--contact", "repulsive"}},
    {"ball_plate", {"--model", "elements"}},
};

}  // namespace spam::test
