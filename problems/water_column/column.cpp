// SPDX-License-Identifier: GPL-3.0-or-later
#include "column.hpp"

#include <spam/external/friction.hpp>
#include <spam/external/gravity.hpp>
#include <spam/material/cavitation.hpp>

namespace water_column {
namespace {

/// The wall on the right can be taken away.
Box<2> room(const Parameters& p, const FluidColumn& column, bool right_wall) {
    auto box = p.sides->box<2>(Point<2>::Zero(), Point<2>(column.width, column.rows));
    if (!right_wall) box.set_wall(0, true, {});
    return box;
}

DensityPotentials potentials_of(const Parameters& p) {
    DensityPotentials potentials;
    potentials.state = law_of(p);
    potentials.surface_tension = p.surface_tension;
    if (p.core > 0.0) potentials.core = {p.core, p.core_range};
    potentials.kernel = p.kernel;
    potentials.range = p.range;
    return potentials;
}

std::shared_ptr<ParticleModel<2>> model_of(const Parameters& p, const FluidColumn& column,
                                           const Particles<2>& particles, bool right_wall) {
    auto model = std::make_shared<DensityPotentialModel<2>>(particles, potentials_of(p),
                                                            room(p, column, right_wall));
    model->add(std::make_unique<Gravity<2>>(Point<2>(0.0, -column.g)));
    if (right_wall)
        model->add(std::make_unique<Friction<2>>(column.damping, FrictionOf::all_motion));
    model->layout().set_scale(Field::velocity, 0.1);
    return model;
}

}  // namespace

AnyEquationOfState law_of(const Parameters& p) {
    const EmbeddedAtom water{1.0, 1.0};
    if (p.cavitation) return CavitatingEmbeddedAtom(water, *p.cavitation);
    return water;
}

std::vector<double> pressures_of(const Parameters& p, const Model<2>& model,
                                 std::span<const double> y) {
    auto all = fluid_elements(model, y).density;
    if (all.empty()) all = model.density(y);
    const auto law = law_of(p);
    for (auto& rho : all) rho = law.pressure(rho, 0.0);
    return all;
}

FluidColumn scaled_column(const Parameters& p, int refinement) {
    FluidColumn column{};
    column.width = refinement * p.width;
    column.rows = std::max(1, static_cast<int>(std::lround(p.aspect * column.width)));
    column.g = p.gravity / column.rows;
    column.unit = column.width * std::sqrt(figure_gravity / p.gravity);
    // Waves along the column take a time in proportion to its width: friction and length follow.
    column.damping = p.damping ? *p.damping / refinement : 0.1 * figure_width / column.width;
    column.relaxation_time =
        p.relaxation_time ? *p.relaxation_time * refinement : 12.5 * column.width;
    return column;
}

FluidColumn make_column(const Parameters& p, int refinement, int sample, bool only_described) {
    FluidColumn column = scaled_column(p, refinement);
    column.sample = sample;
    const double apart = 0.01 * ((sample + 1) / 2);
    column.relaxation_time *= sample % 2 == 1 ? 1.0 - apart : 1.0 + apart;
    const auto particles =
        one_body(make_particles<2>(cell_centres<2>({column.width, column.rows}), 1.0));
    column.between_walls = model_of(p, column, particles, true);
    column.released = model_of(p, column, particles, false);
    if (!only_described) {
        column.y0 = initial_state<2>(*column.between_walls, 1.0, 1.0, at_rest<2>());
        column.between_walls->layout().set_scale(Field::velocity, 0.1);
    }
    return column;
}

double hydrostatic_density(double g, double depth) {
    return (2.0 + std::sqrt(1.0 + 6.0 * g * std::max(depth, 0.0))) / 3.0;
}

/// The floor carries the mass: P(rho) = rho^3 - rho^2 = g mass, by Newton's method, which converges from
/// above. Then the depth at which that density is.
double hydrostatic_depth(double g, double mass) {
    double rho = 1.0 + g * mass;
    for (int k = 0; k < 60; ++k)
        rho -= (rho * rho * (rho - 1.0) - g * mass) / (rho * (3.0 * rho - 2.0));
    return (1.5 * rho * rho - 2.0 * rho + 0.5) / g;
}

std::vector<Slab> slabs_of(const FluidColumn& column, std::span<const double> y) {
    if (column.of_elements()) return rows_of(column, y);
    const ConstState<2> state(column.between_walls->layout(), y);
    const auto x = state.position();
    const auto rho = column.between_walls->density(y);
    const double thickness = std::max(1.5, column.width / 8.0);
    const auto count =
        static_cast<std::size_t>(std::max(1.0, std::ceil(x.row(1).maxCoeff() / thickness)));
    std::vector<Slab> slabs(count, {0.0, 0.0});
    std::vector<double> number(count, 0.0);
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const double at =
            std::clamp(std::floor(x(1, i) / thickness), 0.0, static_cast<double>(count - 1));
        const auto k = static_cast<std::size_t>(at);
        slabs[k].y += x(1, i);
        slabs[k].density += rho[static_cast<std::size_t>(i)];
        number[k] += 1.0;
    }
    for (std::size_t k = 0; k < count; ++k) {
        slabs[k].y /= std::max(number[k], 1.0);
        slabs[k].density /= std::max(number[k], 1.0);
    }
    std::erase_if(slabs, [](const Slab& slab) { return slab.density == 0.0; });
    return slabs;
}

