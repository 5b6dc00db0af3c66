// SPDX-License-Identifier: GPL-3.0-or-later
// A short run of every problem, and the files it leaves.
#pragma once

#include "problem/twins.hpp"
#include "support/effort.hpp"

#include <set>

namespace spam::test {

/// A second or less each; no interval of checkpoints divides the end.
inline const std::map<std::string, Words> short_runs{
    {"ball_plate",
     {"--radius", "3", "--columns", "24", "--rows", "4", "--t-end", "30", "--checkpoint-every",
      "3.3"}},
    {"cantilever", {"--layers", "4", "--t-end", "0.02", "--checkpoint-every", "0.0019"}},
    {"cavity", {"--cells", "12", "--t-end", "120", "--checkpoint-every", "17"}},
    {"cavitating_drop", {"--radius", "8", "--rate", "0.3", "--checkpoint-every", "0.93"}},
    {"collapse", {"--radius", "2.5", "--checkpoint-every", "0.0513"}},
    {"colliding_rings",
     {"--radius", "6", "--inner-radius", "3.5", "--t-end", "80", "--checkpoint-every", "7"}},
    {"couette", {"--cells", "16", "--t-end", "120", "--checkpoint-every", "17"}},
    {"counter_rotating", {"--size", "4", "--turns", "0.5", "--checkpoint-every", "9"}},
    {"crushed_sheet",
     {"--columns", "16", "--width", "6", "--t-end", "150", "--checkpoint-every", "17"}},
    {"diffusion_waves", {"--cells", "16", "--t-end", "20", "--checkpoint-every", "3"}},
    {"drop", {"--cells", "12", "--t-end", "30", "--checkpoint-every", "3.1"}},
    {"fragmenting_bar",
     {"--columns", "5", "--rows", "24", "--projectile", "3", "--offset", "3", "--t-end", "80",
      "--checkpoint-every", "7"}},
    {"free_expansion", {"--cells", "24", "--t-end", "25", "--checkpoint-every", "3.3"}},
    {"gas_cloud",
     {"--dimension", "2", "--size", "4", "--return", "--time", "1", "--ranges", "density",
      "--checkpoint-every", "1.3"}},
    {"isomorphism", {"--cells", "10", "--t-end", "40", "--checkpoint-every", "4"}},
    {"lattice_stability",
     {"--cells", "6", "--block", "6", "--range", "2", "--t-end", "3", "--snapshot-every", "0.3",
      "--checkpoint-every", "0.37"}},
    {"md_fields",
     {"--cells", "13", "--radius", "4", "--offset", "3", "--t-end", "1.5", "--output-every", "0.05",
      "--checkpoint-every", "0.23"}},
    {"mesh_modes", {"--elements", "6", "--t-end", "30", "--checkpoint-every", "7"}},
    {"phase_separation",
     {"--cells", "24", "--disorder", "0.2", "--t-end", "15", "--checkpoint-every", "1.3"}},
    {"pierced_bar",
     {"--columns", "5", "--rows", "24", "--projectile", "3", "--t-end", "13", "--checkpoint-every",
      "1.1"}},
    {"plane_wave",
     {"--cells", "10", "--t-end", "20", "--perturb", "1e-6", "--checkpoint-every", "3"}},
    {"polytrope",
     {"--particles", "80", "--relaxation-time", "2", "--t-end", "3", "--checkpoint-every", "0.7"}},
    {"poiseuille", {"--cells", "16", "--t-end", "120", "--checkpoint-every", "17"}},
    {"rayleigh_benard", {"--height", "10", "--t-end", "25", "--checkpoint-every", "3.3"}},
    {"reaction_front",
     {"--width", "3", "--rows", "4", "--heat", "0.5", "--t-end", "3", "--checkpoint-every", "0.7"}},
    {"relaxation", {"--particles", "80", "--t-end", "4", "--checkpoint-every", "0.37"}},
    {"rotating_body",
     {"--size", "4", "--turns", "0.2", "--angular-momentum", "torque_pair", "--transport",
      "average", "--checkpoint-every", "5.3"}},
    {"rotating_disk", {"--radius", "9", "--t-end", "60", "--checkpoint-every", "7"}},
    {"rotating_hexagon", {"--size", "5", "--t-end", "90", "--checkpoint-every", "11"}},
    {"plastic_block", {"--checkpoint-every", "1.7"}},
    {"sheared_square", {"--cells", "12", "--checkpoint-every", "7"}},
    {"shock_tube", {"--cells", "200", "--t-end", "0.1", "--single", "--checkpoint-every", "0.007"}},
    {"blast", {"--cells", "24", "--single", "--t-end", "0.009", "--checkpoint-every", "0.0013"}},
    {"string_phase", {"--t-end", "10", "--checkpoint-every", "1.3"}},
    {"taylor_green", {"--cells", "14", "--t-end", "50", "--checkpoint-every", "7"}},
    {"taylor_bar", {"--particles-per-radius", "2", "--t-end", "4", "--checkpoint-every", "0.37"}},
    {"tensile_instability", {"--cells", "8", "--t-end", "3", "--checkpoint-every", "0.37"}},
    {"torsion", {"--columns", "3", "--periods", "0.7", "--checkpoint-every", "7"}},
    {"tension_test",
     {"--columns", "16", "--rows", "6", "--load-rate", "4e-5", "--t-end", "120",
      "--checkpoint-every", "17"}},
    {"water_column",
     {"--model", "both", "--width", "6", "--relaxation-time", "4", "--t-end", "4",
      "--checkpoint-every", "0.67"}},
};
/// In space, what is plane above: one of them, or all in long runs.
inline const std::vector<std::pair<std::string, Words>> short_runs_in_space{
    {"free_expansion",
     {"--dimension", "3", "--cells", "8", "--t-end", "7", "--checkpoint-every", "0.9"}},
    {"ball_plate",
     {"--model", "pair_md", "--dimension", "3", "--radius", "2", "--columns", "10", "--rows", "4",
      "--t-end", "6", "--checkpoint-every", "0.7"}},
    {"gas_cloud", {"--size", "2", "--time", "2", "--checkpoint-every", "0.7"}},
    {"gas_cloud",
     {"--size", "2", "--time", "2", "--ranges", "ellipses", "--checkpoint-every", "0.7"}},
    {"plane_wave",
     {"--dimension", "3", "--cells", "8", "--t-end", "20", "--checkpoint-every", "2.3"}},
    {"tensile_instability",
     {"--dimension", "3", "--cells", "6", "--t-end", "2", "--checkpoint-every", "0.3"}},
    {"tension_test",
     {"--dimension", "3", "--columns", "10", "--rows", "4", "--load-rate", "2e-4", "--t-end", "30",
      "--checkpoint-every", "3.7"}},
};

/// Those of every problem, and of space.
inline std::vector<std::pair<std::string, Words>> all_short_runs() {
    std::vector<std::pair<std::string, Words>> all(short_runs.begin(), short_runs.end());
    const auto first = short_runs_in_space.begin();
    all.insert(all.end(), first, long_runs() ? short_runs_in_space.end() : first + 1);
    return all;
}

/// Analyses, and studies that go on from their table.
inline const std::set<std::string> without_checkpoints{"algorithm_sweep",
                                                       "integrator_accuracy",
                                                       "invariant_drift",
                                                       "kernels",
                                                       "loaded_bar",
                                                       "lyapunov",
                                                       "material_vectors_study",
                                                       "parallel_efficiency",
                                                       "thousand_turns",
                                                       "stability",
                                                       "turns_survived"};

/// Tables, configurations and the result, by their names; with `checkpoints` these as well, which hold the command.
inline std::map<std::string, std::string> files_of(const std::filesystem::path& folder,
                                                   bool checkpoints = false) {
    std::map<std::string, std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const auto extension = entry.path().extension();
        if (extension == ".csv" || extension == ".vtp" || extension == ".vti" ||
            extension == ".pvd" || entry.path().filename() == "result.json" ||
            (checkpoints && extension == ".h5"))
            all[entry.path().lexically_relative(folder).string()] = contents_of(entry.path());
    }
    return all;
}

}  // namespace spam::test
