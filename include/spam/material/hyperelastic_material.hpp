// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/error.hpp>
#include <spam/core/particles.hpp>
#include <spam/material/hyperelastic_law.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace spam {

/// Any hyperelastic law as a value. One virtual call per few hundred particles; the loop over them
/// behind it is compiled for the law. Implicit, so that a model can be given the law itself.
template <int Dim>
class HyperelasticMaterial {
  public:
    template <class Law>
    requires HyperelasticLaw<Law, Dim> || HyperelasticLawWithMemory<Law, Dim> ||
        HyperelasticLawInTime<Law, Dim>
        HyperelasticMaterial(const Law& law) : loop_(std::make_shared<LoopOver<Law>>(law)) {
        if constexpr (requires { law.validate(); }) law.validate();
    }
    /// Of each particle the one with its number in Particles::material. They have one density, that of the scheme.
    /// Throws InputError where there is none.
    HyperelasticMaterial(std::vector<HyperelasticMaterial> several)
        : count_(several.size()),
          loop_(std::make_shared<Several>(std::move(several))) {
        if (count_ == 0) throw InputError("material: none is given; give one at least");
    }

    /// How many there are.
    std::size_t count() const { return count_; }
    /// The same for these particles, whose numbers are those of its functions.
    HyperelasticMaterial of(const Particles<Dim>& particles) const {
        HyperelasticMaterial bound = *this;
        if (auto loop = loop_->of(particles.material)) bound.loop_ = std::move(loop);
        return bound;
    }

    /// P of the particles with these numbers, rows of Dim x Dim numbers, `stride` numbers from one particle
    /// to the next, F given in the same way. False where one of them is not finite.
    bool stresses(std::span<const std::uint32_t> particles, std::size_t stride, const double* F,
                  double* P, const ConstState<Dim>& state, double t = 0.0) const {
        return loop_->stresses(t, particles, stride, F, P, state);
    }
    /// Of particle i, per reference volume.
    double energy(std::size_t i, const Mat<Dim>& F, const ConstState<Dim>& state) const {
        return loop_->energy(i, F, state);
    }
    /// What y holds for the law; none where it has no memory.
    std::vector<Field> history() const { return loop_->history(); }
    /// Whether the memory of the law has rates.
    bool has_rates() const { return loop_->has_rates(); }
    /// Sets them for particle i.
    void rates(double t, std::size_t i, const Mat<Dim>& F, const Mat<Dim>& F_dot,
               const ConstState<Dim>& state, const State<Dim>& rate) const {
        loop_->rates(t, i, F, F_dot, state, rate);
    }
    /// Whether settle() may change anything.
    bool settles() const { return loop_->settles(); }
    /// After an accepted step: whether the law has changed the history of particle i.
    bool settle(double t, std::size_t i, const Mat<Dim>& F, const State<Dim>& state) const {
        return loop_->settle(t, i, F, state);
    }
    /// False where the law's energy is not that of its stress (it says so by a keeps_energy of its own).
    bool keeps_energy() const { return loop_->keeps_energy(); }
    /// Whether the law is a FlowingLaw that may flow, and its flow.
    bool flows() const { return loop_->flows(); }
    std::optional<Mat<Dim>> flow(std::size_t i, const Mat<Dim>& F) const {
        return loop_->flow(i, F);
    }
    /// Infinite where the law does not flow; of several the least, and the largest stiffness.
    double yield_strain() const { return loop_->yield_strain(); }
    double stiffness() const { return loop_->stiffness(); }
    /// The law of particle i alone, of those that of() has given numbers.
    const HyperelasticMaterial& law(std::size_t i) const {
        const HyperelasticMaterial* const one = loop_->law(i);
        return one != nullptr ? *one : *this;
    }
    std::string describe() const { return loop_->describe(); }

