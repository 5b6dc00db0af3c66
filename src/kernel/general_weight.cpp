// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/kernel/general_weight.hpp>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace spam {

template <int Dim>
GeneralWeight<Dim>::GeneralWeight(Kernel kernel, double range)
    : continuous_derivatives(2),
      h_(range),
      inverse_h_(std::nextafter(1.0 / range, 2.0 / range)) {  // rounded up: u >= 1 at r = h
    if (!(range > 0.0) || !std::isfinite(range))
        throw InputError(
            fmt::format("range: {:g} is no range of a weight function; it must be above 0", range));
    switch (kernel) {
        case Kernel::monaghan:
            set_monaghan();
            break;
        case Kernel::lucy:
            set_family(3);
            break;
        default:
            set_family(2 + static_cast<int>(kernel) - static_cast<int>(Kernel::w2));
    }
}

/// With 1 + nu = n + 1 - np and 1 - nu = 1 - n + np.
template <int Dim>
void GeneralWeight<Dim>::set_family(int n) {
    using std::numbers::pi;
    const double h = h_;
    const double C = Dim == 1   ? (n + 2) / (4.0 * h)
                     : Dim == 2 ? (n + 2) * (n + 3) / (6.0 * pi * h * h)
                                : (n + 2) * (n + 3) * (n + 4) / (32.0 * pi * h * h * h);
    const double K = C * n * (n + 1) / (h * h);
    const auto k = static_cast<std::size_t>(n);
    continuous_derivatives = n - 1;
    value_[k - 2] = (n + 1) * C;
    value_[k - 1] = -n * C;
    slope_[k - 2] = K;
    second_[k - 2] = (n - 1) * K;
    second_[k - 1] = -n * K;
    if (n < 3) return;
    third_[k - 3] = (n - 1) * (2 - n) * K / h;  // (n-1) (K/h) (2 - nu)
    third_[k - 2] = (n - 1) * n * K / h;
}

template <int Dim>
void GeneralWeight<Dim>::set_monaghan() {
    using std::numbers::pi;
    const double h = h_;
    const double A = Dim == 1   ? 4.0 / (3.0 * h)
                     : Dim == 2 ? 40.0 / (7.0 * pi * h * h)
                                : 8.0 / (pi * h * h * h);
    value_[1] = 2.0 * A;
    spline_value_ = 8.0 * A;
    spline_slope_ = 6.0 * A / (h * h);
    second_[1] = 12.0 * A / (h * h);
    spline_second_ = 48.0 * A / (h * h);
}

SPAM_COMPILED(template class GeneralWeight);

}  // namespace spam
