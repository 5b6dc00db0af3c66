// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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
            constexpr std::size_t lanes = 8;  // sums side by side, or each waits for the one before
            std::array<double, lanes> squares{}, largest{};
            const std::size_t first = blocks_[b].first, last = first + blocks_[b].size;
            const auto add = [&](std::size_t lane, double s) {
                squares[lane] += s * s;
                const double magnitude = std::abs(s);
                largest[lane] = magnitude > largest[lane] ? magnitude : largest[lane];
            };
            std::size_t k = first;
            for (; k + lanes <= last; k += lanes)
                for (std::size_t lane = 0; lane < lanes; ++lane) add(lane, scaled(k + lane));
            for (; k < last; ++k) add(0, scaled(k));
            for (std::size_t lane = 0; lane < lanes; ++lane) {
                squares_[place(b)] += squares[lane];
                largest_[place(b)] = std::max(largest_[place(b)], largest[lane]);
            }
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
