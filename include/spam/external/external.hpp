// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/archive.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/core/particles.hpp>

#include <Eigen/Core>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace spam {

/// What acts on particles from outside: gravity, friction, a wall, a clamp. A model holds a list of them
/// and applies them, in order, to the rates that its particles have by themselves.
///
/// What an external does to the whole is never lost: from the rates before and after add() the model forms
/// the force, the torque, the power and the heat that it gives, and integrates them with y (the accounts
/// `impulse`, `angular_impulse`, `work`, `heat` of FieldLayout). p - impulse, L - angular_impulse and
/// E - work - heat are kept as well as the model alone keeps p, L and E, and every run watches them.
/// An external with a potential takes part in E instead and books no work, where particles move with v.
template <int Dim>
class External {
  public:
    virtual ~External() = default;

    /// What a right-hand side is about. Rates are those of particles and of externals before this one.
    struct Now {
        double t;
        const Particles<Dim>& particles;
        ConstState<Dim> state;
        State<Dim> rate;
        std::span<const std::uint32_t>
            numbers{};  ///< in the whole run, of a part of it (core/parts.hpp)
        /// Of particle i in the whole run: what an external knows of single particles is by this number.
        Eigen::Index number(Eigen::Index i) const {
            return numbers.empty()
                       ? i
                       : static_cast<Eigen::Index>(numbers[static_cast<std::size_t>(i)]);
        }
    };

    /// Sums over all particles that add() needs (a centre of mass, a temperature), found once a
    /// right-hand side.
    virtual void prepare(const Now&) {}

    /// Changes the rates of the particles first, ..., last - 1. Called from several threads for different
    /// particles; must not look at the rates of others. No allocation.
    virtual void add(const Now& now, Eigen::Index first, Eigen::Index last) const = 0;

    /// Whether it is a potential of positions: then no work is booked, and energy_at() is the energy of one
    /// particle in it, at x (mass length^2/time^2).
    virtual bool potential() const { return false; }
    /// The energy of one particle at x in the potential, mass length^2/time^2; 0 where there is none.
    virtual double energy_at(const Particles<Dim>&, std::size_t /*particle*/,
                             const Point<Dim>& /*x*/) const {
        return 0.0;
    }
    /// Of all particles.
    double energy(const Particles<Dim>& particles, const ConstState<Dim>& state) const {
        const auto x = state.position();
        return exact_sum(particles.size(), [&](std::size_t i) {
            return energy_at(particles, i, x.col(static_cast<Eigen::Index>(i)));
        });
    }

    /// Whether its power is heat, as that of a thermostat, not work.
    virtual bool thermal() const { return false; }

    /// Mass per volume that it stands for at the particles' places, as matter outside a wall does (N).
    virtual void add_density(const ConstState<Dim>&, std::vector<double>&) const {}

    /// The rate at which it takes motion away (1/time): explicit steps must be short of a few times its
    /// inverse.
    virtual double damping() const { return 0.0; }
    /// Why velocities and positions cannot be advanced in turn; empty where only positions matter.
    virtual std::string inseparable() const { return {}; }
    /// How many particles of the whole run it knows one by one; 0 where it knows none. A model of another number
    /// of particles refuses it.
    virtual std::size_t particles() const { return 0; }
    /// Along how many axes the motion of a particle is prescribed, whatever acts on it.
    virtual int prescribed_axes(std::size_t /*number in the whole run*/) const { return 0; }

    /// "friction gamma = 0.1 of all motion"
    virtual std::string describe() const = 0;
};

/// Which particles an external acts on, by number (N; 0 or 1); empty: all of them.
using Group = std::vector<std::uint8_t>;

/// The particles whose reference position fulfils a condition.
template <int Dim>
Group select(const Particles<Dim>& particles, const std::function<bool(const Point<Dim>&)>& is_in) {
    Group group(particles.size());
    for (std::size_t i = 0; i < group.size(); ++i)
        group[i] = is_in(particles.reference_position.col(static_cast<Eigen::Index>(i)));
    return group;
}

inline bool is_in(const Group& group, Eigen::Index i) {
    return group.empty() || group[static_cast<std::size_t>(i)] != 0;
}

}  // namespace spam
