// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/particles.hpp>
#include <spam/kernel/general_weight.hpp>
#include <spam/neighbors/box.hpp>

namespace spam {

/// Of the reference configuration, in the mean over particles.
struct RestingBody {
    double density;  ///< sum_j m_j w_ij, self included
    double slope;    ///< sum_j m_j |w'|/r, of the others
};

template <int Dim>
RestingBody resting_body(const Particles<Dim>& particles, const Box<Dim>& box,
                         const GeneralWeight<Dim>& weight);

}  // namespace spam
