// SPDX-License-Identifier: GPL-3.0-or-later
// Solutions that others are compared with, and how they are compared.
#pragma once

#include <spam/study/trial.hpp>

#include <array>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

namespace spam::work_precision {

inline constexpr auto fields = integrated_fields;

/// Root mean square and largest of every field of a difference, over the fields' scales; NaN for a
/// field that y does not carry.
struct FieldErrors {
    FieldErrors();
    std::array<double, fields.size()> rms, largest;
    double worst() const;  ///< root mean square
};

/// Scales: of positions the spacing, of other fields the larger of their root mean squares at the start
/// and in the reference.
template <int Dim>
FieldErrors compare(const Start<Dim>& start, std::span<const double> y,
                    std::span<const double> reference);

/// Solutions of a system as good as can be had, each computed when first asked for; several threads may
/// ask. Two by two, [0] and [1], [2] and [3], they are alike but for the method: what these differ by is
/// what is known of the first.
template <int Dim>
class Reference {
  public:
    Reference(const Trial<Dim>& trial, std::vector<IntegratorOptions> options)
        : trial_(trial),
          options_(std::move(options)),
          solutions_(options_.size()) {}

    std::size_t size() const { return options_.size(); }
    std::string name(std::size_t k) const;
    const TrialRun& solution(std::size_t k);

    struct Choice {
        std::size_t number;
        double floor;  ///< how much the pair differs: FieldErrors::worst()
    };
    /// The pair that differs least; nothing where a signal came before it was known. Throws GuardStop
    /// where no pair reaches the end.
    std::optional<Choice> choose(const Start<Dim>& start);

  private:
    struct Solution {
        std::mutex mutex;
        TrialRun run;
    };
    const Trial<Dim>& trial_;
    std::vector<IntegratorOptions> options_;
    std::deque<Solution> solutions_;
};

}  // namespace spam::work_precision
