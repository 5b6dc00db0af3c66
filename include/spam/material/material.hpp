// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>
#include <spam/material/stress_law.hpp>

#include <algorithm>
#include <array>
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
    /// A copy of `law`, any struct with a stress_rate() or, for many particles at a time, stress_rates()
    /// (stress_law.hpp).
    template <class Law>
    requires(StressLaw<Law, Dim> || BatchStressLaw<Law, Dim>) Material(const Law& law)
        : loop_(std::make_shared<LoopOver<Law>>(law)) {}

    /// sigma_dot of the particles with these numbers from their velocity gradients, as many, and from `stress`,
    /// D(D+1)/2 numbers for each of all particles: that in `state`, or what it is returned to. Sets the
    /// rates of further fields of the law as well.
    void stress_rates(std::span<const std::uint32_t> particles, std::span<const Mat<Dim>> grad_v,
                      const double* stress, const ConstState<Dim>& state,
                      const State<Dim>& rate) const {
        loop_->run(particles, grad_v, stress, state, rate);
    }
    /// Whether the stress in y is a trial (ReturningLaw).
    bool returns() const { return loop_->returns(); }
    /// Of the particles [first, first + count): what their stress in `state` is returned to, into the same
    /// places of `stress`, which has those of all.
    void return_stress(double t, std::size_t first, std::size_t count, const ConstState<Dim>& state,
                       double* stress) const {
        loop_->return_stress(t, first, count, state, stress);
    }
    /// One line, the law's own.
    std::string describe() const { return loop_->describe(); }

    /// The further fields of the law, which y holds for it; none where it has no memory.
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
        virtual void run(std::span<const std::uint32_t>, std::span<const Mat<Dim>>, const double*,
                         const ConstState<Dim>&, const State<Dim>&) const = 0;
        virtual bool returns() const = 0;
        virtual void return_stress(double t, std::size_t first, std::size_t count,
                                   const ConstState<Dim>& state, double* stress) const = 0;
        virtual std::string describe() const = 0;
        virtual std::optional<double> sound_speed(double density) const = 0;
        virtual std::vector<Field> history() const = 0;
        virtual bool settle(double t, std::size_t first, std::size_t count,
                            const State<Dim>& state) const = 0;
    };

    template <class Law>
    struct LoopOver final : Loop {
        static constexpr auto components = static_cast<std::size_t>(symmetric_size(Dim));
        explicit LoopOver(const Law& l) : law(l) {}

        static SymTensor<Dim> stress_at(const double* all, std::size_t i) {
            SymTensor<Dim> stress;
            for (std::size_t c = 0; c < components; ++c) stress.c[c] = all[components * i + c];
            return stress;
        }
        static void store(const SymTensor<Dim>& stress, double* all, std::size_t i) {
            for (std::size_t c = 0; c < components; ++c) all[components * i + c] = stress.c[c];
        }

        void run(std::span<const std::uint32_t> particles, std::span<const Mat<Dim>> grad_v,
                 const double* from, const ConstState<Dim>& state,
                 const State<Dim>& rate) const override {
            if constexpr (BatchStressLaw<Law, Dim>)
                run_batches(particles, grad_v, from, rate.stress().data());
            else
                run_each(particles, grad_v, from, rate.stress().data(), state, rate);
        }
        void run_batches(std::span<const std::uint32_t> particles, std::span<const Mat<Dim>> grad_v,
                         const double* from, double* to) const {
            std::array<SymTensor<Dim>, batch_of_stresses> stress, rate;
            while (!particles.empty()) {
                const std::size_t n = std::min(particles.size(), batch_of_stresses);
                for (std::size_t k = 0; k < n; ++k) stress[k] = stress_at(from, particles[k]);
                law.stress_rates(grad_v.first(n), {stress.data(), n}, {rate.data(), n});
                for (std::size_t k = 0; k < n; ++k) store(rate[k], to, particles[k]);
                particles = particles.subspan(n);
                grad_v = grad_v.subspan(n);
            }
        }
        // flatten: a law is a small function, a call would cost as much as it does
        [[gnu::flatten]] void run_each(std::span<const std::uint32_t> particles,
                                       std::span<const Mat<Dim>> grad_v, const double* from,
                                       double* to, [[maybe_unused]] const ConstState<Dim>& state,
                                       const State<Dim>& rate) const {
            const Law own = law;  // a copy that the stores below cannot be suspected to change
            const auto each = [&](const auto& rate_of) {
                for (std::size_t k = 0; k < particles.size(); ++k) {
                    const std::size_t i = particles[k];
                    store(rate_of(i, Mat<Dim>(grad_v[k]), stress_at(from, i)), to, i);
                }
            };
            if constexpr (LawWithRates<Law, Dim>)
                each(own.rates(state, rate));
            else
                each([&](std::size_t, const Mat<Dim>& gradient, const SymTensor<Dim>& stress) {
                    return own.stress_rate(gradient, stress);
                });
        }
        bool returns() const override { return ReturningLaw<Law, Dim>; }
        [[gnu::flatten]] void return_stress([[maybe_unused]] double t, std::size_t first,
                                            std::size_t count, const ConstState<Dim>& state,
                                            double* to) const override {
            const double* const from = state.stress().data();
            if constexpr (LawThatReturnsBlocks<Law, Dim>) {
                law.return_block(t, state, first, count, to);
            } else if constexpr (ReturningLaw<Law, Dim>) {
                const Law own = law;
                const auto returned = own.return_map(t, state);
                for (std::size_t i = first; i < first + count; ++i)
                    store(returned(i, stress_at(from, i)), to, i);
            } else {
                std::copy_n(from + components * first, components * count, to + components * first);
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
