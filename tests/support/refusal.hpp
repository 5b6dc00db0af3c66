// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/error.hpp>
#include <spam/integrate/integrator.hpp>

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

/// What a user is told of options that cannot be; nothing where they can.
inline std::string why_refused(const IntegratorOptions& options) {
    try {
        options.validate();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

}  // namespace spam::test
