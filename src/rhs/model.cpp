// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/rhs/model.hpp>

#include <algorithm>
#include <limits>

namespace spam {

template <int Dim>
void Model<Dim>::fail(std::span<double> y_dot, std::string reason) {
    std::fill(y_dot.begin(), y_dot.end(), std::numeric_limits<double>::quiet_NaN());
    failure_ = std::move(reason);
}

template class Model<1>;
template class Model<2>;
template class Model<3>;

}  // namespace spam