  private:
    struct Loop {
        virtual ~Loop() = default;
        virtual bool stresses(double, std::span<const std::uint32_t>, std::size_t, const double*,
                              double*, const ConstState<Dim>&) const = 0;
        virtual double energy(std::size_t, const Mat<Dim>&, const ConstState<Dim>&) const = 0;
        virtual std::vector<Field> history() const = 0;
        virtual bool has_rates() const = 0;
        virtual void rates(double, std::size_t, const Mat<Dim>&, const Mat<Dim>&,
                           const ConstState<Dim>&, const State<Dim>&) const = 0;
        virtual bool settles() const = 0;
        virtual bool settle(double, std::size_t, const Mat<Dim>&, const State<Dim>&) const = 0;
        virtual bool keeps_energy() const = 0;
        virtual bool flows() const = 0;
        virtual std::optional<Mat<Dim>> flow(std::size_t, const Mat<Dim>&) const = 0;
        virtual double yield_strain() const = 0;
        virtual double stiffness() const = 0;
        virtual std::string describe() const = 0;
        /// Null where there is one for all.
        virtual const HyperelasticMaterial* law(std::size_t) const { return nullptr; }
        /// Null where it does not depend on the numbers of materials.
        virtual std::shared_ptr<const Loop> of(const std::vector<std::int32_t>&) const {
            return nullptr;
        }
    };

    template <class Law>
    struct LoopOver final : Loop {
        static constexpr bool in_time = HyperelasticLawInTime<Law, Dim>;
        static constexpr bool remembers = HyperelasticLawWithMemory<Law, Dim> || in_time;
        explicit LoopOver(const Law& l) : law(l) {}

        // flatten: a law is a small function, a call would cost as much as it does
        [[gnu::flatten]] bool stresses(
            [[maybe_unused]] double t, std::span<const std::uint32_t> particles, std::size_t stride,
            const double* F, double* P,
            [[maybe_unused]] const ConstState<Dim>& state) const override {
            const Law own = law;  // a copy that the stores below cannot be suspected to change
            double zero = 0.0;    // or NaN
            const auto each = [&](const auto& stress_of) {
                for (std::size_t k = 0; k < particles.size(); ++k) {
                    Mat<Dim> gradient;
                    for (std::size_t c = 0; c < Dim * Dim; ++c) gradient.c[c] = F[k * stride + c];
                    const Mat<Dim> stress = stress_of(particles[k], gradient);
                    for (std::size_t c = 0; c < Dim * Dim; ++c) {
                        P[k * stride + c] = stress.c[c];
                        zero += 0.0 * stress.c[c];
                    }
                }
            };
            if constexpr (in_time)
                each([now = own.in_state(t, state)](std::size_t i, const Mat<Dim>& gradient) {
                    return now.stress(i, gradient);
                });
            else if constexpr (remembers)
                each([now = own.in_state(state)](std::size_t i, const Mat<Dim>& gradient) {
                    return now.stress(i, gradient);
                });
            else
                each([&](std::size_t, const Mat<Dim>& gradient) { return own.stress(gradient); });
            return zero == 0.0;
        }
        double energy([[maybe_unused]] std::size_t i, const Mat<Dim>& F,
                      [[maybe_unused]] const ConstState<Dim>& state) const override {
            if constexpr (in_time)
                return law.in_state(0.0, state).energy(i, F);
            else if constexpr (remembers)
                return law.in_state(state).energy(i, F);
            else
                return law.energy(F);
        }
        std::vector<Field> history() const override {
            if constexpr (remembers) return law.history();
            return {};
        }
        bool has_rates() const override { return HyperelasticLawWithRates<Law, Dim> || in_time; }
        void rates([[maybe_unused]] double t, [[maybe_unused]] std::size_t i,
                   [[maybe_unused]] const Mat<Dim>& F, [[maybe_unused]] const Mat<Dim>& F_dot,
                   [[maybe_unused]] const ConstState<Dim>& state,
                   [[maybe_unused]] const State<Dim>& rate) const override {
            if constexpr (in_time)
                law.rates(t, state, rate)(i, F, F_dot);
            else if constexpr (HyperelasticLawWithRates<Law, Dim>)
                law.rates(state, rate)(i, F, F_dot);
        }
        bool settles() const override { return in_time || (remembers && !has_rates()); }
        bool settle([[maybe_unused]] double t, [[maybe_unused]] std::size_t i,
                    [[maybe_unused]] const Mat<Dim>& F,
                    [[maybe_unused]] const State<Dim>& state) const override {
            if constexpr (in_time)
                return law.settle(t, i, F, state);
            else if constexpr (remembers)
                return law.settle(i, F, state);
            return false;
        }
        bool keeps_energy() const override {
            if constexpr (requires { Law::keeps_energy; }) return Law::keeps_energy;
            return true;
        }
        bool flows() const override {
            if constexpr (FlowingLaw<Law, Dim>) return law.flows();
            return false;
        }
        std::optional<Mat<Dim>> flow(std::size_t,
                                     [[maybe_unused]] const Mat<Dim>& F) const override {
            if constexpr (FlowingLaw<Law, Dim>) return law.flow(F);
            return {};
        }
        double yield_strain() const override {
            if constexpr (FlowingLaw<Law, Dim>) return law.yield_strain();
            return std::numeric_limits<double>::infinity();
        }
        double stiffness() const override { return law.stiffness(); }
        std::string describe() const override { return law.describe(); }
        Law law;
    };

