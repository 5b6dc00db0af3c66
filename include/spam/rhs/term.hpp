// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/selection.hpp>

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

    /// The fields of y, besides position and velocity, whose rates the term finds or which it keeps
    /// (history). No two terms of a model may find the rate of the same one.
    virtual std::vector<Field> fields() const { return {}; }

    /// Elements between particles of the model, by their numbers there; no two terms of a model may have some.
    virtual std::span<const Quadrilateral> quadrilaterals() const { return {}; }
    /// Fields of the elements, as fields() are those of the particles.
    virtual std::vector<Field> element_fields() const { return {}; }

    /// v_dot, and the rates of fields(). Pure, no allocation after warm-up except for new lists.
    /// Returns why the state has no meaning; empty where it has one.
    virtual std::string rates(const Now& now) = 0;

    /// Whether rates() sets x_dot as well; else it is v.
    virtual bool moves() const { return false; }
    /// Whether x_dot = v.
    virtual bool moves_with_velocity() const { return true; }
    /// Whether energy() is a function of positions alone: its forces keep the total energy only where
    /// particles move with their own velocity.
    virtual bool potential() const { return true; }

    /// The energy that is not kinetic.
    virtual double energy(std::span<const double> y) const = 0;
    /// N, empty where the term has no density of its own (then what is in y counts).
    virtual std::vector<double> density(std::span<const double>) const { return {}; }
    /// Model::neighbour_forces()
    virtual double neighbour_forces(std::span<const double> y) const {
        return std::abs(energy(y)) / particles().spacing;
    }

    /// Why the images behind a wall mean nothing to the term, and what would; empty where it takes them.
    virtual std::string no_images(const Wall<Dim>& wall) const {
        if (potential() && wall.passes_energy())
            return "forces from a potential feel neither the velocity nor the temperature of a wall; use a "
                   "mirror";
        if (wall.temperature && !conducts())
            return "nothing here conducts heat, and the temperature behind a wall has no effect; leave it "
                   "out";
        return {};
    }
    /// Whether heat passes from particle to particle, and from what is behind a wall.
    virtual bool conducts() const { return false; }

    /// Those that the term sweeps (look_after): the model looks there for what walls give, and has them forgotten
    /// where a run is read back.
    std::span<Neighbourhood<Dim>* const> neighbourhoods() const { return neighbourhoods_; }

    virtual std::vector<Event> events() const { return {}; }
    /// In open space.
    virtual Promises promises() const {
        Promises p;
        p.angular_momentum = Promise::integrator_error;
        return p;
    }
    virtual std::string describe() const = 0;
    virtual double fastest_damping(std::span<const double> /*y*/) const { return 0.0; }
    virtual bool smooth() const { return true; }
    /// Of its neighbourhoods, here and below.
    virtual std::size_t pairs() const;
    virtual double reach() const = 0;
    virtual std::size_t list_builds() const;

    /// As the model's functions of these names.
    virtual std::vector<Remark> watch(double, std::span<const double>) { return {}; }
    virtual void set_bodies() {}
    virtual void remember(Memory<Dim>&) {}
    /// F of the particles of the term; empty where it remembers no places in the material.
    virtual std::vector<Mat<Dim>> deformation_gradients(std::span<const double>) const {
        return {};
    }
    /// Model::take_over(); `before` is the same law, was and now are states of the particles of either.
    virtual void take_over(const Term& /*before*/, const ConstState<Dim>& /*was*/,
                           const Change<Dim>& /*change*/, const ConstState<Dim>& /*now*/) {}

    const Selection<Dim>& among() const { return among_; }
    void bodies_changed() {
        among_.update_bodies();
        set_bodies();
    }

    /// After an accepted step, and before anybody looks at it: the term may change its history fields,
    /// and the stress that goes with them, or what it remembers beyond y. Returns whether rates changed.
    virtual bool settle(double, const State<Dim>&) { return false; }
    /// Whether settle() may do anything although y holds no history of the term.
    virtual bool settles() const { return false; }
    /// Whether what it does leaves the rates as they are but now and then (Model::settles_seldom).
    virtual bool settles_seldom() const { return false; }

  protected:
    /// To be called once for each, when it is made; it stays where it is.
    void look_after(Neighbourhood<Dim>& near) { neighbourhoods_.push_back(&near); }
    /// For laws whose neighbours are not those of a Neighbourhood. Throws InputError where a run is in several parts.
    void require_one_part(const std::string& what) const;
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
    Selection<Dim> among_;
    std::vector<Neighbourhood<Dim>*> neighbourhoods_;
};

extern template class Term<1>;
extern template class Term<2>;
extern template class Term<3>;

}  // namespace spam
