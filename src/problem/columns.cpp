// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/diagnostics/pair_torques.hpp>
#include <spam/diagnostics/shape.hpp>
#include <spam/problem/observer.hpp>

#include <algorithm>
#include <memory>

namespace spam {
namespace {

/// The torques of the state seen last: ten columns ask for the same one.
struct TorquesOfRow {
    std::vector<double> y;
    TorqueDistribution pairs, particles;

    void follow(const Model<2>& model, std::span<const double> now) {
        if (std::equal(y.begin(), y.end(), now.begin(), now.end())) return;
        y.assign(now.begin(), now.end());
        const auto torques = pair_torques(dynamic_cast<const SmoothParticleModel<2>&>(model), now);
        pairs = distribution(torques.pair);
        particles = distribution(torques.particle);
    }
};

}  // namespace

std::vector<Column<2>> pair_torque_columns() {
    using Number = double (*)(const TorqueDistribution&);
    const std::vector<std::pair<const char*, Number>> numbers{
        {"negative", [](const auto& d) { return static_cast<double>(d.negative); }},
        {"positive", [](const auto& d) { return static_cast<double>(d.positive); }},
        {"negative_sum", [](const auto& d) { return d.negative_sum; }},
        {"positive_sum", [](const auto& d) { return d.positive_sum; }},
        {"factor", [](const auto& d) { return d.balance_factor(); }}};
    const auto row = std::make_shared<TorquesOfRow>();
    std::vector<Column<2>> columns;
    for (const bool of_pairs : {true, false})
        for (const auto& [name, number] : numbers)
            columns.push_back({std::string(of_pairs ? "pair" : "particle") + "_torques_" + name,
                               [row, of_pairs, number = number](const Model<2>& model,
                                                                std::span<const double> y) {
                                   row->follow(model, y);
                                   return number(of_pairs ? row->pairs : row->particles);
                               }});
    return columns;
}

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

#define SPAM_INSTANTIATE(D)                  \
    template Column<D> shape_error_column(); \
    template Column<D> closest_pair_column();
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
