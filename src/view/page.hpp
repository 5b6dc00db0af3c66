// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "payload.hpp"

#include <string>
#include <string_view>

namespace spam::view {

/// A file of src/view/page or src/view/vendor, as it was when the program was built.
/// Throws std::out_of_range.
std::string_view embedded(std::string_view name);

/// The page: one HTML file that asks for no other. Its policy (Content-Security-Policy) forbids it.
std::string make_page(const Payload& payload);

/// Bytes of a page without numbers.
std::size_t bytes_of_program();

}  // namespace spam::view
