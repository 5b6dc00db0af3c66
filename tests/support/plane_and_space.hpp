// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tuple>
#include <type_traits>

namespace spam::test {

/// Of BOOST_AUTO_TEST_CASE_TEMPLATE: cases that are the same in both, with the number of dimensions as value.
using PlaneAndSpace = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

}  // namespace spam::test
