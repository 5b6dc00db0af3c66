// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/fluid_model.hpp>

#include <algorithm>

namespace diffusion_waves {

using namespace spam;

/// A fluid whose particles are nailed down: only energies (and densities, which stay) are left to change.
class FrozenModel final : public Model<2> {
  public:
    explicit FrozenModel(std::unique_ptr<FluidModel<2>> fluid)
        : Model<2>(fluid->particles(), fluid->box(), fields_of(*fluid)),
          fluid_(std::move(fluid)) {
        for (const auto& block : fluid_->layout().blocks())
            layout().set_scale(block.field, block.scale);
    }

    void rates(double t, std::span<const double> y, std::span<double> y_dot) override {
        fluid_->rates(t, y, y_dot);
        failure_ = fluid_->failure();
        if (!failure_.empty()) return;
        const State<2> rate(layout(), y_dot);
        rate.position().setZero();
        rate.velocity().setZero();
    }
    double internal_energy(std::span<const double> y) const override {
        return fluid_->internal_energy(y);
    }
    std::vector<double> density(std::span<const double> y) const override {
        return fluid_->density(y);
    }
    // Not forwarded: event(). Particles that do not move never meet.
    Promises promises() const override { return fluid_->promises(); }
    std::string describe() const override { return fluid_->describe() + "; particles nailed down"; }
    double neighbour_forces(std::span<const double> y) const override {
        return fluid_->neighbour_forces(y);
    }
    bool smooth() const override { return fluid_->smooth(); }
    std::vector<Remark> watch(double t, std::span<const double> y) override {
        return fluid_->watch(t, y);
    }
    void set_bodies(std::vector<std::int32_t> bodies) override {
        fluid_->set_bodies(bodies);
        Model<2>::set_bodies(std::move(bodies));
    }
    std::string inseparable() const override { return fluid_->inseparable(); }
    std::size_t pairs() const override { return fluid_->pairs(); }
    double reach() const override { return fluid_->reach(); }
    double fastest_damping() const override { return fluid_->fastest_damping(); }
    void remember(Archive& archive) override {
        Model<2>::remember(archive);
        fluid_->remember(archive);
    }

  private:
    static std::vector<Field> fields_of(const FluidModel<2>& fluid) {
        std::vector<Field> fields;
        for (const auto& block : fluid.layout().blocks()) fields.push_back(block.field);
        return fields;
    }

    std::unique_ptr<FluidModel<2>> fluid_;
};

}  // namespace diffusion_waves
