// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/field_layout.hpp>
#include <spam/integrate/methods.hpp>
#include <spam/problem/integrator_settings.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace spam {
namespace {

constexpr auto fields = integrated_fields;

std::string tolerance_of(Field field) { return fmt::format("atol-{}", field.name()); }

/// Options that choose adaptive steps and have values; a flag counts where it is set.
const std::vector<std::string>& adaptive_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> result{"rtol", "atol"};
        for (const Field field : fields) result.push_back(tolerance_of(field));
        result.insert(result.end(),
                      {"controller", "safety", "min-step", "max-step", "initial-step"});
        return result;
    }();
    return names;
}

std::vector<std::string> with(std::string name, const std::vector<std::string>& more) {
    std::vector<std::string> result{std::move(name)};
    result.insert(result.end(), more.begin(), more.end());
    return result;
}

}  // namespace

const std::vector<std::string>& IntegratorSettings::names() {
    static const std::vector<std::string> names =
        with("integrator", with("dt", with("max-steps", with("relaxation", adaptive_names()))));
    return names;
}

void IntegratorSettings::add_to(Options& options) {
    options.group("Integrator");
    options.text("integrator", method_,
                 "method: rk4, leapfrog, arkode:<SUNDIALS table>, cvode:adams, cvode:bdf or "
                 "gsl:<stepper>; "
                 "steps are adaptive where the method allows it, and fixed with --dt");
    options.number(
        "dt", dt_,
        fmt::format("fixed time step (default of rk4: {})",
                    default_words_.empty() ? fmt::format("{}", default_dt_) : default_words_),
        positive());
    options.number("rtol", rtol_, "relative tolerance of adaptive steps (default 1e-8)",
                   positive());
    options.number(
        "atol", atol_,
        "absolute tolerance of adaptive steps, in units of each field's scale (default 1e-10)",
        positive());
    for (std::size_t k = 0; k < fields.size(); ++k)
        options.number(
            tolerance_of(fields[k]), field_atol_[k],
            fmt::format("absolute tolerance of the {}, instead of --atol times its scale",
                        fields[k].name()),
            positive());
    options.text("controller", controller_,
                 fmt::format("step-size controller of ARKODE: {} (default pid)",
                             fmt::join(arkode_controllers(), ", ")));
    options.number("safety", safety_,
                   "safety factor of ARKODE's step-size controller (default 0.96)", positive());
    options.number(
        "min-step", min_step_,
        "smallest adaptive step; the run stops where it would need a smaller one (default: 1e-12 of "
        "the time in which the fastest particle or sound passes a spacing)",
        positive());
    options.number("max-step", max_step_, "largest adaptive step", positive());
    options.number("initial-step", initial_step_, "first adaptive step", positive());
    options.flag("relaxation", relaxation_,
                 "rescale every adaptive step of ARKODE so that the energy is conserved to "
                 "round-off (SUNDIALS 6.6 or later)");
    options.integer("max-steps", max_steps_,
                    "largest number of steps; a run that needs more is stopped",
                    between(1, 2'000'000'000));
}

/// No option may silently do nothing.
void IntegratorSettings::refuse_idle(const Options& options, const std::string& method) const {
    const IntegrationMethod& known = integration_method(method);
    if (dt_ && !known.fixed) return;  // validate() says why
    const std::string tolerance = options.first_given(adaptive_names());
    if (!known.adaptive && !tolerance.empty())
        throw InputError(
            fmt::format("{}: {} has a fixed step and no tolerance; use --dt, or --integrator "
                        "arkode:DORMAND_PRINCE_7_4_5",
                        tolerance, method));
    if (dt_ && !tolerance.empty())
        throw InputError(
            fmt::format("{}: --dt asks for fixed steps, --{} for adaptive ones; leave one out",
                        tolerance, tolerance));
    const std::string control = options.first_given({"controller", "safety"});
    if (!control.empty() && !method.starts_with("arkode:"))
        throw InputError(
            fmt::format("{}: {} has its own step-size control, the option is for arkode:<table> "
                        "only; leave it out",
                        control, method));
}

void IntegratorSettings::fill(IntegratorOptions& integrator) {
    integrator.dt = dt_;
    if (rtol_) integrator.rtol = *rtol_;
    if (atol_) integrator.atol = *atol_;
    for (std::size_t k = 0; k < fields.size(); ++k)
        if (const auto& atol = field_atol_[k])
            integrator.field_atol.push_back({std::string(fields[k].name()), *atol});
    integrator.controller = controller_;
    integrator.safety = safety_;
    integrator.min_step = min_step_;
    integrator.relaxation = relaxation_;
    integrator.max_step = max_step_;
    integrator.initial_step = initial_step_;
    if (max_steps_) integrator.max_steps = static_cast<std::size_t>(*max_steps_);
}

bool IntegratorSettings::prefer_step(double dt, const Options& options) {
    if (method_ != "rk4" || options.given("dt")) return false;
    dt_ = dt;
    return true;
}

bool IntegratorSettings::prefer_leapfrog(double dt, const Options& options) {
    if (options.given("integrator")) return false;
    method_ = "leapfrog";
    if (!options.given("dt")) dt_ = dt;
    return true;
}

void refuse_endless(const IntegratorOptions& integrator, double t_end) {
    for (const auto& [option, step] :
         {std::pair{"dt", integrator.dt}, std::pair{"max-step", integrator.max_step}})
        if (step && !(t_end / *step <= most_steps))
            throw InputError(fmt::format(
                "{0}: {1} would take {2:.0e} steps to t = {3:g}, of {4:.0e} at most; give an "
                "earlier end, or a larger --{0} where the motion allows it",
                option, *step, t_end / *step, t_end, most_steps));
}

IntegratorOptions IntegratorSettings::resolve(Options& options) {
    const auto adaptive = with("relaxation", adaptive_names());
    options.command_line_wins({"integrator"}, with("dt", adaptive));
    options.command_line_wins({"dt"}, adaptive);
    options.command_line_wins(adaptive, {"dt"});
    IntegratorOptions integrator;
    integrator.method = method_;
    refuse_idle(options, method_);
    if (method_ == "rk4" && !dt_) dt_ = default_dt_;
    fill(integrator);
    integrator.validate();
    if (integrator.adaptive()) {  // for case.toml
        rtol_ = integrator.rtol;
        atol_ = integrator.atol;
    }
    return integrator;
}

}  // namespace spam
