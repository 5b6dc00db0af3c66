// SPDX-License-Identifier: GPL-3.0-or-later
#include "../smooth_particles/fluids.hpp"
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/parts.hpp>
#include <spam/material/plastic_fields.hpp>
#include <spam/physics/quadrilateral.hpp>
#include <spam/rhs/elements.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace spam {
namespace {

void check_fluid_of_elements(const Fluid& fluid) {
    check_fluid(fluid, 2);
    if (fluid.conduction)
        throw InputError(
            "elements: heat would pass from one to the next, and temperatures have no gradient in one; "
            "leave the conductivity out, or use smooth particles");
    if (fluid.by_pairs && fluid.viscosity)
        throw InputError(
            "elements: they have no pairs; take friction by gradients, or use smooth particles");
}

void validate(const Elements::Material& material) {
    const auto refuse = [](const char* what, double value, const char* allowed) {
        throw InputError(fmt::format("elements: {} {:g} {}", what, value, allowed));
    };
    const HourglassControl& control = material.hourglass;
    if (!(material.density > 0.0) || !std::isfinite(material.density))
        refuse("density", material.density, "must be above 0");
    if (!(control.viscosity >= 0.0) || !std::isfinite(control.viscosity))
        refuse("hourglass viscosity", control.viscosity, "must not be below 0");
    if (!(control.stiffness >= 0.0) || !std::isfinite(control.stiffness))
        refuse("hourglass stiffness", control.stiffness, "must not be below 0");
    if (const Fluid* const fluid = material.fluid()) check_fluid_of_elements(*fluid);
    if (!(material.temperature >= 0.0) || !std::isfinite(material.temperature))
        refuse("temperature", material.temperature, "must not be below 0");
    if (control.viscosity + control.stiffness > 0.0 && !(material.sound_speed() > 0.0))
        throw InputError(
            "elements: a law without a sound speed cannot say how strong an hourglass should be "
            "resisted; give it one (a gas its temperature at the start), or leave the control out");
}

}  // namespace

Elements::Elements(const Selection<2>& nodes, std::vector<Quadrilateral> corners,
                   std::vector<Material> materials, std::vector<std::int32_t> material)
    : Term<2>(nodes),
      materials_(std::move(materials)),
      material_(std::move(material)) {
    nature_.elements = std::move(corners);
    if (nature_.elements.empty()) throw InputError("elements: there are none; leave the term out");
    if (box().has_images())
        throw InputError(
            "elements: they do not meet images behind a wall; guide the nodes along it (Clamp)");
    for (const Material& one : materials_) {
        validate(one);
        const double c = one.sound_speed().value_or(0.0);
        viscosity_.push_back(0.25 * one.hourglass.viscosity * one.density * c);
        stiffness_.push_back(0.25 * one.hourglass.stiffness * one.density * c * c);
        elastic_hourglass_ = elastic_hourglass_ || one.hourglass.stiffness > 0.0;
    }
    std::size_t n = nature_.elements.size();
    if (!material_.empty() && material_.size() != n)
        throw InputError(fmt::format("elements: {} numbers of materials are given for {} elements",
                                     material_.size(), n));
    for (std::size_t k = 0; k < n; ++k) {
        const auto number = material_.empty() ? 0 : material_[k];
        if (number < 0 || static_cast<std::size_t>(number) >= materials_.size())
            throw InputError(fmt::format("elements: element {} has the material {} of {}", k,
                                         number, materials_.size()));
        for (const std::uint32_t i : nature_.elements[k])
            if (Parts::here().alone() &&
                (i < among().first() || i >= among().first() + among().count()))
                throw InputError(fmt::format(
                    "elements: element {} has a corner {}, which is none of the particles "
                    "that the term acts among",
                    k, i));
    }
    divide();
    n = nature_.elements.size();
    const double* const X = particles().reference_position.data();
    const std::vector<double> others = other_nodes(X, X);
    for (std::size_t k = 0; k < n; ++k) {
        const auto number = material_.empty() ? 0 : material_[k];
        const Corners x = corners_of(X, others.data(), 0, k);
        const double area = QuadrilateralShape<>(x).area;
        if (!(area > 0.0))
            throw InputError(fmt::format(
                "elements: the corners of element {} do not go round it counterclockwise",
                number_of(k)));
        mass_.push_back(area * materials_[static_cast<std::size_t>(number)].density);
        damping_ = std::max(damping_, 16.0 * viscosity_[static_cast<std::size_t>(number)] *
                                          std::sqrt(area) / mass_.back());
        for (std::size_t c = 1; c < 4; ++c)
            for (int a = 0; a < 2; ++a)
                if (box().periodic(a) && std::abs(x[c][a] - x[0][a]) > 0.499 * box().length(a))
                    throw InputError(fmt::format(
                        "elements: element {} reaches half round the periodic box; lay at least 3 across it",
                        number_of(k)));
        for (const Vec<2>& diagonal : {x[2] - x[0], x[3] - x[1]})
            nature_.reach = std::max(nature_.reach, std::sqrt(dot(diagonal, diagonal)));
    }
    damping_ = Parts::here().most(damping_);
    nature_.reach = Parts::here().most(nature_.reach);
    set_nature();
    const bool fluids =
        std::ranges::any_of(materials_, [](const Material& m) { return m.fluid(); });
    if (materials_.size() > 1)
        for (const Field field : nature_.element_fields)
            if (fluids || (field != Field::stress && field != Field::energy))
                of_some_.push_back(field);
    if (fluids)
        for (auto* const all : {&density_, &energy_, &pressure_}) all->resize(n);
    returned_.resize(3 * n);
    grad_v_.resize(n);
    number_.resize(n);
    std::iota(number_.begin(), number_.end(), 0U);
    inverted_.resize(n);
}

