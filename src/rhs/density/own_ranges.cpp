// SPDX-License-Identifier: GPL-3.0-or-later
#include "../smooth_particles/carried_energy.hpp"
#include "../smooth_particles/constitution.hpp"
#include "../sweeps/packed_particles.hpp"
#include "../sweeps/term_sweeps.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/parts.hpp>
#include <spam/physics/variable_range.hpp>
#include <spam/rhs/own_ranges.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spam {
namespace {

/// Why particles with a cold law are not split or merged.
std::string rezoned_cold() {
    return "the energy of this law is a function of the density, which is found anew with ranges that follow it where "
           "particles are split or merged, and nothing can pay; use a law with an energy, such as GammaGas";
}

}  // namespace

std::string VariableRangeScheme::describe() const {
    return fmt::format("{} weight of range {} (m/rho)^(1/D){}", to_string(kernel), range,
                       without_gradients ? ", gradients of the range left out" : "");
}

template <int Dim>
OwnRanges<Dim>::~OwnRanges() = default;

template <int Dim>
OwnRanges<Dim>::OwnRanges(const Selection<Dim>& among, std::vector<Fluid> fluids,
                          const VariableRangeScheme& scheme)
    : Term<Dim>(among),
      fluids_(std::move(fluids)),
      scheme_(scheme),
      unit_(scheme.kernel, 1.0),
      sweeps_(std::make_unique<const Sweeps<Dim>>(best_sweeps(
          [&](auto level) { return own_range_sweeps<Dim, level>(any(fluids_, diffuses)); }))),
      range_(this->particles().size()),
      pressure_(range_.size()),
      pull_(range_.size()),
      temperature_(any(fluids_, conducts) ? range_.size() : 0) {
    const double least = std::pow(unit_.value(0.0), 1.0 / Dim);
    if (!(scheme.range > least) || !std::isfinite(scheme.range))
        throw InputError(
            fmt::format("range: {:g} must be above {:.4g} for the {} weight, or a particle alone "
                        "would have the density that "
                        "its range asks for; 2 to 4 are usual",
                        scheme.range, least, to_string(scheme.kernel)));
    valid_range<Dim>(scheme.range, 1.0, this->particles().size());  // in spacings
    check_fluids(fluids_, Dim);
    check_materials(this->particles(), fluids_.size());
    if (any(fluids_, diffuses)) {
        if (any(fluids_, by_gradients))
            throw InputError(
                "friction: with ranges that follow the density friction and conduction are those of pairs; set "
                "Fluid::by_pairs, or use one range for all");
        rest_ = std::make_unique<const RestingBody>(resting_body(
            this->particles(), this->box(), GeneralWeight<Dim>(scheme.kernel, resting_range())));
    }
    // How far it reaches is known with the first state.
    packed_ = std::make_unique<PackedParticles<Dim>>(
        GeneralWeight<Dim>(scheme.kernel, this->particles().spacing), ListUse::again_and_again,
        this->box(), *sweeps_);
    this->look_after(*packed_);
    this->nature_.description = fmt::format("fluid of smooth particles, {}: density integrated, {}",
                                            spam::describe(fluids_), scheme_.describe());
    this->nature_.fields = {Field::density, Field::energy};
    this->nature_.potential = false;
    this->nature_.sums_density = true;
    this->nature_.conducts = any(fluids_, conducts);
    if (any(fluids_, has_shear)) this->nature_.promises = Scheme{}.promises(Dim);
    if (any(fluids_, cold)) this->nature_.no_rezoning = rezoned_cold();
}

template <int Dim>
const Fluid& OwnRanges<Dim>::of(std::size_t i) const {
    return fluid_of(fluids_, this->particles().material, i);
}

template <int Dim>
double OwnRanges<Dim>::range_of(std::size_t i, double rho) const {
    const double volume = this->particles().mass[i] / rho;
    if constexpr (Dim == 1) return scheme_.range * volume;
    if constexpr (Dim == 2) return scheme_.range * std::sqrt(volume);
    return scheme_.range * std::cbrt(volume);
}

