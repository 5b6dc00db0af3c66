// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/nvector.hpp>

#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_nonlinearsolver.h>

#include <memory>
#include <type_traits>

namespace spam {

/// How CVODE solves the equation of a step. Adams: fixed-point iteration. BDF: Newton's method, its linear equations
/// by SPGMR without a matrix, J v by differences of the rates to one side. Accounts, which no rate depends on, have no
/// say in where either ends; they come out as exactly as the rest, because the same directions serve them.
class CvodeCorrector {
  public:
    CvodeCorrector(bool newton, const Vector& like, const SundialsContext& context);
    CvodeCorrector(const CvodeCorrector&) = delete;
    CvodeCorrector& operator=(const CvodeCorrector&) = delete;

    SUNNonlinearSolver get() const { return solver_.get(); }
    SUNLinearSolver krylov() const { return krylov_.get(); }  ///< null: needs none

  private:
    std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, decltype(&SUNLinSolFree)> krylov_;
    std::unique_ptr<std::remove_pointer_t<SUNNonlinearSolver>, decltype(&SUNNonlinSolFree)> solver_;
};

}  // namespace spam
