// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/instruction_set.hpp>
#include <spam/kernel/general_weight.hpp>
#include <spam/neighbors/cluster_view.hpp>
#include <spam/neighbors/displacement.hpp>
#include <spam/neighbors/home.hpp>
#include <spam/neighbors/image.hpp>
#include <spam/physics/pass_constants.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

/// Sweeps over pairs as functions of one type, whatever they sum: made by run_sweep.hpp in a *.lanes.cpp
/// for every instruction set, called by the terms of a model.
namespace spam {

/// What a sweep reads ...
template <int Dim>
struct SweepInput {
    ClusterView list;
    Records records;
    double range;                                ///< of the weight function
    const GeneralWeight<Dim>* weight = nullptr;  ///< not read by what is compiled for Lucy's
    PassConstants constants{};
};

/// Some hundred particles whose sums are complete, for the law that makes rates or records of them.
struct SweptBlock {
    std::size_t first_slot;
    const std::uint32_t* particle;  ///< their numbers, by slot
    std::size_t count;              ///< without lanes that only fill up a cluster
    const void* kept[2];            ///< by slot, what the first and the second pass that keep left

    /// What pass `k` of those that keep their sums has found, `count` values.
    template <class Value>
    const Value* sums(std::size_t k) const {
        return static_cast<const Value*>(kept[k]);
    }
};

/// ... and what it writes: fields by number of particle, null where they are not wanted; numbers of
/// records, by slot, that later sweeps read; and sums kept for a block, which `close` is given.
template <int Dim>
struct SweepOutput {
    double* x_dot = nullptr;                      ///< Dim x N, the transport velocity
    double* v_dot = nullptr;                      ///< Dim x N
    double *rho_dot = nullptr, *e_dot = nullptr;  ///< N
    double* rho = nullptr;                        ///< N, the summed density
    double* energy = nullptr;                     ///< N, a potential's
    double *positive_torque = nullptr, *negative_torque = nullptr;  ///< N, TorqueSums
    double* torque_parts = nullptr;                                 ///< 6 N, TorqueParts
    double* torque_moments = nullptr;                               ///< 9 N, SpaceTorqueSums
    double *spread = nullptr, *approach = nullptr;                  ///< N, OwnRangeSums
    double* records = nullptr;                                      ///< those of SweepInput

    /// Called once for every block, from any thread; null where no caller asks for it.
    void (*close)(const void* context, const SweptBlock&) = nullptr;
    const void* context = nullptr;
};

template <int Dim>
using Sweep = void (*)(const SweepInput<Dim>&, const SweepOutput<Dim>&);

/// Fields by number of particle, as records are made from them.
struct PackedFields {
    const double *x, *v, *m;        ///< v is not read for PointRecord
    const double* rho = nullptr;    ///< null where it is not known yet, or not part of the state
    const double* sigma = nullptr;  ///< D(D+1)/2 each; null where A is not made of it
    MeanDensityKind mean_density = MeanDensityKind::arithmetic;
};

/// The same, and the slots they go to.
template <int Dim>
struct PackInput : PackedFields {
    std::span<const std::uint32_t> order;  ///< slot -> particle
    const Home<Dim>* home;
    Displacement<Dim> displacement;
    std::size_t stride;
};

/// How many particles ...
struct PackCount {
    std::size_t far = 0;      ///< have gone too far for the list
    std::size_t invalid = 0;  ///< have a density that is not positive
};

/// Writes the columns of records that are known before any sweep: x (home.hpp), v, m, and where rho is
/// given the mean density's number of it and A = sigma/rho^2; with `density_only` these two alone.
template <int Dim>
struct Pack {
    PackCount (*write)(const PackInput<Dim>&, bool density_only, double* records) = nullptr;
    std::span<const NumberKind> kinds{};  ///< of the record
    std::size_t motion = 0;               ///< how many of these are x, v and m, which come first
    bool density = false;                 ///< whether rho is written, behind them
};

/// The sweeps of a term, compiled for an instruction set, in the order in which right-hand sides call
/// them. What a term has no need of is null.
template <int Dim>
struct Sweeps {
    int width;    ///< of the clusters they need
    int numbers;  ///< in a record
    Pack<Dim> pack{};
    Sweep<Dim> density = nullptr;   ///< summed density, or whatever else is summed first
    Sweep<Dim> gradient = nullptr;  ///< what stress and heat flux are made of
    Sweep<Dim> second = nullptr;    ///< balanced torques, viscosity, chain rule; a penalty
    Sweep<Dim> force = nullptr;
    Sweep<Dim> one_balance = nullptr;  ///< in place of force and second where all pairs have one R
    Sweep<Dim> torques = nullptr;  ///< sums of scaled torques, which balances in space take some of
    Sweep<Dim> energy = nullptr;   ///< of a potential
};

/// Sweeps of a law outside the library, by name: an object of this type in a file of spam_add_sweeps()
/// (CMake) makes those of one instruction set known before main() begins. `sweeps` is a function of that file and has
/// its instructions: it is called only on a processor that has them, where these sweeps are asked for.
template <int Dim>
struct RegisterSweeps {
    using Make = Sweeps<Dim> (*)();
    RegisterSweeps(const char* name, InstructionSet level, Make sweeps);
};

/// Those for this processor. Throws InputError where the name is unknown.
template <int Dim>
Sweeps<Dim> registered_sweeps(const std::string& name);

}  // namespace spam
