// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/external/external.hpp>
#include <spam/rhs/model.hpp>

#include <memory>

namespace spam {

/// Particles that act on each other by the law of a derived class and on which externals act. Every
/// external works with every law: friction, gravity or a clamp are written once.
template <int Dim>
class ParticleModel : public Model<Dim> {
  public:
    using Externals = std::vector<std::unique_ptr<External<Dim>>>;

    /// Adds an external behind those there are. y grows by the accounts (external.hpp): add externals
    /// before a state is made.
    void add(std::unique_ptr<External<Dim>> external);
    const Externals& externals() const { return externals_; }

    void rates(double t, std::span<const double> y, std::span<double> y_dot) final;
    /// With the potentials of externals.
    double internal_energy(std::span<const double> y) const final;
    std::vector<double> density(std::span<const double> y) const final;
    /// Throws InputError where some particles are held and others are reflected: a reflection would move
    /// what is held.
    std::vector<Event> events() const final;
    /// The law's own: what externals give is in the accounts.
    Promises promises() const final { return pair_promises(); }
    std::string describe() const final;
    std::string inseparable() const final;
    double fastest_damping() const final;
    double neighbour_forces(std::span<const double> y) const override;

  protected:
    ParticleModel(Particles<Dim> particles, const Box<Dim>& box, const std::vector<Field>& fields)
        : Model<Dim>(std::move(particles), box, fields) {}

    // The law of the particles alone: what Model's functions of the same names say of the whole.
    virtual void pair_rates(double t, std::span<const double> y, std::span<double> y_dot) = 0;
    virtual double pair_energy(std::span<const double> y) const = 0;
    virtual std::vector<double> pair_density(std::span<const double> y) const;
    virtual std::vector<Event> pair_events() const { return {}; }
    virtual Promises pair_promises() const = 0;
    virtual std::string pair_description() const = 0;
    virtual double pair_damping() const { return 0.0; }
    /// Whether x_dot = v: else a potential changes at another rate than its forces do work, and the work is
    /// booked instead.
    virtual bool moves_with_velocity() const { return true; }

  private:
    /// What one external gives to the particles of a block, per time.
    struct Given {
        static constexpr int planes = Dim * (Dim - 1) / 2;
        Point<Dim> force = Point<Dim>::Zero();
        Eigen::Matrix<double, planes, 1> torque = Eigen::Matrix<double, planes, 1>::Zero();
        double power = 0.0, heat = 0.0;
    };
    static constexpr Eigen::Index block = 256;  ///< particles whose rates are changed at a time

    void apply(External<Dim>& external, const typename External<Dim>::Now& now);
    Given apply_to(const External<Dim>& external, const typename External<Dim>::Now& now,
                   Eigen::Index first, Eigen::Index last) const;
    void book(const External<Dim>& external, const Given& given, const State<Dim>& rate) const;

    bool has_energy(const External<Dim>& external) const {
        return external.potential() && moves_with_velocity();
    }

    Externals externals_;
    std::vector<Given> given_;  ///< by block
};

extern template class ParticleModel<1>;
extern template class ParticleModel<2>;
extern template class ParticleModel<3>;

}  // namespace spam
