// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/event.hpp>
#include <spam/core/memory.hpp>
#include <spam/neighbors/box.hpp>
#include <spam/physics/scheme.hpp>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace spam {

/// Something worth knowing that happened between two steps, for events.csv and the log.
struct Remark {
    std::string what;
    double value;
    bool stop = false;     ///< the run must not go on
    bool warning = false;  ///< said on the terminal as well, not in the log alone

    void remember(Archive& archive) { archive(what, value, stop); }
};

/// What is typical of a body, in the units of the run; all positive.
struct TypicalValues {
    double length;   ///< between neighbours
    double speed;    ///< of particles
    double density;  ///< mass per volume
    double stress;   ///< a modulus: what has the unit of a stress or of a force is measured by it
};

/// A mechanical system as an ordinary differential equation dy/dt = f(t, y): what integrators,
/// observers and snapshots need to know of it. One virtual call per right-hand side, none per pair.
template <int Dim>
class Model {
  public:
    /// Of these particles in this box; `fields` are those of y, for N particles.
    Model(Particles<Dim> particles, const Box<Dim>& box, const std::vector<Field>& fields)
        : particles_(std::move(particles)),
          box_(box),
          layout_(particles_.size(), fields) {}
    virtual ~Model() = default;
    Model(const Model&) = delete;
    Model& operator=(const Model&) = delete;

    /// y_dot = f(t, y). Pure: the same (t, y) give the same bits with any number of threads, and in a
    /// solid with any history; in a flow neighbour lists of another age change the last digits. Never
    /// throws, never allocates after warm-up except for new lists. A state without physical meaning
    /// fills y_dot with NaN and leaves the reason in failure().
    virtual void rates(double t, std::span<const double> y, std::span<double> y_dot) = 0;

    /// Jv = J v, J = df/dy at (t, y), by central differences of the rates over 3e-6 in the norm of y by the scales
    /// of the layout: to about 1e-10 of its size, for two right-hand sides. v and Jv are of y without accounts,
    /// which no rate depends on. Where the rates have no meaning Jv is NaN.
    void tangent(double t, std::span<const double> y, std::span<const double> v,
                 std::span<double> Jv);

    /// Sum of the energy that is not kinetic: internal (m e) or potential.
    virtual double internal_energy(std::span<const double> y) const = 0;

    /// Elements between the particles, which hold fields of their own; empty for particles alone.
    virtual std::span<const Quadrilateral> quadrilaterals() const { return {}; }

    /// Densities of all particles; empty for a model without density.
    virtual std::vector<double> density(std::span<const double> y) const;

    /// F of all particles, N; F_ab = d x_a/d X_b. Empty where no law remembers places in the material; 1 of
    /// particles whose laws do not.
    virtual std::vector<Mat<Dim>> deformation_gradients(std::span<const double> /*y*/) const {
        return {};
    }

    /// What changes y between steps; for one run, and no longer than the model.
    virtual std::vector<Event> events() const { return {}; }

    /// How well the equations keep each invariant, in this box.
    virtual Promises promises() const = 0;
    virtual std::string describe() const = 0;  ///< one line for banner and dry run

    /// Looks at an accepted state; called after every step, in order. May remember, must not change the
    /// rates.
    virtual std::vector<Remark> watch(double, std::span<const double>) { return {}; }

    /// Whether settle() may change anything.
    virtual bool settles() const;
    /// Whether it leaves the rates as they are but now and then, so that methods which go on from earlier
    /// steps serve, and begin anew where it does not.
    virtual bool settles_seldom() const { return false; }
    /// After every accepted step, before anything else looks at it: what is not integrated may be changed here
    /// (a plastic return: history fields, and the stress that goes with them). Returns whether y was; the
    /// integrator is told.
    virtual bool settle(double, std::span<double>) { return false; }

    /// Gives every particle its body anew, 0, 1, ... as connected_parts() does. The integrator must be
    /// reset where rates depend on it.
    virtual void set_bodies(std::vector<std::int32_t> bodies) {
        particles_.body = std::move(bodies);
    }

