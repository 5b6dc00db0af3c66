// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/kernel/any_weight.hpp>
#include <spam/kernel/lucy.hpp>
#include <spam/kernel/monaghan_cubic.hpp>
#include <spam/kernel/wn.hpp>

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace spam {
namespace {

constexpr int least_power = 2, greatest_power = 8;  // of the family w_n

template <int Dim, int... K>
AnyWeight<Dim> member_of_family(int n, double range, std::integer_sequence<int, K...>) {
    AnyWeight<Dim> weight = Wn<Dim, least_power>(range);
    ((n == least_power + K ? void(weight = Wn<Dim, least_power + K>(range)) : void()), ...);
    return weight;
}

}  // namespace

template <int Dim>
AnyWeight<Dim> weight_function(std::string_view name, double range) {
    if (!(range > 0.0) || !std::isfinite(range))
        throw InputError(
            fmt::format("range: {:g} is no range of a weight function; it must be above 0", range));
    if (name == "lucy") return Lucy<Dim>(range);
    if (name == "monaghan") return MonaghanCubic<Dim>(range);
    if (name.size() == 2 && name[0] == 'w' && name[1] >= '0' + least_power &&
        name[1] <= '0' + greatest_power)
        return member_of_family<Dim>(
            name[1] - '0', range,
            std::make_integer_sequence<int, greatest_power - least_power + 1>{});
    throw InputError(fmt::format(
        "kernel: '{}' is no weight function; choose lucy, monaghan or one of w{} to w{}", name,
        least_power, greatest_power));
}

#define SPAM_INSTANTIATE(D) template AnyWeight<D> weight_function<D>(std::string_view, double);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
