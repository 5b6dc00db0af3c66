// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/fluid.hpp>
#include <spam/material/material.hpp>
#include <spam/rhs/particle_model.hpp>

#include <algorithm>
#include <cstdint>
#include <variant>

namespace spam {

namespace field_kind {
/// Q of an element that resists the hourglass elastically.
inline constexpr FieldKind hourglass_force{"hourglass_force", Rank::vector, Role::integrated,
                                           "m l/t^2"};
/// What an element of a cold fluid has taken from the motion, by mass: against the hourglass, and by friction.
inline constexpr FieldKind hourglass_work{"hourglass_work", Rank::scalar, Role::integrated,
                                          "l^2/t^2"};
inline constexpr FieldKind friction_work{"friction_work", Rank::scalar, Role::integrated,
                                         "l^2/t^2"};
}  // namespace field_kind

/// What resists the motions of an element that leave the gradient at its centre zero, forces -gamma_n Q on its
/// corners (physics/quadrilateral.hpp). With c the longitudinal sound speed and q_dot = gamma_n v_n
///     Q = (viscosity/4) rho sqrt(A) c q_dot  +  Q_e,    Q_e_dot = (stiffness/4) rho c^2 q_dot + W Q_e,
/// W the spin; rho and c are those of the start. On square elements viscosity 1 is the critical damping of stiffness 1,
/// and exact integration would have the stiffness (lambda + 3 eta)/(3 (lambda + 2 eta)). Either may be 0.
struct HourglassControl {
    double viscosity = 0.0;
    double stiffness = 0.0;
};

/// Plane finite elements: quadrilaterals with one point of integration between particles, their nodes, whose
/// masses are lumped,
///     m_i v_dot_i = -sum over elements and corners n of i  (A sigma . b_n + gamma_n Q).
///
/// One of a solid holds stress and internal energy (by its mass M), and what its material remembers, as fields of y
/// (Holder::element, StateView::elements()):
///     sigma_dot as of a particle with the gradient at the centre,    M e_dot = A sigma : grad v + Q . q_dot.
/// The stress of a yielding law is a trial, as for particles. An element that its law calls broken is removed
/// for good: no stress, no force; its mass stays with the nodes, its energy with it.
///
/// One of a fluid has the density of its corners, and the stress of now in place of one in y:
///     rho = M/A,    sigma = -P(rho, e) 1 + friction of the gradient at the centre,
/// with e_dot as of a solid. A cold law has its energy M e(M/A) from the corners as well, and its forces
/// P dA/dx_n are the exact gradient of it: y then holds nothing for the element but the work of friction and
/// against the hourglass, where there is any, which internal energies count.
///
/// Keeps p exactly, L and E to integrator error, also when elements break.
class Elements final : public Term<2> {
  public:
    struct Material {
        std::variant<spam::Material<2>, Fluid> law;
        double density;  ///< mass per area at the start
        HourglassControl hourglass{};
        double temperature = 0.0;  ///< at the start, of a fluid that has one

        /// Null where it is a fluid.
        const spam::Material<2>* solid() const { return std::get_if<spam::Material<2>>(&law); }
        /// Null where it is a solid.
        const Fluid* fluid() const { return std::get_if<Fluid>(&law); }
        /// A fluid whose energy is a function of the density.
        bool cold() const { return fluid() != nullptr && fluid()->state.cold; }
        /// At the start; none where the law has none.
        std::optional<double> sound_speed() const;
    };

    /// `corners` by the numbers of particles in the model (in a part of a run: in the whole, all of them), as they lie
    /// in its reference configuration;
    /// `material`: place in the list of each, or empty where all are the first. Throws InputError for elements
    /// whose corners are not among the selection or not counterclockwise, for a law without a sound speed
    /// where hourglasses are resisted, for a fluid that conducts heat or has friction by pairs, for numbers that make
    /// no sense, beside walls with images, and for an element that reaches half round a periodic box.
    Elements(const Selection<2>& nodes, std::vector<Quadrilateral> corners,
             std::vector<Material> materials, std::vector<std::int32_t> material = {});

    std::string rates(const Now& now) override;
    Answer answer(Ask what, std::span<const double> y) const override;
    bool settle(double t, const State<2>& state) override;
    Counts counts() const override { return {4 * nature_.elements.size(), 0}; }

    /// Density times area at the start.
    const std::vector<double>& mass() const { return mass_; }

    /// Gives elements of fluids with a temperature, at the densities of the corners in y, the energy of the
    /// temperature of their material, or of this one.
    void warm(std::span<double> y, std::optional<double> temperature = {}) const;

