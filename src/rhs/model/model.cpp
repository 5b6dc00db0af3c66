// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/dimensions.hpp>
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/core/parts.hpp>
#include <spam/rhs/model.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace spam {
namespace {

// Where particles change, Repopulation says the bodies of the new ones.
constexpr FieldKind body_kind{"body", Rank::scalar, Role::derived, "1"};

}  // namespace

template <int Dim>
void Model<Dim>::fail(std::span<double> y_dot, std::string reason) {
    std::fill(y_dot.begin(), y_dot.end(), std::numeric_limits<double>::quiet_NaN());
    failure_ = std::move(reason);
}

template <int Dim>
void Model<Dim>::tangent(double t, std::span<const double> y, std::span<const double> v,
                         std::span<double> Jv) {
    double largest = 0.0;
    for (const auto& block : layout_.blocks())
        for (std::size_t k = block.offset; k < std::min(block.offset + block.size, v.size()); ++k)
            largest = std::max(largest, std::abs(v[k]) / block.scale);
    largest = Parts::here().most(largest);
    if (largest == 0.0) return std::fill(Jv.begin(), Jv.end(), 0.0);
    const auto squared = [](double x) { return x * x; };
    ExactSum squares;  // by the largest: none underflows
    for (const auto& block : layout_.blocks())
        for (std::size_t k = block.offset; k < std::min(block.offset + block.size, v.size()); ++k)
            squares += squared(v[k] / block.scale / largest);
    add_other_parts({&squares, 1});
    const double step = 3e-6 / (largest * std::sqrt(static_cast<double>(squares)));
    auto& [state, above, below] = beside_;
    state.assign(y.begin(), y.end());
    above.resize(y.size());
    below.resize(y.size());
    for (std::size_t k = 0; k < v.size(); ++k) state[k] = y[k] + step * v[k];
    rates(t, state, above);
    for (std::size_t k = 0; k < v.size(); ++k) state[k] = y[k] - step * v[k];
    rates(t, state, below);
    for (std::size_t k = 0; k < v.size(); ++k) Jv[k] = (above[k] - below[k]) / (2.0 * step);
}

template <int Dim>
std::vector<double> Model<Dim>::density(std::span<const double> y) const {
    const ConstState<Dim> state(layout_, y);
    if (!state.has(Field::density)) return {};
    const auto rho = state.density();
    return {rho.data(), rho.data() + rho.size()};
}

template <int Dim>
double Model<Dim>::neighbour_forces(std::span<const double> y) const {
    const ConstState<Dim> state(layout_, y);
    const auto& mass = particles_.mass;
    if (!state.has(Field::energy) && !state.has(Field::stress))
        return std::abs(internal_energy(y)) / particles_.spacing;
    const auto rho = state.has(Field::stress) ? density(y) : std::vector<double>{};
    const double sum = exact_sum(mass.size(), [&](std::size_t i) {
        const auto k = static_cast<Eigen::Index>(i);
        return (state.has(Field::energy) ? mass[i] * std::abs(state.energy()(0, k)) : 0.0) +
               (rho.empty() ? 0.0 : mass[i] / rho[i] * state.stress().col(k).norm());
    });
    return sum / particles_.spacing;
}

template <int Dim>
Promises Model<Dim>::in_box(Promises promises) const {
    if (box_.periodic() || box_.has_images()) promises.angular_momentum = Promise::not_kept;
    return promises;
}

template <int Dim>
bool Model<Dim>::settles() const {
    return std::any_of(layout_.blocks().begin(), layout_.blocks().end(),
                       [](const auto& block) { return block.field.role() == Role::history; });
}

template <int Dim>
void Model<Dim>::remember(Memory<Dim>& memory) {
    memory.among(0, particles_.size());
    memory.run(Field::work, gains_.work);
    memory.run(Field::impulse, gains_.impulse);
    memory.run(Field::angular_impulse, gains_.angular_impulse);
    auto body = particles_.body;
    memory.particles(body_kind, body);
    if (!memory.reading() || memory.carries()) return;
    const auto most = static_cast<std::int32_t>(Parts::here().most(
        std::max(particles_.bodies(), static_cast<std::int32_t>(memory.among_all()))));
    if (body.size() != particles_.size() ||
        std::any_of(body.begin(), body.end(), [most](auto b) { return b < 0 || b >= most; }))
        throw InputError("the bodies that were remembered are not those of these particles");
    set_bodies(std::move(body));
}

template <int Dim>
std::string Model<Dim>::inseparable() const {
    for (const auto& block : layout_.blocks())
        if (block.field.role() == Role::integrated && block.field != Field::position &&
            block.field != Field::velocity)
            return fmt::format("{} in y changes with the velocity", block.field.name());
    return {};
}

/// Length, speed and density are the units; where forces are meant, stress in place of density speed^2.
template <int Dim>
void Model<Dim>::set_scales(const TypicalValues& typical) {
    for (const auto& block : layout_.blocks()) {
        const Dimensions d = dimensions_of(block.field.unit(), Dim);
        const bool force = d.mass == 1 && d.time == -2;
        layout_.set_scale(block.field,
                          whole_power(typical.length, d.length + d.time + Dim * d.mass) *
                              (force ? typical.stress
                                     : whole_power(typical.density, d.mass) *
                                           whole_power(typical.speed, -d.time)));
    }
    const double sound = std::sqrt(typical.stress / typical.density);
    time_scale_ = typical.length / std::max(typical.speed, sound);
}

template <int Dim>
void Model<Dim>::take_scales(const Model& other) {
    for (const auto& block : other.layout_.blocks()) layout_.set_scale(block.field, block.scale);
    time_scale_ = other.time_scale_;
}

SPAM_COMPILED(template class Model);

}  // namespace spam
