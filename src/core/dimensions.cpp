// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/dimensions.hpp>

#include <cstdlib>
#include <string>

namespace spam {
namespace {

/// "2", "D", "(2-D)"; 1 where there is none.
int power_of(std::string_view text, int dim) {
    if (text.empty()) return 1;
    if (text == "D") return dim;
    if (text.front() != '(') return std::atoi(std::string(text).c_str());
    return std::atoi(std::string(text.substr(1)).c_str()) - dim;
}

}  // namespace

Dimensions dimensions_of(std::string_view unit, int dim) {
    Dimensions d;
    for (int sign = 1; !unit.empty();) {
        if (unit.front() == '/') sign = -1;
        const char factor = unit.front();
        unit.remove_prefix(1);
        int* const power = factor == 'm'   ? &d.mass
                           : factor == 'l' ? &d.length
                           : factor == 't' ? &d.time
                                           : nullptr;
        if (power == nullptr) continue;  // "1", a blank, '/'
        std::string_view exponent;
        if (unit.starts_with('^')) exponent = unit.substr(1, unit.find_first_of(" /") - 1);
        *power += sign * power_of(exponent, dim);
        unit.remove_prefix(exponent.empty() ? 0 : exponent.size() + 1);
    }
    return d;
}

double whole_power(double x, int power) {
    double product = 1.0;
    for (int n = std::abs(power); n > 0; --n) product *= x;
    return power < 0 ? 1.0 / product : product;
}

}  // namespace spam
