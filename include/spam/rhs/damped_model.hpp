// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/model.hpp>

#include <memory>

namespace spam {

/// What a friction acts against.
enum class Friction {
    internal_motion,  ///< what is not rigid motion
    all_motion        ///< velocity itself: things come to rest in the box they are in
};

/// Another plane model with a friction, to find what a vibrating body comes to rest at. One that leaves
/// rigid motions alone,
///     v_dot_i += -gamma (v_i - V - omega z x (r_i - R)),
/// R, V centre of mass and its velocity, omega = L/I about it, has neither force nor torque: momentum
/// and angular momentum are kept as the model keeps them, energy is lost. In a periodic box, where no
/// rotation is rigid, and against drift there is
///     v_dot_i += -gamma v_i,
/// which lets momenta die out as exp(-gamma t).
class DampedModel final : public Model<2> {
  public:
    /// `gamma` >= 0: what is acted against dies out in a time of about 2/gamma. Throws InputError for
    /// another.
    DampedModel(std::unique_ptr<Model<2>> model, double gamma,
                Friction friction = Friction::internal_motion);

    void rates(double t, std::span<const double> y, std::span<double> y_dot) override;
    double internal_energy(std::span<const double> y) const override;
    std::vector<double> density(std::span<const double> y) const override;
    /// Of the model itself: y is the same for both.
    std::optional<Event> event() const override { return model_->event(); }
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
    double neighbour_forces(std::span<const double> y) const override {
        return model_->neighbour_forces(y);
    }
    bool smooth() const override { return model_->smooth(); }
    std::size_t pairs() const override { return model_->pairs(); }
    double reach() const override { return model_->reach(); }
    double fastest_damping() const override { return gamma_ + model_->fastest_damping(); }

    const Model<2>& undamped() const { return *model_; }

  private:
    std::unique_ptr<Model<2>> model_;
    double gamma_;
    Friction friction_;
};

}  // namespace spam
