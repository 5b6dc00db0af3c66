// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvode_corrector.hpp"

#include <sunlinsol/sunlinsol_spgmr.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#include <sunnonlinsol/sunnonlinsol_newton.h>

#include <new>

namespace spam {

/// Directions of a linear solution. Strong friction needs few; what turns or sounds within a step needs more.
constexpr int most_directions = 20;

CvodeCorrector::CvodeCorrector(bool newton, const Vector& like, const SundialsContext& context)
    : krylov_(newton ? SUNLinSol_SPGMR(like.get(), SUN_PREC_NONE, most_directions, context.get())
                     : nullptr,
              &SUNLinSolFree),
      solver_(newton ? SUNNonlinSol_Newton(like.get(), context.get())
                     : SUNNonlinSol_FixedPoint(like.get(), 0, context.get()),
              &SUNNonlinSolFree) {
    if (solver_ == nullptr || (newton && krylov_ == nullptr)) throw std::bad_alloc();
}

}  // namespace spam
