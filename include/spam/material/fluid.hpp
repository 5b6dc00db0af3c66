// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/equation_of_state.hpp>
#include <spam/material/fourier_conduction.hpp>
#include <spam/material/newton_viscosity.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace spam {

/// Any equation of state as a value. One virtual call for all particles (or for one question); the
/// loop over them behind it is compiled for the law. Implicit, so that a model can be given the law
/// itself.
class AnyEquationOfState {
  public:
    template <EquationOfState Law>
    requires(!std::same_as<Law, AnyEquationOfState>) AnyEquationOfState(const Law& law)
        : cold(ColdEquationOfState<Law>),
          thermal(has_temperature<Law>),
          loop_(std::make_shared<LoopOver<Law>>(law)) {}

    bool cold;     ///< density alone decides: cold_energy() may be asked for
    bool thermal;  ///< temperature() may be asked for

    /// As many pressures as densities and energies; NaN outside the law.
    void pressures(std::span<const double> rho, std::span<const double> e,
                   std::span<double> P) const {
        loop_->pressures(rho, e, P);
    }
    /// Likewise; precondition: thermal.
    void temperatures(std::span<const double> rho, std::span<const double> e,
                      std::span<double> T) const {
        loop_->temperatures(rho, e, T);
    }
    double pressure(double rho, double e) const { return loop_->pressure(rho, e); }
    double sound_speed(double rho, double e) const { return loop_->sound_speed(rho, e); }
    double temperature(double rho, double e) const { return loop_->temperature(rho, e); }
    /// c_v by mass; precondition: thermal. By a difference where the law does not tell it.
    double heat_capacity(double rho, double e) const { return loop_->heat_capacity(rho, e); }
    /// Energy per mass at density rho and temperature T; of a cold law whatever T is. 0 where the law
    /// says neither (a clamped one may: it is work from there on).
    double starting_energy(double rho, double T) const { return loop_->starting_energy(rho, T); }
    double cold_energy(double rho) const { return loop_->cold_energy(rho); }
    std::string describe() const { return loop_->describe(); }

  private:
    template <class Law>
    static constexpr bool has_temperature = requires(const Law law) {
        { law.temperature(1.0, 1.0) } -> std::same_as<double>;
    };

    struct Loop {
        virtual ~Loop() = default;
        virtual void pressures(std::span<const double>, std::span<const double>,
                               std::span<double>) const = 0;
        virtual void temperatures(std::span<const double>, std::span<const double>,
                                  std::span<double>) const = 0;
        virtual double pressure(double rho, double e) const = 0;
        virtual double sound_speed(double rho, double e) const = 0;
        virtual double temperature(double rho, double e) const = 0;
        virtual double heat_capacity(double rho, double e) const = 0;
        virtual double starting_energy(double rho, double T) const = 0;
        virtual double cold_energy(double rho) const = 0;
        virtual std::string describe() const = 0;
    };

    template <class Law>
    struct LoopOver final : Loop {
        explicit LoopOver(const Law& l) : law(l) {}
        static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

        void pressures(std::span<const double> rho, std::span<const double> e,
                       std::span<double> P) const override {
            for (std::size_t i = 0; i < P.size(); ++i) P[i] = law.pressure(rho[i], e[i]);
        }
        void temperatures(std::span<const double> rho, std::span<const double> e,
                          std::span<double> T) const override {
            for (std::size_t i = 0; i < T.size(); ++i) T[i] = temperature(rho[i], e[i]);
        }
        double pressure(double rho, double e) const override { return law.pressure(rho, e); }
        double sound_speed(double rho, double e) const override {
            return spam::sound_speed(law, rho, e);
        }
        double temperature(double rho, double e) const override {
            if constexpr (has_temperature<Law>) return law.temperature(rho, e);
            return nan;
        }
        double heat_capacity(double rho, double e) const override {
            if constexpr (requires { law.heat_capacity(rho, e); })
                return law.heat_capacity(rho, e);
            else {
                const double d = std::max(1e-6 * std::abs(e), std::numeric_limits<double>::min());
                return d / (temperature(rho, e + d) - temperature(rho, e));
            }
        }
        double starting_energy(double rho, double T) const override {
            if constexpr (requires { law.energy(rho, T); })
                return law.energy(rho, T);
            else if constexpr (ColdEquationOfState<Law>)
                return law.cold_energy(rho);
            else
                return 0.0;
        }
        double cold_energy(double rho) const override {
            if constexpr (ColdEquationOfState<Law>) return law.cold_energy(rho);
            return nan;
        }
        std::string describe() const override { return law.describe(); }
        Law law;
    };

    std::shared_ptr<const Loop> loop_;
};

/// What a fluid is made of: what it is at rest, and friction and conduction where it has them.
struct Fluid {
    /// Pressure, temperature and sound speed of density and energy.
    AnyEquationOfState state;
    /// Friction; none where unset.
    std::optional<NewtonViscosity> viscosity{};
    /// Conduction of heat; none where unset.
    std::optional<FourierConduction> conduction{};
    /// Whether both are found from differences of pairs (physics/pair_friction.hpp), not from gradients.
    bool by_pairs = false;

    /// Whether it has friction or conduction.
    bool diffuses() const { return viscosity || conduction; }
    /// One line.
    std::string describe() const {
        std::string words = state.describe();
        if (viscosity) words += "; " + viscosity->describe();
        if (conduction) words += "; " + conduction->describe();
        if (by_pairs && diffuses()) words += " (by pairs)";
        return words;
    }
};

}  // namespace spam
