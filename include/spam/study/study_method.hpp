// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/integrate/integrator.hpp>
#include <spam/integrate/methods.hpp>
#include <spam/io/options.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace spam {

/// A method as studies of integrators see it.
struct StudyMethod : IntegrationMethod {
    /// For pictures: "Dormand-Prince (5)", "gsl rk8pd (8)".
    std::string title() const;
    /// For names in result.json: "dormand_prince_7_4_5", "gsl_rk8pd".
    std::string word() const;
    IntegratorOptions with_step(double dt) const;
    /// Relative and absolute tolerance (times each field's scale) alike.
    IntegratorOptions with_tolerance(double tolerance) const;
};

/// The methods of a comma-separated list, each once; an empty list means `standard`. Throws InputError
/// (option `methods`) for one that does not exist.
std::vector<StudyMethod> study_methods(std::string_view list,
                                       const std::vector<std::string>& standard);

/// Of every kind and order one that is worth a curve: where a study's --methods is not given.
std::vector<std::string> methods_of_every_kind();

/// Adds --problem: one of `names`, or "all".
void add_system_option(Options& options, std::vector<std::string> names, std::string& chosen);

}  // namespace spam
