// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "problem/result_files.hpp"

#include <boost/test/unit_test.hpp>

#include <map>

namespace spam::test {

using Words = std::vector<std::string>;

Outcome run_in(const Scratch& folder, const std::string& name, Words arguments);

/// Results by name of a call that must succeed; and what it claims.
struct Results {
    std::map<std::string, double> value;
    std::size_t claims = 0;

    Results(const std::string& name, const Words& arguments, const char* column);
};

}  // namespace spam::test