/// The least distance of two walls that face each other and have images.
template <int Dim>
double OwnRanges<Dim>::between_walls() const {
    double least = std::numeric_limits<double>::infinity();
    for (int a = 0; a < Dim; ++a)
        if (const auto& lower = this->box().wall(a, false), &upper = this->box().wall(a, true);
            lower.has_images() && upper.has_images())
            least = std::min(least, upper.at - lower.at);
    return least;
}

/// That, or half of the shortest periodic length.
template <int Dim>
double OwnRanges<Dim>::most_range() const {
    double most = between_walls();
    for (int a = 0; a < Dim; ++a)
        if (this->box().periodic(a)) most = std::min(most, 0.5 * this->box().length(a));
    return most;
}

/// Of the body at rest, whose sums say how fast friction acts: walls may be nearer than that where particles are closer
/// to each other than their spacing.
template <int Dim>
double OwnRanges<Dim>::resting_range() const {
    const double usual = scheme_.range * this->particles().spacing;
    return usual < between_walls() ? usual : 0.9 * between_walls();
}

/// range_ and this->nature_.reach. Returns why they make no sense.
template <int Dim>
std::string OwnRanges<Dim>::find_ranges(const ConstState<Dim>& state) {
    const auto rho = state.density();
    std::size_t widest = 0;
    for (std::size_t i = 0; i < range_.size(); ++i) {
        const double r = rho(0, static_cast<Eigen::Index>(i));
        if (!(r > 0.0))
            return fmt::format(
                "density {} of particle {} is not positive (it is integrated: "
                "a smaller step may keep it)",
                r, this->particles().id[i]);
        range_[i] = range_of(i, r);
        if (range_[i] > range_[widest]) widest = i;
    }
    const double own = range_.empty() ? 0.0 : range_[widest];  // a part may have no particle
    this->nature_.reach = Parts::here().most(own);
    if (this->nature_.reach < most_range()) return {};
    const std::string which = own == this->nature_.reach
                                  ? fmt::format(" of particle {}", this->particles().id[widest])
                                  : "";
    return fmt::format(
        "range {:g}{} has grown to half of the periodic box or to the distance of two walls",
        this->nature_.reach, which);
}

/// A list that reaches as far as the longest range, and some way further as long as ranges grow.
template <int Dim>
void OwnRanges<Dim>::make_room() {
    const double listed = packed_->range();
    if (packed_->list().builds() > 0 && this->nature_.reach <= listed &&
        this->nature_.reach > 0.7 * listed)
        return;
    packed_->set_range(
        std::min(1.1 * this->nature_.reach, 0.5 * (this->nature_.reach + most_range())));
}

template <int Dim>
std::string OwnRanges<Dim>::rates(const Now& now) {
    using R = RangeRecord<Dim>;
    if (auto reason = find_ranges(now.state); !reason.empty()) return reason;
    make_room();
    const std::size_t n = range_.size();
    if (!packed_->follow(n, {now.state.position().data(), now.state.velocity().data(),
                             this->particles().mass.data()}))
        return "a position is not finite";
    const auto fill = [&](int at, const auto& number_of) {
        packed_->template write<R>(at, 1,
                                   [&](std::size_t i, double* number) { *number = number_of(i); });
    };
    fill(R::template at<column::InverseRange>, [&](std::size_t i) { return 1.0 / range_[i]; });
    SweepInput<Dim> in = packed_->input();
    in.weight = &unit_;
    SweepOutput<Dim> out;
    out.spread = now.rate.energy().data();
    out.approach = now.rate.density().data();
    out.v_dot = now.v_dot;
    sweeps_->density(in, out);
    sweep_walls(*packed_, in, sweeps_->density);
    if (close_own_sums(now) > 0) {
        std::size_t i = 0;
        while (!std::isnan(pull_[i]) && i + 1 < n) ++i;
        return fmt::format(
            "density {} and energy {} of particle {} are outside the law ({}), or its "
            "range changes the wrong way",
            now.state.density().data()[i], now.state.energy().data()[i], this->particles().id[i],
            of(i).state.describe());
    }
    if (rest_)
        load_friction(now);
    else
        fill(R::template at<column::Pull>, [&](std::size_t i) { return pull_[i]; });
    sweeps_->force(in, out);
    // As in close_own_sums(): e_dot = P/rho^2 rho_dot, of which each wall has its part.
    packed_->for_each_wall([&](BehindWall<Dim>& wall) {
        for (std::size_t k = 0; k < wall.particle.size(); ++k)
            wall.e_dot[wall.place[k]] *= -pull_[wall.particle[k]];
    });
    sweep_walls(*packed_, in, sweeps_->force);
    if (!rest_) return {};
    out.e_dot = now.rate.energy().data();
    sweeps_->second(in, out);
    sweep_walls(*packed_, in, sweeps_->second);
    return {};
}

