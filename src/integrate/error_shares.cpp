// SPDX-License-Identifier: GPL-3.0-or-later
#include "error_shares.hpp"

#include <numeric>

namespace spam {

/// The block with the largest part in the norm; none where all errors are zero or one is not a number.
std::optional<std::size_t> ErrorShares::limiting() const {
    const Numbers& parts = norm_ == Norm::rms ? squares_ : largest_;
    const double total = std::accumulate(squares_.begin(), squares_.end(), 0.0);
    if (!(total > 0.0) || !std::isfinite(total)) return std::nullopt;
    return static_cast<std::size_t>(std::max_element(parts.begin(), parts.end()) - parts.begin());
}

void ErrorShares::count(Integrator::Statistics& statistics) const {
    statistics.limiting = limiting();
    if (!statistics.limiting) return;
    ++statistics.limited_by[*statistics.limiting];
    const double total = std::accumulate(squares_.begin(), squares_.end(), 0.0);
    for (std::size_t b = 0; b < squares_.size(); ++b)
        statistics.error_share[b] += squares_[b] / total;
}

std::string ErrorShares::in_words() const {
    const auto block = limiting();
    return block ? ", limited by the " + blocks_[*block].name : std::string{};
}

}  // namespace spam
