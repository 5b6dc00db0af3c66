// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/io/checkpoint_pair.hpp>
#include <spam/problem/plan.hpp>
#include <spam/rhs/model.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace spam {

/// One case of a session, as a checkpoint holds it: what others may want to look at by name, and the
/// rest as bytes.
struct CaseMemory {
    /// What never changes is looked at where it is, in the model, until keep() makes a copy of it.
    template <class T>
    struct Block {
        std::span<const T> elsewhere{};
        std::vector<T> kept{};

        std::span<const T> all() const { return kept.empty() ? elsewhere : kept; }
        void keep() {
            if (kept.empty()) kept.assign(elsewhere.begin(), elsewhere.end());
        }
    };
    /// rows x columns, by rows.
    struct Values {
        std::string name;
        std::size_t columns;
        Block<double> values;
    };
    std::string label;
    std::string model;  ///< in words, with its scheme
    double t = 0.0;
    std::vector<Values> state;      ///< y by field, one row a particle
    std::vector<Values> particles;  ///< mass, reference position
    Block<std::int64_t> id;
    std::vector<std::int32_t> body;
    std::vector<std::int32_t> material;  ///< only where particles change on the way (Rezoning)
    std::vector<std::byte> motion;       ///< model and integrator
    std::vector<std::byte> records;      ///< rows, remarks, what the problem gathered

    /// From now on without the model.
    void keep();
    /// False where the case has not come to its first checkpoint: it is begun from its start.
    bool has_state() const { return !state.empty(); }
};

/// The end and the intervals of a case.
struct PlanMemory {
    double t_end = 0.0, output_every = 0.0, snapshot_every = 0.0, checkpoint_every = 0.0;
};

/// All that a session writes into a checkpoint.
struct SessionMemory {
    std::string version, instruction_set;  ///< other ones may lead to other last digits
    std::string problem, case_toml, command;
    bool smoke = false;
    /// Whether every case stands at a time of its checkpoint schedule. What goes on from there is the
    /// same, bit for bit, as a run that was never stopped.
    bool on_schedule = true;
    std::vector<PlanMemory> plans;  ///< of all cases known, in order
    std::vector<CaseMemory> cases;  ///< those begun, in order
};

/// y and particles of a case at t. Until keep() the model must live on.
template <int Dim>
CaseMemory case_memory(const Model<Dim>& model, std::span<const double> y, double t);

/// The y that a memory holds. Throws InputError where the memory is not of this model: other fields,
/// numbers of particles, particles or masses.
template <int Dim>
std::vector<double> state_of(const CaseMemory& memory, const Model<Dim>& model);

/// Where particles have changed on the way the model of those that the memory holds, and its y, take the place of the
/// model of the start. Throws InputError where they are no particles.
template <int Dim>
void revive(Case<Dim>& one, const CaseMemory& memory);

/// The whole memory as a file. Writing it is left to the caller.
CheckpointWriter checkpoint_file(const SessionMemory& memory);

/// Throws InputError with one line where the file is not a whole checkpoint of this version.
SessionMemory read_checkpoint(const std::filesystem::path& file);

}  // namespace spam
