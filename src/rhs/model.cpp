// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/rhs/model.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace spam {

template <int Dim>
void Model<Dim>::fail(std::span<double> y_dot, std::string reason) {
    std::fill(y_dot.begin(), y_dot.end(), std::numeric_limits<double>::quiet_NaN());
    failure_ = std::move(reason);
}

template <int Dim>
std::vector<double> Model<Dim>::density(std::span<const double> y) const {
    const ConstState<Dim> state(layout_, y);
    if (!state.has(Field::density)) return {};
    const auto rho = state.density();
    return {rho.data(), rho.data() + rho.size()};
}

template <int Dim>
void Model<Dim>::remember(Archive& archive) {
    archive(particles_.body);
    if (archive.reading()) set_bodies(particles_.body);
}

template <int Dim>
std::string Model<Dim>::inseparable() const {
    for (const auto& block : layout_.blocks())
        if (block.field != Field::position && block.field != Field::velocity)
            return fmt::format("{} in y changes with the velocity", field_name(block.field));
    return {};
}

template class Model<1>;
template class Model<2>;
template class Model<3>;

}  // namespace spam