void Elements::set_nature() {
    auto& fields = nature_.element_fields;
    const auto add = [&fields](Field field, bool wanted) {
        if (wanted && std::ranges::find(fields, field) == fields.end()) fields.push_back(field);
    };
    const auto any = [this](const auto& holds) { return std::ranges::any_of(materials_, holds); };
    add(Field::stress, any([](const Material& one) { return one.solid(); }));
    add(Field::energy, any([](const Material& one) { return !one.cold(); }));
    add(field_kind::hourglass_force, elastic_hourglass_);
    for (const Material& one : materials_) {
        add(field_kind::hourglass_work,
            one.cold() && one.hourglass.viscosity + one.hourglass.stiffness > 0.0);
        add(field_kind::friction_work, one.cold() && one.fluid()->viscosity);
        if (const auto* const law = one.solid())
            for (const Field field : law->history()) add(field, true);
    }
    nature_.fluid_corners = any([](const Material& one) { return one.fluid(); });
    nature_.no_rezoning =
        "an element has four corners, which cannot be split or merged; use smooth particles";
    nature_.no_images = "elements do not meet the images of their nodes; use rigid sides";
    nature_.smooth =
        !any([](const Material& one) { return one.solid() && one.solid()->returns(); });
    std::string words = fmt::format("{} one-point elements", nature_.elements.size());
    for (const Material& one : materials_) {
        words += fmt::format(", {} of density {:.6g}",
                             std::visit([](const auto& law) { return law.describe(); }, one.law),
                             one.density);
        if (one.hourglass.viscosity > 0.0)
            words += fmt::format(", hourglass viscosity {:g}", one.hourglass.viscosity);
        if (one.hourglass.stiffness > 0.0)
            words += fmt::format(", hourglass stiffness {:g}", one.hourglass.stiffness);
    }
    nature_.description = words;
}

/// Of the right-hand side at work: nodes, and where fields of the elements begin (null for those not there).
struct Elements::Held {
    const Nodes& nodes;
    const double *broken, *Q;
    double *e_dot, *Q_dot, *resisted, *rubbed;
    Held(const Now& now, const Nodes& of)
        : nodes(of),
          broken(now.state.elements().find(field_kind::broken)),
          Q(now.state.elements().find(field_kind::hourglass_force)),
          e_dot(now.rate.elements().find(Field::energy)),
          Q_dot(now.rate.elements().find(field_kind::hourglass_force)),
          resisted(now.rate.elements().find(field_kind::hourglass_work)),
          rubbed(now.rate.elements().find(field_kind::friction_work)) {}
};

/// Gradient, forces and the rate of the energy of one element.
void Elements::load(const Held& held, std::size_t element) {
    inverted_[element] = 0;
    if (held.broken != nullptr && held.broken[element] != 0.0) {
        grad_v_[element] = {};
        force_[element] = {};
        held.e_dot[element] = 0.0;
        if (elastic_hourglass_) held.Q_dot[2 * element] = held.Q_dot[2 * element + 1] = 0.0;
        return;
    }
    const QuadrilateralShape<> shape(corners_of(held.nodes, places, element));
    const Corners v = corners_of(held.nodes, velocities, element);
    inverted_[element] = shape.area > 0.0 ? 0 : 1;
    grad_v_[element] = shape.gradient(v);
    SymTensor<2> stress;
    for (std::size_t c = 0; c < 3; ++c) stress.c[c] = returned_[3 * element + c];
    const auto m = static_cast<std::size_t>(material_.empty() ? 0 : material_[element]);
    const Fluid* const fluid = materials_[m].fluid();
    if (fluid && fluid->viscosity) {
        const SymTensor<2> friction = fluid->viscosity->viscous_stress(grad_v_[element]);
        if (fluid->state.cold)
            held.rubbed[element] =
                shape.area * (grad_v_[element] * friction).trace() / mass_[element];
        stress = stress + friction;
    }
    const Vec<2> q_dot = shape.hourglass(v);
    Vec<2> Q = viscosity_[m] * std::sqrt(std::max(shape.area, 0.0)) * q_dot;
    if (elastic_hourglass_) {
        const Vec<2> Q_e{{held.Q[2 * element], held.Q[2 * element + 1]}};
        const Mat<2>& grad = grad_v_[element];
        const double omega = 0.5 * (grad(0, 1) - grad(1, 0));
        held.Q_dot[2 * element] = stiffness_[m] * q_dot[0] - omega * Q_e[1];
        held.Q_dot[2 * element + 1] = stiffness_[m] * q_dot[1] + omega * Q_e[0];
        Q += Q_e;
    }
    force_[element] = shape.forces(stress, Q);
    if (materials_[m].cold()) {
        if (held.resisted) held.resisted[element] = dot(Q, q_dot) / mass_[element];
        return;
    }
    double power = 0.0;
    for (std::size_t c = 0; c < 4; ++c) power += dot(force_[element][c], v[c]);
    held.e_dot[element] = -power / mass_[element];
}

