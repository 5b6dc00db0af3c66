// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/exact_sum.hpp>
#include <spam/integrate/integrator.hpp>

#include <algorithm>
#include <cmath>

namespace spam {

/// How much each block of y contributes to the error of an adaptive step, as the method estimates and
/// weighs it: the block that keeps steps short. One pass over y and no allocation a step.
class ErrorShares {
  public:
    /// What the method holds below 1: the root mean square over all entries (SUNDIALS), or the largest
    /// entry (GSL).
    enum class Norm { rms, largest };

    ErrorShares(const std::vector<Ode::Block>& blocks, Norm norm) : blocks_(blocks), norm_(norm) {}

    /// scaled(k): error of entry k over what is allowed to it.
    template <class Scaled>
    void measure(const Scaled& scaled) {
        squares_ = {};
        largest_ = {};
        for (std::size_t b = 0; b < blocks_.size(); ++b) {
            const std::size_t first = blocks_[b].first, size = blocks_[b].size;
            squares_[place(b)] += exact_sum(size, [&](std::size_t k) {
                const double s = scaled(first + k);
                return s * s;
            });
            if (norm_ == Norm::rms) continue;
            for (std::size_t k = first; k < first + size; ++k)
                largest_[place(b)] = std::max(largest_[place(b)], std::abs(scaled(k)));
        }
    }

    /// Adds the step measured, which was accepted, to the statistics.
    void count(Integrator::Statistics& statistics) const;

    /// ", limited by the velocity" for the step measured; nothing where nothing is known.
    std::string in_words() const;

  private:
    using Numbers = std::array<double, Integrator::Statistics::most_blocks>;
    static std::size_t place(std::size_t b) { return std::min(b, Numbers().size() - 1); }
    std::optional<std::size_t> limiting() const;

    const std::vector<Ode::Block>& blocks_;
    Norm norm_;
    Numbers squares_{}, largest_{};
};

}  // namespace spam
