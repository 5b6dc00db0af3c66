// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/event.hpp>
#include <spam/core/nvector.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spam {

/// dy/dt = f(t, y) as integrators see it: callables and vectors, no particles.
struct Ode {
    /// Fills y_dot. Must not throw (std::bad_alloc excepted); NaN means 'no physical meaning here'.
    std::function<void(double t, std::span<const double> y, std::span<double> y_dot)> rates;
    /// Why the latest rates are NaN, empty otherwise.
    std::function<std::string()> failure;
    /// Entry k of y in words, for messages: "velocity_y of particle 17".
    std::function<std::string(std::size_t k)> entry_name;
    /// Absolute tolerance of every entry of y; used by adaptive methods. Infinite: no say in the steps.
    std::vector<double> absolute_tolerance;
    /// How long something takes, in the unit of t: what is a tiny step is told by it.
    double time_scale = 1.0;
    /// What changes y at single times.
    std::vector<Event> events{};
    /// After every accepted step (events applied): may change y, and returns whether it did; the integrator
    /// then begins anew from there. Null where nothing is ever changed. With multistep methods only where
    /// it seldom does.
    std::function<bool(double t, std::span<double> y)> settle{};
    bool settles_seldom = false;
    /// Entries of y that belong together, in order: "position", "velocity", ...
    struct Block {
        std::string name;
        std::size_t first, size;
    };
    std::vector<Block> blocks{};
    /// The last so many entries of y, of no block, are accounts: integrals along the motion, which no rate
    /// depends on.
    std::size_t accounts = 0;
    /// Why `velocity` and `position` cannot be advanced in turn; empty where they can.
    std::string inseparable{};

    /// What the rates keep, whatever y is (gradient . rates = 0); empty where they keep nothing such.
    std::function<double(std::span<const double> y)> energy{};
    /// Fills dE/dy. Returns how many evaluations of the rates that took.
    std::function<std::size_t(double t, std::span<const double> y, std::span<double> gradient)>
        energy_gradient{};
    /// Why there is no energy: "the scheme does not keep it".
    std::string no_energy{};
};

/// How to integrate: a method of integration_methods() (methods.hpp), with fixed steps where `dt` is
/// set and adaptive ones where not. What is not set is the method's own choice.
struct IntegratorOptions {
    /// A name of integration_methods().
    std::string method = "rk4";
    /// Fixed step, in units of time; unset: steps are adaptive.
    std::optional<double> dt;
    /// Relative tolerance of adaptive steps.
    double rtol = 1e-8;
    double atol = 1e-10;  ///< times the scale of each field
    struct FieldTolerance {
        std::string field;  ///< a block of the ode
        double atol;        ///< in place of atol times scale
    };
    /// Fields with an absolute tolerance of their own, in their units.
    std::vector<FieldTolerance> field_atol{};
    /// An adaptive step below this stops the run; unset: 1e-12 of Ode::time_scale.
    std::optional<double> min_step{};
    std::optional<double> max_step{};      ///< no adaptive step is longer
    std::optional<double> initial_step{};  ///< the first one; unset: the method's own choice
    std::string controller{};        ///< of ARKODE's steps, one of arkode_controllers(); empty: pid
    std::optional<double> safety{};  ///< of ARKODE's steps: part of the one that would just do
    bool relaxation = false;  ///< ARKODE rescales every adaptive step so that it keeps the energy
    std::optional<std::size_t> max_steps{};  ///< more accepted steps than that stop the run

    bool adaptive() const;  ///< precondition: valid
    /// Of a field whose typical magnitude is `scale`.
    double absolute_tolerance(std::string_view field, double scale) const;
    /// "rk4, fixed step dt = 0.1"; for the banner.
    std::string describe() const;

    /// Throws InputError naming the offending option, the allowed values and the fix.
    void validate() const;
};