/// Each node sums what its elements do to it, in their order.
void Elements::gather(const Now& now) const {
    parallel_for(particles().size(), [&](std::size_t i) {
        Vec<2> force;
        for (std::size_t k = start_[i]; k < start_[i + 1]; ++k)
            force += force_[at_[k] / 4][at_[k] % 4];
        for (std::size_t a = 0; a < 2; ++a) now.v_dot[2 * i + a] = force.c[a] / particles().mass[i];
    });
}

std::string Elements::rates(const Now& now) {
    const ConstState<2> state = now.state.elements();
    const State<2> rate = now.rate.elements();
    const Nodes nodes = nodes_of(now.state);
    const Held held(now, nodes);
    for (const Field field : of_some_) rate.field(field).setZero();
    parallel_blocks(nature_.elements.size(), [&](std::size_t begin, std::size_t size) {
        for_each_material(material_, begin, size,
                          [&](std::size_t number, std::size_t first, std::size_t count) {
                              const Material& m = materials_[number];
                              const auto* const law = m.solid();
                              if (law)
                                  law->return_stress(now.t, first, count, state, returned_.data());
                              else
                                  find_pressures(nodes, m.fluid()->state, first, count);
                              for (std::size_t k = first; k < first + count; ++k) load(held, k);
                              if (law)
                                  law->stress_rates({number_.data() + first, count},
                                                    {grad_v_.data() + first, count},
                                                    returned_.data(), state, rate);
                          });
    });
    const auto inverted = std::ranges::find(inverted_, 1);
    if (inverted != inverted_.end())
        return fmt::format("element {} is turned inside out",
                           number_of(static_cast<std::size_t>(inverted - inverted_.begin())));
    if (auto reason = complaint(); !reason.empty()) return reason;
    meet_other_forces();
    gather(now);
    return {};
}

Elements::Answer Elements::answer(Ask what, std::span<const double> y) const {
    if (what == Ask::damping && y.empty()) return {damping_};  // of what is at rest
    const Nodes nodes = nodes_of(state_of(y));
    if (what == Ask::damping) return {damping_ + friction_damping(nodes)};
    if (what == Ask::neighbour_forces) return {neighbour_forces_in(y)};
    if (what != Ask::energy) return {};
    return {exact_sum(mass_.size(), [&](std::size_t k) { return mass_[k] * energy_of(nodes, k); })};
}

double Elements::neighbour_forces_in(std::span<const double> y) const {
    const Nodes nodes = nodes_of(state_of(y));
    const Fields all = fields(y);
    const double sum = exact_sum(mass_.size(), [&](std::size_t k) {
        const double area = QuadrilateralShape<>(corners_of(nodes, places, k)).area;
        return std::abs(area) * Eigen::Map<const Eigen::Vector3d>(all.stress[k].c.data()).norm() +
               mass_[k] * std::abs(all.energy[k]);
    });
    return sum / particles().spacing;
}

std::size_t elements_broken(const Model<2>& model, std::span<const double> y) {
    const ConstState<2> elements = ConstState<2>(model.layout(), y).elements();
    const double* const broken = elements.find(field_kind::broken);
    if (broken == nullptr) return 0;
    return static_cast<std::size_t>(std::count_if(broken, broken + model.quadrilaterals().size(),
                                                  [](double b) { return b != 0.0; }));
}

bool Elements::settle(double t, const State<2>& nodes) {
    const State<2> state = nodes.elements();
    bool changed = false;
    for_each_material(material_, 0, nature_.elements.size(),
                      [&](std::size_t number, std::size_t first, std::size_t count) {
                          if (const auto* const law = materials_[number].solid())
                              changed = law->settle(t, first, count, state) || changed;
                      });
    const double* const broken = state.find(field_kind::broken);
    if (broken == nullptr) return changed;
    for (std::size_t k = 0; k < nature_.elements.size(); ++k) {
        if (broken[k] == 0.0) continue;
        state.stress().col(static_cast<Eigen::Index>(k)).setZero();
        if (elastic_hourglass_)
            state.field(field_kind::hourglass_force).col(static_cast<Eigen::Index>(k)).setZero();
    }
    return changed;
}

}  // namespace spam
