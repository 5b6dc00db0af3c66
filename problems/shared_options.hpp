// SPDX-License-Identifier: GPL-3.0-or-later
// Options that several problems have, with what they refuse.
#pragma once

#include <spam/core/error.hpp>
#include <spam/io/options.hpp>
#include <spam/physics/scheme.hpp>
#include <spam/rhs/contact.hpp>

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace spam {

/// Refuses the input with this line: what, where, what is allowed, how to mend it.
template <class... Args>
[[noreturn]] void refuse(fmt::format_string<Args...> words, Args&&... args) {
    throw InputError(fmt::format(words, std::forward<Args>(args)...));
}

/// --core and --core-range, of the potential that keeps two particles apart.
/// `usual`: an energy to propose.
inline void add_core_options(Options& options, double& core, double& range, Allowed ranges,
                             std::string_view usual) {
    options.number("core", core, "energy of the core that keeps two particles apart; 0 for none",
                   between(0.0, 1e3));
    options.number("core-range", range, "distance at which cores touch", std::move(ranges))
        .only_when(
            {"core"}, [&core] { return core > 0.0; },
            fmt::format("has no meaning without a core; give --core {}, or leave it out", usual));
}
/// `otherwise`: how to have none.
inline void refuse_short_core(double core, double range, std::string_view otherwise) {
    if (core > 0.0 && range < 0.01)
        refuse(
            "core-range: {:g} is below a hundredth of the spacing, 1: no step "
            "resolves such a "
            "core; give 0.01 or more, or {}",
            range, otherwise);
}

/// --disorder and --seed, of a lattice that is not perfect. `usual`: a disorder to propose.
inline void add_disorder_options(Options& options, double& disorder, int& seed, std::string help,
                                 double most, std::string_view usual) {
    options.number("disorder", disorder, std::move(help), between(0.0, most));
    options.integer("seed", seed, "seed of the random displacements", between(0, 1000000000))
        .only_when(
            {"disorder"}, [&disorder] { return disorder > 0.0; },
            fmt::format("has no meaning without disorder; give --disorder {}, or "
                        "leave it out",
                        usual));
}

/// Whether bodies repel each other, or are neighbours like any others.
enum class ContactKind { none, repulsive };
inline std::string_view to_string(ContactKind kind) {
    return kind == ContactKind::none ? "none" : "repulsive";
}
/// --contact-energy and --contact-range; the last argument names what touches each other.
inline void add_contact_options(Options& options, ContactScheme& contact, std::string_view who) {
    options.number("contact-energy", contact.energy, "energy e_c of the contact",
                   between(1e-3, 1e3));
    options.number("contact-range", contact.range,
                   fmt::format("distance at which {} touch, at most a spacing", who), positive());
}

inline void add_density_option(Options& options, Density& density) {
    options.choice<Density>("density", density, {Density::summed, Density::continuity},
                            "density as a sum over neighbours, or by the continuity equation");
}

/// --jobs: as many as there are cores, and no part of the case.
inline int all_cores() {
    return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}
inline Options::Added add_jobs_option(Options& options, int& jobs, std::string help) {
    auto added = options.integer("jobs", jobs, std::move(help), between(1, 1024));
    options.exclude_from_case({"jobs"});
    return added;
}

}  // namespace spam
