// SPDX-License-Identifier: GPL-3.0-or-later
#include "arkode_control.hpp"

#include <spam/integrate/methods.hpp>

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_erkstep.h>
#include <fmt/format.h>
#include <sundials/sundials_config.h>
#if SUNDIALS_VERSION_MAJOR >= 7
#include <sunadaptcontroller/sunadaptcontroller_imexgus.h>
#include <sunadaptcontroller/sunadaptcontroller_soderlind.h>
#endif

#include <algorithm>

namespace spam {
namespace {

/// Number in arkode_controllers().
std::size_t number_of(const std::string& name) {
    const auto& names = arkode_controllers();
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? 0 : static_cast<std::size_t>(found - names.begin());
}

}  // namespace

std::string rejected_too_often(double h, double min_step, const std::string& limited) {
    return fmt::format(
        "the error test failed again and again, the step fell to {:.3g} (least allowed {:.3g}){}",
        h, min_step, limited);
}

const std::vector<std::string>& arkode_controllers() {
    static const std::vector<std::string> names{
        "pid", "pi", "i", "explicit_gustafsson", "implicit_gustafsson", "imex_gustafsson"};
    return names;
}

#if SUNDIALS_VERSION_MAJOR >= 7
int set_arkode_controller(void* memory, const std::string& name, SUNContext context,
                          KeptController& kept) {
    using Make = SUNAdaptController (*)(SUNContext);
    static constexpr Make make[] = {SUNAdaptController_PID,    SUNAdaptController_PI,
                                    SUNAdaptController_I,      SUNAdaptController_ExpGus,
                                    SUNAdaptController_ImpGus, SUNAdaptController_ImExGus};
    SUNAdaptController controller = make[number_of(name)](context);
    if (controller == nullptr) return ARK_MEM_FAIL;
    kept.reset(controller, [](SUNAdaptController old) { SUNAdaptController_Destroy(old); });
    return ARKodeSetAdaptController(memory, controller);
}
#else
namespace {
constexpr int kinds[] = {ARK_ADAPT_PID,     ARK_ADAPT_PI,      ARK_ADAPT_I,
                         ARK_ADAPT_EXP_GUS, ARK_ADAPT_IMP_GUS, ARK_ADAPT_IMEX_GUS};
}
int set_erkstep_controller(void* memory, const std::string& name, SUNContext, KeptController&) {
    return ERKStepSetAdaptivityMethod(memory, kinds[number_of(name)], 1, 0, nullptr);
}
int set_arkstep_controller(void* memory, const std::string& name, SUNContext, KeptController&) {
    return ARKStepSetAdaptivityMethod(memory, kinds[number_of(name)], 1, 0, nullptr);
}
#endif

}  // namespace spam
