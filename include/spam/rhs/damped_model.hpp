// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/model.hpp>

#include <memory>

namespace spam {

/// Another plane model with a friction that leaves rigid motions alone, to find what a vibrating body
/// comes to rest at:
///     v_dot_i += -gamma (v_i - V - omega z x (r_i - R)),
/// R, V centre of mass and its velocity, omega = L/I about it. The friction has neither force nor
/// torque: momentum and angular momentum are kept as the model keeps them, energy is lost.
class DampedModel final : public Model<2> {
  public:
    /// `gamma` >= 0: what is not rigid dies out in a time of about 2/gamma.
    DampedModel(std::unique_ptr<Model<2>> model, double gamma);

    void rates(double t, std::span<const double> y, std::span<double> y_dot) override;
    double internal_energy(std::span<const double> y) const override;
    std::vector<double> density(std::span<const double> y) const override;
    Promises promises() const override;
    std::string describe() const override;
    std::vector<Remark> watch(double t, std::span<const double> y) override {
        return model_->watch(t, y);
    }
    void remember(Archive& archive) override;
    void set_bodies(std::vector<std::int32_t> bodies) override;
    std::string inseparable() const override {
        return gamma_ > 0.0 ? "its friction depends on the velocity" : model_->inseparable();
    }
    std::size_t pairs() const override { return model_->pairs(); }
    double reach() const override { return model_->reach(); }
    double fastest_damping() const override { return gamma_ + model_->fastest_damping(); }

    const Model<2>& undamped() const { return *model_; }

  private:
    std::unique_ptr<Model<2>> model_;
    double gamma_;
};

}  // namespace spam
