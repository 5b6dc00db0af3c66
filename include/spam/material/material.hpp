// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>
#include <spam/material/stress_law.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace spam {

/// Any stress law as a value. One virtual call per few hundred particles; the loop over them behind
/// it is compiled for the law. Implicit, so that a model can be given the law itself.
template <int Dim>
class Material {
  public:
    template <StressLaw<Dim> Law>
    Material(const Law& law) : loop_(std::make_shared<LoopOver<Law>>(law)) {}

    /// sigma_dot of the particles with these numbers from their velocity gradients and their stress
    /// in `state`. As many numbers as gradients.
    void stress_rates(std::span<const std::uint32_t> particles, std::span<const Mat<Dim>> grad_v,
                      const ConstState<Dim>& state, const State<Dim>& rate) const {
        loop_->run(particles, grad_v, state, rate);
    }
    std::string describe() const { return loop_->describe(); }

    /// The history fields of the law, which y holds for it; none where it has no memory.
    std::vector<Field> history() const { return loop_->history(); }
    /// After an accepted step: the law changes stress and history of the particles [first, first + count)
    /// where it has something to change (a plastic return, damage). Returns whether it did.
    bool settle(double t, std::size_t first, std::size_t count, const State<Dim>& state) const {
        return loop_->settle(t, first, count, state);
    }

    /// Longitudinal, where the law has a sound_speed(density).
    std::optional<double> sound_speed(double density) const { return loop_->sound_speed(density); }

  private:
    struct Loop {
        virtual ~Loop() = default;
        virtual void run(std::span<const std::uint32_t>, std::span<const Mat<Dim>>,
                         const ConstState<Dim>&, const State<Dim>&) const = 0;
        virtual std::string describe() const = 0;
        virtual std::optional<double> sound_speed(double density) const = 0;
        virtual std::vector<Field> history() const = 0;
        virtual bool settle(double t, std::size_t first, std::size_t count,
                            const State<Dim>& state) const = 0;
    };

    template <class Law>
    struct LoopOver final : Loop {
        explicit LoopOver(const Law& l) : law(l) {}

        // flatten: a law is a small function, a call would cost as much as it does
        [[gnu::flatten]] void run(std::span<const std::uint32_t> particles,
                                  std::span<const Mat<Dim>> grad_v, const ConstState<Dim>& state,
                                  const State<Dim>& rate) const override {
            constexpr auto n = static_cast<std::size_t>(symmetric_size(Dim));
            const double* const from = state.stress().data();
            double* const to = rate.stress().data();
            const Law own = law;  // a copy that the stores below cannot be suspected to change
            for (std::size_t k = 0; k < particles.size(); ++k) {
                const std::size_t first = n * particles[k];
                const Mat<Dim> gradient = grad_v[k];
                SymTensor<Dim> sigma;
                for (std::size_t c = 0; c < n; ++c) sigma.c[c] = from[first + c];
                const SymTensor<Dim> sigma_dot = own.stress_rate(gradient, sigma);
                for (std::size_t c = 0; c < n; ++c) to[first + c] = sigma_dot.c[c];
            }
        }
        std::string describe() const override { return law.describe(); }
        std::optional<double> sound_speed(double density) const override {
            if constexpr (requires { law.sound_speed(density); }) return law.sound_speed(density);
            return {};
        }
        std::vector<Field> history() const override {
            if constexpr (LawWithHistory<Law, Dim>) return law.history();
            return {};
        }
        bool settle([[maybe_unused]] double t, [[maybe_unused]] std::size_t first,
                    [[maybe_unused]] std::size_t count,
                    [[maybe_unused]] const State<Dim>& state) const override {
            bool changed = false;
            if constexpr (LawWithHistory<Law, Dim>)
                for (std::size_t i = first; i < first + count; ++i)
                    changed = law.settle(t, i, state) || changed;
            return changed;
        }
        Law law;
    };

    std::shared_ptr<const Loop> loop_;
};

}  // namespace spam
