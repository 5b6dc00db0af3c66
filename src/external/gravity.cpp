// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/external/gravity.hpp>

#include <fmt/format.h>

namespace spam {

template <int Dim>
Gravity<Dim>::Gravity(const Point<Dim>& g) : g_(g) {
    if (!g.allFinite()) throw InputError("gravity: must be a finite acceleration");
}

template <int Dim>
std::string Gravity<Dim>::describe() const {
    std::string components;
    for (int a = 0; a < Dim; ++a) components += fmt::format("{}{:g}", a > 0 ? ", " : "", g_[a]);
    return fmt::format("gravity ({})", components);
}

SPAM_COMPILED(template class Gravity);

}  // namespace spam
