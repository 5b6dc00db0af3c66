// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/integrate/methods.hpp>

#include <arkode/arkode_butcher.h>

#include <memory>
#include <type_traits>

namespace spam {

struct FreeTable {
    void operator()(ARKodeButcherTable table) const { ARKodeButcherTable_Free(table); }
};
using Table = std::unique_ptr<std::remove_pointer_t<ARKodeButcherTable>, FreeTable>;

/// The explicit tables of the SUNDIALS in use, as arkode:<name without ARKODE_>.
std::vector<IntegrationMethod> arkode_methods();

/// Precondition: `method` is the name of one of arkode_methods().
Table load_table(const std::string& method);

/// Whether ERKStep of the SUNDIALS in use runs the table right. Before 6.7 it takes every table with
/// c_s = 1 for first-same-as-last and skips its first stage: silently wrong unless the last row of A
/// is b. ARKStep runs them all.
bool erkstep_is_right(const ARKodeButcherTableMem& table);

}  // namespace spam