    /// What the model knows beyond y: bodies, and what watch() remembers. After reading, the next rates
    /// are those of a model made anew: lists built before are forgotten, which a run that writes a
    /// checkpoint does as well, by reading it back.
    virtual void remember(Memory<Dim>& memory);
    /// The same, written into an archive or read from it.
    void remember(Archive& archive) {
        Memory<Dim> memory(archive);
        remember(memory);
    }
    /// After y and the memory of `before`, a model of other particles in state `was`, have been carried over to
    /// this one and `y` (problem/remake.hpp): laws take up what follows from the change, and where they have a heat,
    /// the energy that it takes from the motion. Throws InputError where a law forbids such a change.
    virtual void take_over(const Model& /*before*/, std::span<const double> /*was*/,
                           const Change<Dim>& /*change*/, std::span<double> /*y*/) {}
    /// What changes of particles have given so far, as accounts say what externals have.
    struct Gains {
        double work = 0.0;
        Point<Dim> impulse = Point<Dim>::Zero();
        Eigen::Matrix<double, Dim*(Dim - 1) / 2, 1> angular_impulse =
            Eigen::Matrix<double, Dim*(Dim - 1) / 2, 1>::Zero();
    };
    /// Of all changes of particles before the model was made (problem/remake.hpp).
    Gains& gains() { return gains_; }
    const Gains& gains() const { return gains_; }  ///< see gains()

    /// Why velocity and position cannot be advanced in turn, as leapfrog does; empty where dx/dt = v
    /// and dv/dt depends on x alone and y holds nothing else.
    virtual std::string inseparable() const;

    /// Estimate of the rate at which friction and conduction take the fastest motion away in state y
    /// (of bodies at rest without heat where that is empty), 0 without: explicit steps must be short of a few
    /// times its inverse.
    virtual double fastest_damping(std::span<const double> /*y*/) const { return 0.0; }

    /// Sum over all particles of the magnitudes of what their neighbours do to them, before it cancels, as
    /// energies and stresses tell: sum (m |e| + m |sigma|/rho)/spacing, or |internal energy|/spacing. Of
    /// these forces rounding leaves a part that no promise can be better than.
    virtual double neighbour_forces(std::span<const double> y) const;

    /// Whether rates are continuous: where they jump, every method is of order one.
    virtual bool smooth() const { return true; }

    /// Pairs (undirected) that the latest right-hand side summed over.
    virtual std::size_t pairs() const = 0;
    /// Distance up to which two particles act on each other.
    virtual double reach() const = 0;

    /// Why the latest rates are NaN; empty when they are not.
    const std::string& failure() const { return failure_; }

    /// Mass, id, body and reference position, in the order of y.
    const Particles<Dim>& particles() const { return particles_; }
    /// Periods and walls.
    const Box<Dim>& box() const { return box_; }
    /// Where each field lies in y; to be changed (set_scale) before a state is integrated.
    FieldLayout<Dim>& layout() { return layout_; }
    /// The same to read only.
    const FieldLayout<Dim>& layout() const { return layout_; }
    /// Scales of all fields of the layout, by their units.
    void set_scales(const TypicalValues& typical);
    /// Those of a model of the same laws.
    void take_scales(const Model& other);
    /// The time in which what is fastest, particles or sound, passes a typical length; 1 before set_scales().
    double time_scale() const { return time_scale_; }

  protected:
    /// What is left of promises in the model's box: in a periodic one turning is no symmetry, and the
    /// angular momentum is not kept.
    Promises in_box(Promises promises) const;

    /// Ends a right-hand side that has no meaning.
    void fail(std::span<double> y_dot, std::string reason);

  private:
    Particles<Dim> particles_;
    Box<Dim> box_;
    FieldLayout<Dim> layout_;
    double time_scale_ = 1.0;
    Gains gains_;
    std::array<std::vector<double>, 3>
        beside_;  ///< of tangent(): a state, and rates on either side

  protected:
    std::string failure_;
};

SPAM_COMPILED(extern template class Model);

}  // namespace spam
