// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/diagnostics/shape.hpp>
#include <spam/problem/plan.hpp>

namespace spam {

template <int Dim>
Column<Dim> shape_error_column() {
    return {"shape_error", [](const Model<Dim>& model, std::span<const double> y) {
                const auto& particles = model.particles();
                return shape_error<Dim>(particles.reference_position,
                                        ConstState<Dim>(model.layout(), y).position(),
                                        particles.spacing);
            }};
}

template <int Dim>
Column<Dim> closest_pair_column() {
    return {"closest_pair", [](const Model<Dim>& model, std::span<const double> y) {
                return closest_pair<Dim>(ConstState<Dim>(model.layout(), y).position(),
                                         model.particles().spacing, model.box());
            }};
}

template Column<1> shape_error_column();
template Column<2> shape_error_column();
template Column<3> shape_error_column();
template Column<1> closest_pair_column();
template Column<2> closest_pair_column();
template Column<3> closest_pair_column();

}  // namespace spam