    /// What all elements have in a state, whether y holds it or not: a number for each.
    struct Fields {
        std::vector<double> density, energy;  ///< mass per area; internal energy by mass
        std::vector<SymTensor<2>> stress;
    };
    Fields fields(std::span<const double> y) const;
    /// Whether some elements are of a fluid.
    bool has_fluid() const { return !density_.empty(); }

  private:
    using Corners = std::array<Vec<2>, 4>;
    struct Held;
    /// Where nodes are and how they move; behind ours the corners in other parts, x, v of each.
    struct Nodes {
        ConstState<2> state;
        std::array<const double*, 2> own;  ///< x, v
        std::vector<double> others{};
    };
    Nodes nodes_of(const ConstState<2>& state) const;
    std::vector<double> other_nodes(const double* x, const double* v) const;
    enum Which { places, velocities };
    Corners corners_of(const Nodes& nodes, Which which, std::size_t element) const {
        return corners_of(nodes.own[which], nodes.others.data(), 2 * which, element);
    }
    /// `shift`: of what is asked for among the four numbers of a corner in another part.
    Corners corners_of(const double* own, const double* others, std::size_t shift,
                       std::size_t element) const {
        const std::size_t count = among().count();
        Corners corners;
        for (std::size_t c = 0; c < 4; ++c) {
            const std::size_t i = nature_.elements[element][c] - among().first();
            const double* const at = i < count ? own + 2 * i : others + 4 * (i - count) + shift;
            corners[c] = {{at[0], at[1]}};
        }
        if (shift == 0 && box().periodic())  // an element may lie across a border
            for (std::size_t c = 1; c < 4; ++c) corners[c] = beside(corners[0], corners[c]);
        return corners;
    }
    /// The image of x that is nearest to `from`.
    Vec<2> beside(const Vec<2>& from, const Vec<2>& x) const {
        const Point<2> r = box().nearest({x[0] - from[0], x[1] - from[1]});
        return {{from[0] + r[0], from[1] + r[1]}};
    }
    void divide();
    void meet_other_forces();
    /// In the whole run.
    std::size_t number_of(std::size_t element) const;
    const Material& material_of(std::size_t element) const {
        return materials_[material_.empty() ? 0 : static_cast<std::size_t>(material_[element])];
    }
    void load(const Held& held, std::size_t element);
    void find_pressures(const Nodes& nodes, const AnyEquationOfState& law, std::size_t first,
                        std::size_t count);
    std::string complaint() const;
    void gather(const Now& now) const;
    void set_nature();
    double energy_of(const Nodes& nodes, std::size_t element) const;
    double friction_damping(const Nodes& nodes) const;
    double neighbour_forces_in(std::span<const double> y) const;

    std::vector<Material> materials_;
    std::vector<std::int32_t> material_;  ///< of each element; empty: all of the first
    std::vector<double> mass_;            ///< of each element
    std::vector<double> viscosity_,
        stiffness_;                   ///< of each material, as factors of sqrt(A) q_dot and q_dot
    std::vector<std::size_t> start_;  ///< of each node, in `at_`
    std::vector<std::size_t>
        at_;  ///< 4 element + corner, of each node; those in other parts among them in their order
    /// By part: our nodes that its elements have, and those of its that ours have, behind our own; where in force_ the
    /// forces on its nodes are, and those of its elements on ours.
    std::vector<std::vector<std::uint32_t>> give_, take_, push_, pulled_;
    std::size_t others_ = 0;  ///< corners in other parts
    std::vector<Field>
        of_some_;  ///< what one material finds the rates of, and another may know nothing of
    double damping_ = 0.0;
    bool elastic_hourglass_ = false;

    // Of the right-hand side at work, M each.
    std::vector<double> returned_;  ///< stresses that count
    std::vector<Mat<2>> grad_v_;
    std::vector<std::uint32_t> number_;  ///< 0, 1, ...
    std::vector<Corners> force_;         ///< on the corners, then those of elements of other parts
    std::vector<unsigned char> inverted_;
    std::vector<double> density_, energy_, pressure_;  ///< of fluids; empty where there is none
};

/// How many elements of a model have broken.
std::size_t elements_broken(const Model<2>& model, std::span<const double> y);

/// Elements::fields() of a model with elements of a fluid; empty for any other.
Elements::Fields fluid_elements(const Model<2>& model, std::span<const double> y);

/// What the elements of cold fluids of a model have taken from the motion against the hourglass.
double hourglass_work(const Model<2>& model, std::span<const double> y);

}  // namespace spam
