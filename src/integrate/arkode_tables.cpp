// SPDX-License-Identifier: GPL-3.0-or-later
#include "arkode_tables.hpp"

#include <arkode/arkode_butcher_erk.h>
#include <sundials/sundials_config.h>

#include <new>

namespace spam {
namespace {

constexpr int version = 100 * SUNDIALS_VERSION_MAJOR + SUNDIALS_VERSION_MINOR;
const std::string sundials_prefix = "ARKODE_";

std::vector<std::string> table_names() {
#if SUNDIALS_VERSION_MAJOR > 7 || (SUNDIALS_VERSION_MAJOR == 7 && SUNDIALS_VERSION_MINOR >= 1)
    std::vector<std::string> names;
    for (int id = ARKODE_MIN_ERK_NUM; id <= ARKODE_MAX_ERK_NUM; ++id)
        names.emplace_back(ARKodeButcherTable_ERKIDToName(static_cast<ARKODE_ERKTableID>(id)));
    return names;
#else  // numbers have no names there; these are in every version since 6.4
    return {"ARKODE_HEUN_EULER_2_1_2",     "ARKODE_BOGACKI_SHAMPINE_4_2_3",
            "ARKODE_ARK324L2SA_ERK_4_2_3", "ARKODE_ZONNEVELD_5_3_4",
            "ARKODE_ARK436L2SA_ERK_6_3_4", "ARKODE_SAYFY_ABURUB_6_3_4",
            "ARKODE_CASH_KARP_6_4_5",      "ARKODE_FEHLBERG_6_4_5",
            "ARKODE_DORMAND_PRINCE_7_4_5", "ARKODE_ARK548L2SA_ERK_8_4_5",
            "ARKODE_VERNER_8_5_6",         "ARKODE_FEHLBERG_13_7_8",
            "ARKODE_KNOTH_WOLKE_3_3",      "ARKODE_ARK437L2SA_ERK_7_3_4",
            "ARKODE_ARK548L2SAb_ERK_8_4_5"};
#endif
}

Table load(const std::string& name) {
    Table table(ARKodeButcherTable_LoadERKByName(name.c_str()));
    if (!table) throw std::bad_alloc();  // the name is known
    return table;
}

}  // namespace

std::vector<IntegrationMethod> arkode_methods() {
    std::vector<IntegrationMethod> methods;
    for (const std::string& name : table_names()) {
        const Table table = load(name);
        methods.push_back(
            {"arkode:" + name.substr(sundials_prefix.size()), table->q, table->d != nullptr, true});
    }
    return methods;
}

Table load_table(const std::string& method) {
    return load(sundials_prefix + method.substr(method.find(':') + 1));
}

bool erkstep_is_right(const ARKodeButcherTableMem& table) {
    const int last = table.stages - 1;
    if (version >= 607 || table.c[last] != 1.0) return true;
    for (int j = 0; j < table.stages; ++j)
        if (table.A[last][j] != table.b[j]) return false;
    return true;
}

}  // namespace spam
