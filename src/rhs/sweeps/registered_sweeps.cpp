// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/rhs/sweeps.hpp>

#include <fmt/format.h>

#include <map>

namespace spam {
namespace {

/// Made by the first call: objects of other files are constructed in no certain order.
template <int Dim>
auto& registry() {
    static std::map<std::pair<std::string, InstructionSet>, typename RegisterSweeps<Dim>::Make>
        sweeps;
    return sweeps;
}

}  // namespace

template <int Dim>
RegisterSweeps<Dim>::RegisterSweeps(const char* name, InstructionSet level, Make sweeps) {
    registry<Dim>().insert_or_assign({name, level}, sweeps);
}

template <int Dim>
Sweeps<Dim> registered_sweeps(const std::string& name) {
    const auto it = registry<Dim>().find({name, instruction_set()});
    if (it == registry<Dim>().end())
        throw InputError(fmt::format(
            "sweeps: no law '{}' in {} dimension{} for {}; a file of spam_add_sweeps() must hold a "
            "RegisterSweeps of this name",
            name, Dim, Dim == 1 ? "" : "s", to_string(instruction_set())));
    return it->second();
}

SPAM_COMPILED(template struct RegisterSweeps);
#define SPAM_INSTANTIATE(D) template Sweeps<D> registered_sweeps(const std::string&);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