/// The step contract. An integrator is bound to one Ode and one state vector y:
/// - step(t_stop) advances y by one accepted step, not past t_stop, and returns the new time;
/// - after it y is finite; where it could not be, GuardStop is thrown with the reason and y and t
///   are those of the last accepted step, or of the last event since;
/// - an event of the ode is applied at its time, all that are due within a step one after the other.
///   An adaptive step ends at an event, a fixed one takes the rest of its way to the grid: what
///   observers see lies after the events. Where events no longer let time go on, GuardStop. After a
///   signal (InterruptWatch) step() returns at the next event; the next step() goes on from there;
/// - lands_on_stops(): whether steps may be shortened to hit intermediate times (adaptive methods);
///   a fixed-step method keeps its grid t_n = t_0 + n dt and shortens only the step that reaches
///   t_stop;
/// - reset(t) must follow any change of y from outside;
/// - remember() writes where the integration stands (y itself apart) and, reading, goes on from y as an
///   integrator does that was made there: bit for bit the same whether it was or not.
class Integrator {
  public:
    Integrator(const Ode& ode, Vector& y, double t0);
    virtual ~Integrator() = default;
    Integrator(const Integrator&) = delete;
    Integrator& operator=(const Integrator&) = delete;

    /// Throws GuardStop where the steps allowed are used up.
    double step(double t_stop);
    virtual bool lands_on_stops() const = 0;
    virtual void reset(double t) = 0;
    virtual void remember(Archive& archive);

    struct Statistics {
        std::size_t steps = 0;
        std::size_t rejected_steps = 0;
        std::size_t rhs_evaluations = 0;
        std::size_t events = 0;  ///< as Event::apply counts them
        double last_step = 0.0;

        // Which block of y kept adaptive steps short, by the method's own estimate of their errors; the
        // last number is shared by all blocks from there on. Of a long y only every eighth step is looked
        // at: it takes three passes.
        static constexpr std::size_t most_blocks = 6;
        std::array<std::size_t, most_blocks> limited_by{};  ///< steps, of those measured
        std::array<double, most_blocks> error_share{};      ///< of the error, summed over steps
        std::optional<std::size_t> limiting{};              ///< the latest step

        void remember(Archive& archive) {
            archive(steps, rejected_steps, rhs_evaluations, events, last_step, limited_by,
                    error_share, limiting);
        }
    };
    const Statistics& statistics() const { return statistics_; }
    double t() const { return t_; }
    /// Fixed steps: whether the latest one was neither shortened by its t_stop nor interrupted by a
    /// signal between events, so that a run with a later end passes through the same (t, y).
    bool whole_step() const { return whole_step_; }
    const Ode& ode() const { return ode_; }
    /// `most`: accepted steps, counted from the beginning of the run.
    void allow_steps(std::size_t most) { most_steps_ = most; }

  protected:
    virtual double take_step(double t_stop) = 0;
    /// The first number of a state, about to be accepted at time t, that is not finite, in words; empty
    /// where all are.
    std::string non_finite_entry(std::span<const double> z, double t) const;
    /// Throws GuardStop with these words.
    void guard(std::span<const double> z, double t) const;
    /// The first rate that is not finite, in words; empty where all are. The stage that spoils first
    /// knows where it began: later ones have spread it.
    std::string non_finite_rate(std::span<const double> y_dot, double t) const;

    /// Whether to find out what limited this adaptive step.
    bool errors_due() const { return size_ < 8192 || statistics_.steps % 8 == 0; }

    const Ode& ode_;
    Vector& y_;
    double t_;
    bool whole_step_ = true;
    Statistics statistics_;

  private:
    std::string not_finite(const char* of, std::span<const double> z, double t) const;

    std::size_t size_;  ///< of y in all parts of a run
    std::optional<std::size_t> most_steps_;
};

/// Throws InputError for a method that does not exist or cannot run with these options.
/// `ode`, `y` and `context` must outlive the integrator.
std::unique_ptr<Integrator> make_integrator(const IntegratorOptions& options, const Ode& ode,
                                            Vector& y, double t0, const SundialsContext& context);

}  // namespace spam
