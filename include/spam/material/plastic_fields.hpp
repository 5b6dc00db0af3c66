// SPDX-License-Identifier: GPL-3.0-or-later
// What solids that yield and break remember of every particle.
#pragma once

#include <spam/core/error.hpp>
#include <spam/core/field.hpp>
#include <spam/core/symmetric_eigen.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

namespace spam {

namespace field_kind {
inline constexpr FieldKind plastic_strain{"plastic_strain", Rank::scalar, Role::history, "1"};
/// The same where it has a rate.
inline constexpr FieldKind flowing_plastic_strain{"plastic_strain", Rank::scalar, Role::integrated,
                                                  "1"};
/// 1, or 0; what has broken cannot be one particle with what has not.
inline constexpr FieldKind broken{"broken", Rank::scalar,     Role::history, "1",
                                  100,      Quantity::scalar, Share::equal};
/// sigma_zz of plane strain.
inline constexpr FieldKind stress_zz{"stress_zz", Rank::scalar, Role::integrated, "m l^(2-D)/t^2"};
/// When the latest step ended.
inline constexpr FieldKind settled_at{"settled_at", Rank::scalar, Role::history, "t"};
/// Cp^-1, the plastic metric of the reference configuration, minus the unit tensor: nothing at the start.
inline constexpr FieldKind plastic_metric{"plastic_metric", Rank::symmetric, Role::history, "1"};
/// The same across the plane.
inline constexpr FieldKind plastic_metric_zz{"plastic_metric_zz", Rank::scalar, Role::history, "1"};
/// Spent on plastic flow, per volume of the reference configuration.
inline constexpr FieldKind plastic_work{"plastic_work", Rank::scalar, Role::history,
                                        "m l^(2-D)/t^2"};
// The same where they have rates.
inline constexpr FieldKind flowing_plastic_metric{"plastic_metric", Rank::symmetric,
                                                  Role::integrated, "1"};
inline constexpr FieldKind flowing_plastic_metric_zz{"plastic_metric_zz", Rank::scalar,
                                                     Role::integrated, "1"};
inline constexpr FieldKind flowing_plastic_work{"plastic_work", Rank::scalar, Role::integrated,
                                                "m l^(2-D)/t^2"};
}  // namespace field_kind

/// The part of the yield stress below it over which smooth flow sets in; throws InputError where it is none.
inline double valid_yield_width(double width) {
    if (!(width > 0.0) || !(width <= 1.0))
        throw InputError(fmt::format(
            "yield-width: {:g} must be above 0 and at most 1, the part of the yield stress over which "
            "flow sets in; 0.1 is usual",
            width));
    return width;
}

/// When a solid breaks, for good, after a step; never where nothing is set. What is broken has no deviator
/// and bears no tension.
struct Failure {
    static constexpr double never = std::numeric_limits<double>::infinity();
    double plastic_strain = never;
    double largest_stress = never;  ///< principal, tension positive
    double tension = never;         ///< mean stress

    bool possible() const {
        return plastic_strain < never || largest_stress < never || tension < never;
    }

    template <int Dim>
    bool reached(double strain, const SymTensor<Dim>& stress, double mean) const {
        if (strain > plastic_strain || mean > tension) return true;
        if (largest_stress == never) return false;
        const Vec<Dim> principal = symmetric_eigen(stress).value;
        return *std::max_element(principal.c.begin(), principal.c.end()) > largest_stress;
    }

    /// ", breaks at ..."
    std::string describe() const {
        std::string words;
        const auto add = [&](const char* what, double limit) {
            if (limit < never)
                words +=
                    fmt::format("{} {} {:.6g}", words.empty() ? ", breaks at" : " or", what, limit);
        };
        add("plastic strain", plastic_strain);
        add("stress", largest_stress);
        add("tension", tension);
        return words;
    }

    /// Throws InputError.
    void validate() const {
        const auto positive = [](const char* option, double limit) {
            if (!(limit > 0.0))
                throw InputError(
                    fmt::format("{}: {:g} must be above 0; leave it out for a solid that does not "
                                "break",
                                option, limit));
        };
        positive("failure-strain", plastic_strain);
        positive("failure-stress", largest_stress);
        positive("failure-tension", tension);
    }
};

}  // namespace spam
