// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace spam {

/// Neumaier's compensated sum, taken in particle order by one thread: invariants are compared to
/// 1e-15, so their own summation error must be smaller, and must not depend on the thread count.
class CompensatedSum {
  public:
    CompensatedSum& operator+=(double x) {
        const double t = sum_ + x;
        correction_ += std::abs(sum_) >= std::abs(x) ? (sum_ - t) + x : (x - t) + sum_;
        sum_ = t;
        return *this;
    }
    operator double() const { return sum_ + correction_; }

  private:
    double sum_ = 0.0;
    double correction_ = 0.0;
};

}  // namespace spam
