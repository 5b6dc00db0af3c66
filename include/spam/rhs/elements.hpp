// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/material.hpp>
#include <spam/rhs/particle_model.hpp>

#include <algorithm>
#include <cstdint>

namespace spam {

namespace field_kind {
/// Q of an element that resists the hourglass elastically.
inline constexpr FieldKind hourglass_force{"hourglass_force", Rank::vector, Role::integrated,
                                           "m l/t^2"};
}  // namespace field_kind

/// What resists the motions of an element that leave the gradient at its centre zero, forces -gamma_n Q on its
/// corners (physics/quadrilateral.hpp). With c the longitudinal sound speed and q_dot = gamma_n v_n
///     Q = (viscosity/4) rho sqrt(A) c q_dot  +  Q_e,    Q_e_dot = (stiffness/4) rho c^2 q_dot + W Q_e,
/// W the spin. On square elements viscosity 1 is the critical damping of stiffness 1, and exact integration would
/// have the stiffness (lambda + 3 eta)/(3 (lambda + 2 eta)). Either may be 0.
struct HourglassControl {
    double viscosity = 0.0;
    double stiffness = 0.0;
};

/// Plane finite elements: quadrilaterals with one point of integration between particles, their nodes, whose
/// masses are lumped. An element holds stress and internal energy (by its mass M), and what its material
/// remembers, as fields of y (Holder::element, StateView::elements()):
///     m_i v_dot_i = -sum over elements and corners n of i  (A sigma . b_n + gamma_n Q)
///     sigma_dot as of a particle with the gradient at the centre,    M e_dot = A sigma : grad v + Q . q_dot.
/// The stress of a yielding law is a trial, as for particles. An element that its law calls broken is removed
/// for good: no stress, no force; its mass stays with the nodes, its energy with it. Keeps p exactly, L and E to
/// integrator error, also when elements break.
class Elements final : public Term<2> {
  public:
    struct Material {
        spam::Material<2> law;
        double density;  ///< mass per area at the start
        HourglassControl hourglass{};
    };

    /// `corners` by the numbers of particles in the model, as they lie in its reference configuration;
    /// `material`: place in the list of each, or empty where all are the first. Throws InputError for elements
    /// whose corners are not among the selection or not counterclockwise, for a law without a sound speed
    /// where hourglasses are resisted, for numbers that make no sense and in a box.
    Elements(const Selection<2>& nodes, std::vector<Quadrilateral> corners,
             std::vector<Material> materials, std::vector<std::int32_t> material = {});

    std::string rates(const Now& now) override;
    Answer answer(Ask what, std::span<const double> y) const override;
    bool settle(double t, const State<2>& state) override;
    Counts counts() const override { return {4 * nature_.elements.size(), 0}; }

    /// Density times area at the start.
    const std::vector<double>& mass() const { return mass_; }

  private:
    using Corners = std::array<Vec<2>, 4>;
    struct Held;
    template <class View>
    Corners corners_of(const View& nodes, std::size_t element) const;
    const Material& material_of(std::size_t element) const {
        return materials_[material_.empty() ? 0 : static_cast<std::size_t>(material_[element])];
    }
    /// f(material, first, count) for runs of elements of one material among first, ..., first + count - 1.
    template <class F>
    void for_each_material(std::size_t first, std::size_t count, const F& f) const;
    void load(const Held& held, std::size_t element);
    void gather(const Now& now) const;
    void set_nature();
    double neighbour_forces_in(std::span<const double> y) const;

    std::vector<Material> materials_;
    std::vector<std::int32_t> material_;  ///< of each element; empty: all of the first
    std::vector<double> mass_;            ///< of each element
    std::vector<double> viscosity_,
        stiffness_;                   ///< of each material, as factors of sqrt(A) q_dot and q_dot
    std::vector<std::size_t> start_;  ///< of each node, in `at_`
    std::vector<std::size_t> at_;     ///< 4 element + corner, ascending, of each node
    std::vector<Field>
        of_some_;  ///< what one material finds the rates of, and another may know nothing of
    double damping_ = 0.0;
    bool elastic_hourglass_ = false;

    // Of the right-hand side at work, M each.
    std::vector<double> returned_;  ///< stresses that count
    std::vector<Mat<2>> grad_v_;
    std::vector<std::uint32_t> number_;  ///< 0, 1, ...
    std::vector<Corners> force_;         ///< on the corners
    std::vector<unsigned char> inverted_;
};

/// How many elements of a model have broken.
std::size_t elements_broken(const Model<2>& model, std::span<const double> y);

}  // namespace spam
