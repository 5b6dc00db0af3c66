// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/error.hpp>

#include <string>

namespace spam::test {

/// What a user is told of something that cannot be made; "accepted" where it can.
template <class Make>
std::string refusal(const Make& make) {
    try {
        make();
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

}  // namespace spam::test