    struct Several final : Loop {
        explicit Several(std::vector<HyperelasticMaterial> several) : all(std::move(several)) {}

        std::shared_ptr<const Loop> of(const std::vector<std::int32_t>& material) const override {
            auto bound = std::make_shared<Several>(*this);
            bound->number = material;
            return bound;
        }
        const HyperelasticMaterial* law(std::size_t i) const override {
            return &all[number.empty() ? 0 : static_cast<std::size_t>(number[i])];
        }
        /// Each run of particles of one material at once.
        bool stresses(double t, std::span<const std::uint32_t> particles, std::size_t stride,
                      const double* F, double* P, const ConstState<Dim>& state) const override {
            bool finite = true;
            for (std::size_t first = 0, last = 0; first < particles.size(); first = last) {
                const HyperelasticMaterial* const one = law(particles[first]);
                for (last = first + 1; last < particles.size() && law(particles[last]) == one;)
                    ++last;
                finite = one->stresses(particles.subspan(first, last - first), stride,
                                       F + first * stride, P + first * stride, state, t) &&
                         finite;
            }
            return finite;
        }
        double energy(std::size_t i, const Mat<Dim>& F,
                      const ConstState<Dim>& state) const override {
            return law(i)->energy(i, F, state);
        }
        std::vector<Field> history() const override {
            std::vector<Field> fields;
            for (const auto& one : all)
                for (const Field field : one.history())
                    if (std::find(fields.begin(), fields.end(), field) == fields.end())
                        fields.push_back(field);
            return fields;
        }
        bool any(bool (HyperelasticMaterial::*holds)() const) const {
            return std::any_of(all.begin(), all.end(),
                               [&](const auto& one) { return (one.*holds)(); });
        }
        bool has_rates() const override { return any(&HyperelasticMaterial::has_rates); }
        void rates(double t, std::size_t i, const Mat<Dim>& F, const Mat<Dim>& F_dot,
                   const ConstState<Dim>& state, const State<Dim>& rate) const override {
            law(i)->rates(t, i, F, F_dot, state, rate);
        }
        bool settles() const override { return any(&HyperelasticMaterial::settles); }
        bool settle(double t, std::size_t i, const Mat<Dim>& F,
                    const State<Dim>& state) const override {
            return law(i)->settle(t, i, F, state);
        }
        bool keeps_energy() const override {
            return std::all_of(all.begin(), all.end(),
                               [](const auto& one) { return one.keeps_energy(); });
        }
        bool flows() const override { return any(&HyperelasticMaterial::flows); }
        std::optional<Mat<Dim>> flow(std::size_t i, const Mat<Dim>& F) const override {
            return law(i)->flow(i, F);
        }
        double yield_strain() const override {
            return std::ranges::min(all, {}, &HyperelasticMaterial::yield_strain).yield_strain();
        }
        double stiffness() const override {
            return std::ranges::max(all, {}, &HyperelasticMaterial::stiffness).stiffness();
        }
        std::string describe() const override {
            std::string words;
            for (const auto& one : all) words += (words.empty() ? "" : " | ") + one.describe();
            return words;
        }
        std::vector<HyperelasticMaterial> all;
        std::vector<std::int32_t> number{};
    };

    std::size_t count_ = 1;
    std::shared_ptr<const Loop> loop_;
};

}  // namespace spam
