// SPDX-License-Identifier: GPL-3.0-or-later
// What phase_separation and cavitating_drop have in common: particles that move by the free energy of van der Waals'
// fluid at one temperature.
#pragma once

#include "common.hpp"
#include <spam/analysis/coexistence.hpp>
#include <spam/material/van_der_waals_isotherm.hpp>
#include <spam/rhs/density_potentials.hpp>

namespace spam {

/// With k = 1 and particles of mass 1 they make the critical density and temperature 1.
constexpr double van_der_waals_a = 9.0 / 8.0, van_der_waals_b = 1.0 / 3.0;
/// Liquid is denser, vapour less dense.
constexpr double critical_density = 1.0;

inline UnitNames van_der_waals_units() {
    return reduced_units(
        "the mass of a particle, the critical density and the energy k T of the critical "
        "temperature");
}

/// As options give it.
struct VanDerWaalsMatter {
    double temperature, range;
    Kernel kernel = Kernel::w4;

    /// --temperature, --kernel and --range.
    void add_options(Options& options) {
        options.number("temperature", temperature, "temperature, by the critical one",
                       between(0.01, 100.0));
        options.choice<Kernel>("kernel", kernel, all_kernels(), "weight function");
        options.number("range", range, "distance at which the weight function vanishes",
                       positive());
    }
    void refuse_one_phase() const {
        if (!(temperature < 1.0))
            refuse(
                "temperature: at {:g} liquid and vapour are one, and nothing parts; give less than "
                "the critical temperature, 1",
                temperature);
    }
    VanDerWaalsIsotherm law() const { return {van_der_waals_a, van_der_waals_b, temperature}; }
    DensityPotentials potentials() const {
        DensityPotentials all;
        all.state = law();
        all.kernel = kernel;
        all.range = range;
        return all;
    }
    AnyWeight<2> weight() const { return weight_function<2>(to_string(kernel), range); }
};

/// What several seeds gave.
struct OfSeeds {
    double mean, deviation;  ///< deviation: of one seed

    explicit OfSeeds(const std::vector<double>& values) {
        const Eigen::Map<const Eigen::ArrayXd> all(values.data(),
                                                   static_cast<Eigen::Index>(values.size()));
        mean = all.mean();
        deviation = std::sqrt((all - mean).square().sum() /
                              std::max(1.0, static_cast<double>(values.size()) - 1.0));
    }
};

}  // namespace spam
