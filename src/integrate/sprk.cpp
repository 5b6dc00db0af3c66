// SPDX-License-Identifier: GPL-3.0-or-later
#include "sprk.hpp"

#include "separable.hpp"
#include <spam/core/error.hpp>

#include <sundials/sundials_config.h>

#if 100 * SUNDIALS_VERSION_MAJOR + SUNDIALS_VERSION_MINOR >= 606
#include <arkode/arkode_sprk.h>
#define SPAM_SPRK
#endif

#include <memory>
#include <utility>

namespace spam {

#ifdef SPAM_SPRK
namespace {

struct FreeSprkTable {
    void operator()(ARKodeSPRKTable table) const { ARKodeSPRKTable_Free(table); }
};
using SprkTable = std::unique_ptr<std::remove_pointer_t<ARKodeSPRKTable>, FreeSprkTable>;

SprkTable load(const std::string& name) {
    return SprkTable(ARKodeSPRKTable_LoadByName(("ARKODE_SPRK_" + name).c_str()));
}

}  // namespace
#endif

std::vector<IntegrationMethod> sprk_methods() {
    std::vector<IntegrationMethod> methods;
#ifdef SPAM_SPRK
    for (const char* name :
         {"EULER_1_1", "LEAPFROG_2_2", "PSEUDO_LEAPFROG_2_2", "RUTH_3_3", "MCLACHLAN_2_2",
          "MCLACHLAN_3_3", "CANDY_ROZMUS_4_4", "MCLACHLAN_4_4", "MCLACHLAN_5_6", "YOSHIDA_6_8",
          "SUZUKI_UMENO_8_16", "SOFRONIOU_10_36"})
        if (const SprkTable table = load(name))
            methods.push_back({std::string("sprk:") + name, table->q, false, true, true});
#endif
    return methods;
}

Sprk::Sprk(const IntegratorOptions& options, const Ode& ode, Vector& y, double t0)
    : FixedSteps(ode, y, t0, options.dt.value_or(1.0)),
      at_(separable_blocks(ode, options.method)),
      rates_(y.clone()) {
#ifdef SPAM_SPRK
    const SprkTable table = load(options.method.substr(options.method.find(':') + 1));
    if (!table) throw std::bad_alloc();  // the name is known
    for (int i = 0; i < table->stages; ++i) stages_.push_back({table->ahat[i], table->a[i]});
#endif
}

void Sprk::advance(double h) {
    N_VScale(1.0, y_.get(), z_.get());
    const auto x = z_.span().subspan(at_.position, at_.size);
    const auto v = z_.span().subspan(at_.velocity, at_.size);
    const auto account = z_.span().subspan(at_.account, at_.accounts);
    double drifted = 0.0;
    for (const auto& [kick, drift] : stages_) {
        if (kick != 0.0) {
            rates(t_ + drifted * h, z_, rates_);
            advance_block(v, kick * h, rates_.span().subspan(at_.velocity, at_.size), v);
            advance_block(account, kick * h, rates_.span().subspan(at_.account, at_.accounts),
                          account);
        }
        if (drift != 0.0) advance_block(x, drift * h, v, x);
        drifted += drift;
    }
}

}  // namespace spam