double profile_error(const FluidColumn& column, std::span<const double> y, double range) {
    const double surface = hydrostatic_depth(column.g, column.rows);
    double largest = 0.0;
    for (const Slab& slab : slabs_of(column, y)) {
        if (slab.y > surface - range) continue;
        const double expected = hydrostatic_density(column.g, surface - slab.y);
        largest = std::max(largest, std::abs(slab.density / expected - 1.0));
    }
    return largest;
}

double mass_error(const FluidColumn& column, std::span<const double> y, double range) {
    const ConstState<2> state(column.between_walls->layout(), y);
    const double surface = hydrostatic_depth(column.g, column.rows);
    const double rho = hydrostatic_density(column.g, range);
    const double above = rho * rho * (rho - 1.0) / column.g;  // what that pressure carries
    const auto below = (state.position().row(1).array() < surface - range).count();
    return static_cast<double>(below) / column.width / (column.rows - above) - 1.0;
}

std::vector<Column<2>> motion_columns(double range) {
    const auto position = [](const Model<2>& model, std::span<const double> y) {
        return ConstState<2>(model.layout(), y).position();
    };
    return {{"front",
             [position](const Model<2>& model, std::span<const double> y) {
                 return position(model, y).row(0).maxCoeff();
             }},
            {"leading_percent",
             [position](const Model<2>& model, std::span<const double> y) {
                 const auto all = position(model, y);
                 std::vector<double> x(all.row(0).begin(), all.row(0).end());
                 const auto last = x.begin() + static_cast<std::ptrdiff_t>(x.size() / 100);
                 std::nth_element(x.begin(), last, x.end(), std::greater<>());
                 return *last;
             }},
            {"height",
             [position, range](const Model<2>& model, std::span<const double> y) {
                 const auto x = position(model, y);
                 double top = 0.0;
                 for (Eigen::Index i = 0; i < x.cols(); ++i)
                     if (x(0, i) < range) top = std::max(top, x(1, i));
                 return top;
             }},
            closest_pair_column<2>()};
}

std::vector<Column<2>> compared_columns(const Parameters& p) {
    return {{"centre_height",
             [](const Model<2>& model, std::span<const double> y) {
                 const auto& mass = model.particles().mass;
                 const Eigen::Map<const Eigen::RowVectorXd> m(
                     mass.data(), static_cast<Eigen::Index>(mass.size()));
                 return m.dot(ConstState<2>(model.layout(), y).position().row(1)) / m.sum();
             }},
            {"tension", [p](const Model<2>& model, std::span<const double> y) {
                 const auto all = pressures_of(p, model, y);
                 return static_cast<double>(std::count_if(all.begin(), all.end(),
                                                          [](double P) { return P < 0.0; })) /
                        static_cast<double>(all.size());
             }}};
}

const std::vector<Measured>& martin_and_moyce() {
    static const std::vector<Measured> points{
        {0.849, 1.245}, {1.602, 1.884}, {2.283, 2.689}, {2.950, 3.728}, {3.905, 4.999}};
    return points;
}

double scaled_time(const FluidColumn& column, double T) {
    return T / std::sqrt(2.0 * column.g * column.width);
}

bool is_martin_and_moyce(const FluidColumn& column) { return column.rows == 2 * column.width; }

}  // namespace water_column
