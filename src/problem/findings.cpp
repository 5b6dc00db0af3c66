// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/problem/findings.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {

void Findings::measure_orders(const std::vector<std::string>& labels,
                              const std::vector<double>& error, const std::string& source,
                              const std::string& name) const {
    for (std::size_t k = 1; k < error.size(); ++k)
        measure(fmt::format("{}_{}_to_{}", name, labels[k - 1], labels[k]),
                std::log2(error[k - 1] / error[k]), source);
}

}  // namespace spam
