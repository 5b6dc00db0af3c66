// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/model.hpp>

#include <memory>
#include <vector>

namespace isomorphism {

using namespace spam;

/// Several plane models of the same particles as one model, so that they take the same steps: y holds
/// their states one behind the other, block by block. They do not act on each other.
class SideBySide final : public Model<2> {
  public:
    /// As many particles in every part, in the same box. Throws std::invalid_argument for a part with
    /// an event or with history fields.
    explicit SideBySide(std::vector<std::unique_ptr<Model<2>>> parts);

    void rates(double t, std::span<const double> y, std::span<double> y_dot) override;
    double internal_energy(std::span<const double> y) const override;
    std::vector<double> density(std::span<const double> y) const override;
    Promises promises() const override;
    std::string describe() const override;
    double neighbour_forces(std::span<const double> y) const override;
    bool smooth() const override;
    // Not forwarded: events(). They would change the state of a part, not this one; parts that have one are
    // refused.
    // Not forwarded: settle(). No part has a memory: those that have one are refused.
    // Not forwarded: set_bodies(). Every part stays as many bodies as it was made of.
    std::vector<Remark> watch(double t, std::span<const double> y) override;
    std::string inseparable() const override;
    double fastest_damping() const override;
    std::size_t pairs() const override;
    double reach() const override;
    void remember(Archive& archive) override;

    /// y of one part from the y of all, and back (into rates too). Fields that a part does not have are
    /// left as they are.
    std::vector<double> part(std::size_t k, std::span<const double> y) const;
    void set_part(std::size_t k, std::span<const double> of_part, std::span<double> y) const;

    /// sqrt of the mean square distance between the particles of parts a and b.
    double separation(std::size_t a, std::size_t b, std::span<const double> y) const;

  private:
    void copy_part(std::size_t k, std::span<double> of_part, std::span<const double> y) const;

    std::vector<std::unique_ptr<Model<2>>> parts_;
    std::vector<std::vector<double>> y_, y_dot_;
};

}  // namespace isomorphism