/// Rates of density and energy in place of the sums they are made of. Returns how many have no meaning: their pull_ is
/// NaN.
template <int Dim>
std::size_t OwnRanges<Dim>::close_own_sums(const Now& now) {
    const std::size_t n = range_.size();
    const std::span<const double> rho{now.state.density().data(), n},
        e{now.state.energy().data(), n};
    parallel_blocks(n, [&](std::size_t first, std::size_t count) {
        for_each_material(
            this->particles().material, first, count,
            [&](std::size_t m, std::size_t begin, std::size_t size) {
                const auto of_rho = rho.subspan(begin, size), of_e = e.subspan(begin, size);
                fluids_[m].state.pressures(of_rho, of_e, {pressure_.data() + begin, size});
                if (!temperature_.empty())
                    fluids_[m].state.temperatures(of_rho, of_e,
                                                  {temperature_.data() + begin, size});
            });
    });
    double* const spread = now.rate.energy().data();
    double* const approach = now.rate.density().data();
    return parallel_count(n, [&](std::size_t i) {
        const double h = range_[i], volume = range_power<Dim>(h);
        const double Omega =
            scheme_.without_gradients ? 1.0 : 1.0 - spread[i] / (Dim * rho[i] * volume);
        const double per_range = 1.0 / (volume * h * h * Omega);
        const double P_rho2 = pressure_[i] / (rho[i] * rho[i]);
        const double rho_dot = -approach[i] * per_range;
        approach[i] = rho_dot;
        spread[i] = P_rho2 * rho_dot;
        const bool too_cold = !temperature_.empty() && !(temperature_[i] >= 0.0);
        const bool outside = !std::isfinite(pressure_[i]) || !(Omega > 0.0) || too_cold;
        pull_[i] = outside ? std::numeric_limits<double>::quiet_NaN() : P_rho2 * per_range;
        return std::size_t{outside};
    });
}

template <int Dim>
void OwnRanges<Dim>::take_over(const Term<Dim>& /*before*/, const ConstState<Dim>& /*was*/,
                               const Change<Dim>& change, const State<Dim>& now) {
    bool all_same = true;
    for (std::size_t k = 0; k < change.parts.size(); ++k) all_same = all_same && change.same(k);
    if (all_same) return;
    if (any(fluids_, cold)) throw InputError("population: " + rezoned_cold());
    std::ranges::copy(solve_densities(now.position()), now.density().data());
}

template <int Dim>
std::vector<double> OwnRanges<Dim>::ranges(std::span<const double> y) const {
    const auto rho = this->state_of(y).density();
    std::vector<double> h(range_.size());
    for (std::size_t i = 0; i < h.size(); ++i)
        h[i] = range_of(i, rho(0, static_cast<Eigen::Index>(i)));
    return h;
}

template <int Dim>
auto OwnRanges<Dim>::answer(Ask what, std::span<const double> y) const -> Answer {
    if (what == Ask::damping) return {fastest_damping_in(y)};  // asked without a state, too
    const ConstState<Dim> state = this->state_of(y);
    if (what == Ask::energy) return {carried_energy(this->particles(), state)};
    if (what == Ask::neighbour_forces)
        return {carried_energies(this->particles(), state) / this->particles().spacing};
    return {};
}

SPAM_COMPILED(template class OwnRanges);

}  // namespace spam
