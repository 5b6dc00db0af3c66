// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/parts.hpp>
#include <spam/rhs/selection.hpp>

#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace spam {

template <int Dim>
class Neighbourhood;

/// One law by which the particles of a model, or a selection of them, act on each other: stress, a pair
/// potential, springs. A model is a list of terms (particle_model.hpp); what they give adds up. Terms are called once a
/// right-hand side, never per pair; what they do with pairs is a sweep (run_sweep.hpp).
template <int Dim>
class Term {
  public:
    /// What a term reads, and what it finds. N and the states are those of its selection.
    struct Now {
        double t;
        ConstState<Dim> state;
        State<Dim> rate;
        double* v_dot;  ///< Dim x N, the term's own: set it whole
    };

    /// `among`: a model, or some of its particles.
    explicit Term(const Selection<Dim>& among) : among_(among) {}
    virtual ~Term() = default;
    Term(const Term&) = delete;
    Term& operator=(const Term&) = delete;

    /// v_dot, and the rates of nature().fields. Pure, no allocation after warm-up except for new lists.
    /// Returns why the state has no meaning; empty where it has one.
    virtual std::string rates(const Now& now) = 0;

    /// What observers may ask for; a law may know it or not.
    enum class Ask {
        energy,   ///< that is not kinetic
        density,  ///< N, where the term has densities of its own (else what is in y counts)
        neighbour_forces,  ///< Model::neighbour_forces(); else |energy|/spacing
        damping,           ///< Model::fastest_damping()
        deformation        ///< F, N; where the term remembers places in the material
    };
    struct Answer {
        double number = 0.0;
        std::vector<double> density{};
        std::vector<Mat<Dim>> deformation{};
    };
    /// Of any state, which need not be the one that rates() met last, and leaves no trace.
    virtual Answer answer(Ask what, std::span<const double> y) const {
        if (what == Ask::neighbour_forces) return {std::abs(energy(y)) / particles().spacing};
        return {};
    }
    double energy(std::span<const double> y) const { return ask(Ask::energy, y).number; }
    std::vector<double> density(std::span<const double> y) const {
        return ask(Ask::density, y).density;
    }
    double neighbour_forces(std::span<const double> y) const {
        return ask(Ask::neighbour_forces, y).number;
    }
    double fastest_damping(std::span<const double> y) const { return ask(Ask::damping, y).number; }
    std::vector<Mat<Dim>> deformation_gradients(std::span<const double> y) const {
        return ask(Ask::deformation, y).deformation;
    }

    /// What a law is beside what it finds. Constant, but for the reach of ranges that follow the state.
    struct Nature {
        std::string description{};  ///< one line, for the banner of a run
        /// Of y besides position and velocity, whose rates the term finds or which it keeps (history). No two terms
        /// of a model may find the rate of the same one.
        std::vector<Field> fields{};
        /// Between particles of the model, by their numbers there; no two terms of a model may have some.
        std::vector<Quadrilateral> elements{};
        std::vector<Field> element_fields{};  ///< likewise, of these
        bool moves = false;                   ///< rates() sets x_dot as well; else it is v
        bool moves_with_velocity = true;      ///< x_dot = v
        /// energy() is a function of positions alone: its forces keep the total energy only where particles move
        /// with their own velocity.
        bool potential = true;
        bool own_heat = false;  ///< keeps heat in a field of its own, not in Field::energy
        bool conducts =
            false;  ///< heat passes from particle to particle, and from what is behind a wall
        bool sums_density = false;  ///< of its particles, from the masses of neighbours
        bool fluid_corners =
            false;             ///< its particles are corners of a fluid's elements: no such density
        bool smooth = true;    ///< rates are continuous
        bool settles = false;  ///< settle() may do anything although y holds no history of the term
        bool settles_seldom = false;  ///< and leaves the rates as they are but now and then
        Promises promises{.angular_momentum = Promise::integrator_error};  ///< in open space
        double reach = 0.0;         ///< no two particles farther apart act on each other
        std::string no_images{};    ///< why images behind a wall mean nothing to it
        std::string no_rezoning{};  ///< why its particles cannot be split and merged in a run
        /// Model::events(); of the particles of the model that are held or driven.
        std::function<std::vector<Event>(const std::vector<bool>&)> events{};
    };
    const Nature& nature() const { return nature_; }

    /// Those that the term sweeps (look_after): the model looks there for what walls give, and has them forgotten
    /// where a run is read back.
    std::span<Neighbourhood<Dim>* const> neighbourhoods() const { return neighbourhoods_; }

    /// Pairs and lists of its neighbourhoods, or what it counts itself.
    struct Counts {
        std::size_t pairs = 0, list_builds = 0;
    };
    virtual Counts counts() const;

    /// As the model's functions of these names.
    virtual std::vector<Remark> watch(double, std::span<const double>) { return {}; }
    virtual void set_bodies() {}
    virtual void remember(Memory<Dim>&) {}
    /// Model::take_over(); `before` is the same law, was and now are states of the particles of either.
    virtual void take_over(const Term& /*before*/, const ConstState<Dim>& /*was*/,
                           const Change<Dim>& /*change*/, const State<Dim>& /*now*/) {}

    const Selection<Dim>& among() const { return among_; }
    void bodies_changed() {
        among_.update_bodies();
        set_bodies();
    }

    /// After an accepted step, and before anything else looks at it: the term may change its history fields,
    /// and the stress that goes with them, or what it remembers beyond y. Returns whether rates changed.
    virtual bool settle(double, const State<Dim>&) { return false; }

  protected:
    /// To be set when the term is made.
    Nature nature_{};
    /// To be called once for each, when it is made; it stays where it is.
    void look_after(Neighbourhood<Dim>& near) { neighbourhoods_.push_back(&near); }
    const Particles<Dim>& particles() const { return among_.particles(); }
    const Box<Dim>& box() const { return model().box(); }
    const FieldLayout<Dim>& layout() const { return model().layout(); }
    Model<Dim>& model() const { return among_.model(); }
    ConstState<Dim> state_of(std::span<const double> y) const {
        return among_.of(ConstState<Dim>(layout(), y));
    }
    /// N, the term's own densities or those in y.
    std::vector<double> densities(std::span<const double> y) const {
        auto rho = density(y);
        if (!rho.empty()) return rho;
        const auto in_y = state_of(y).density();
        return {in_y.data(), in_y.data() + in_y.size()};
    }

  private:
    /// A call of all parts of a run, by the numbers of the term's particles.
    Answer ask(Ask what, std::span<const double> y) const {
        const Parts::Among numbers(Parts::here(), among_.first());
        return answer(what, y);
    }

    Selection<Dim> among_;
    std::vector<Neighbourhood<Dim>*> neighbourhoods_;
};

SPAM_COMPILED(extern template class Term);

}  // namespace spam
