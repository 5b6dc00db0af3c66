// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/vec.hpp>

#include <fmt/format.h>

#include <string>

namespace spam {

/// Fourier's law, [HH07] 1: Q = -kappa grad T. kappa >= 0, or heat would flow to the warmer side.
struct FourierConduction {
    double kappa;

    template <int Dim, class T>
    Vec<Dim, T> heat_flux(const Vec<Dim, T>& grad_T) const {
        return T(-kappa) * grad_T;
    }
    std::string describe() const {
        return fmt::format("Fourier conduction, kappa = {:.6g}", kappa);
    }
};

}  // namespace spam
