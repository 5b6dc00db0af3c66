// SPDX-License-Identifier: GPL-3.0-or-later
#include "../smooth_particles/carried_energy.hpp"
#include "../sweeps/packed_particles.hpp"
#include "../sweeps/term_sweeps.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/parts.hpp>
#include <spam/physics/ellipse.hpp>
#include <spam/rhs/ellipses.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

/// How far an ellipse may grow before its list is made anew.
constexpr double margin = 1.1;

template <int Dim>
SymTensor<Dim> shape_of(const double* all, std::size_t i) {
    return numbers_at<SymTensor<Dim>>(all + i * SymTensor<Dim>::size);
}

template <int Dim>
Mat<Dim> as_matrix(const SymTensor<Dim>& s) {
    Mat<Dim> m;
    for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b) m(a, b) = s(a, b);
    return m;
}

template <int Dim>
auto extremes(const SymmetricEigen<Dim>& eigen) {
    const auto [least, most] = std::minmax_element(eigen.value.c.begin(), eigen.value.c.end());
    return std::pair(*least, *most);
}

}  // namespace

template <int Dim>
Ellipses<Dim>::~Ellipses() = default;

template <int Dim>
Ellipses<Dim>::Ellipses(const Selection<Dim>& among, const Fluid& fluid,
                        const EllipseScheme& scheme)
    : Term<Dim>(among),
      fluid_(fluid),
      scheme_(scheme),
      unit_(scheme.kernel, 1.0),
      sweeps_(std::make_unique<const Sweeps<Dim>>(
          best_sweeps([](auto level) { return ellipse_sweeps<Dim, level>(); }))) {
    valid_range<Dim>(scheme.range, this->particles().spacing, this->particles().size());
    if (fluid.viscosity || fluid.conduction)
        throw InputError(
            "ranges: ellipses are for fluids without friction and conduction; use fixed ranges");
    if (fluid.state.cold)
        throw InputError(fmt::format(
            "ranges: the energy of '{}' is a function of its density, and nothing could pay where an ellipse is "
            "rounded; use a law with an energy, such as GammaGas",
            fluid.state.describe()));
    if (!(scheme.gradient_share >= 0.0) || !std::isfinite(scheme.gradient_share))
        throw InputError(fmt::format("ellipses: the share of the gradient {:g} must be 0 or more",
                                     scheme.gradient_share));
    if (!(scheme.largest_aspect > 1.0))
        throw InputError(fmt::format("ellipses: the largest aspect {:g} must be above 1",
                                     scheme.largest_aspect));
    if (this->box().periodic())
        throw InputError(
            "ranges: an ellipse may become wider than a periodic box; use fixed ranges there");
    // How far it reaches is known with the first state.
    packed_ = std::make_unique<PackedParticles<Dim>>(
        GeneralWeight<Dim>(scheme.kernel, margin * scheme.range), ListUse::again_and_again,
        this->box(), *sweeps_);
    this->look_after(*packed_);
    this->nature_.description = fmt::format(
        "fluid of smooth particles, {}: ellipses that follow the motion, {} weight of range {:g} at the start{}",
        fluid_.describe(), to_string(scheme.kernel), scheme.range,
        std::isfinite(scheme.largest_aspect)
            ? fmt::format(", aspects up to {:g}", scheme.largest_aspect)
            : "");
    this->nature_.fields = {Field::energy, field_kind::shape};
    this->nature_.potential = false;
    this->nature_.sums_density = true;
    this->nature_.settles = std::isfinite(scheme.largest_aspect);
    this->nature_.no_images = "ellipses have no images behind walls; use rigid sides";
    this->nature_.reach = scheme.range;
}

template <int Dim>
SymmetricEigen<Dim> Ellipses<Dim>::axes(const double* shape, std::size_t i) const {
    return symmetric_eigen(shape_of<Dim>(shape, i));
}

/// A list as far as the longest axis, records of motion and shape. Returns why the state has no meaning.
template <int Dim>
std::string Ellipses<Dim>::follow(PackedParticles<Dim>& packed,
                                  const ConstState<Dim>& state) const {
    using R = EllipseRecord<Dim>;
    constexpr std::size_t size = symmetric_size(Dim);
    const std::size_t n = this->particles().size();
    const double* const shape = state.find(field_kind::shape);
    double longest = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const double least = extremes(axes(shape, i)).first;
        if (!(least > 0.0))
            return fmt::format(
                "the ellipse of particle {} has lost its meaning (a smaller step may keep it)",
                this->particles().id[i]);
        longest = std::max(longest, 1.0 / std::sqrt(least));
    }
    const double reach = Parts::here().most(longest), listed = packed.range();
    if (packed.list().builds() == 0 || reach > listed || reach < 0.7 * listed)
        packed.set_range(margin * reach);
    if (!packed.follow(
            n, {state.position().data(), state.velocity().data(), this->particles().mass.data()}))
        return "a position is not finite";
    packed.template write<R>(
        R::template at<column::Shape>, static_cast<int>(size),
        [&](std::size_t i, double* number) { std::copy_n(shape + i * size, size, number); });
    return {};
}

/// Rates of the shapes, and what they pull with, from the sums that the first sweep has left in the records.
template <int Dim>
std::string Ellipses<Dim>::close_sums(const Now& now) {
    using R = EllipseRecord<Dim>;
    const double* const e = now.state.energy().data();
    double* const shape_dot = now.rate.find(field_kind::shape);
    const auto order = packed_->list().order();
    const std::size_t n = this->particles().size();
    const auto number = [&](std::size_t slot, int at) { return packed_->record(slot) + at; };
    const std::size_t wrong = parallel_count(n, [&](std::size_t slot) {
        const std::size_t i = order[slot];
        const auto symmetric = [&](int at) { return shape_of<Dim>(number(slot, at), 0); };
        const auto G = symmetric(R::template at<column::Shape>);
        const auto B = as_matrix(symmetric(R::template at<column::EllipseMoments>));
        const auto C = numbers_at<Mat<Dim>>(number(slot, R::template at<column::EllipseFlow>));
        Mat<Dim> Lambda;
        const double det = determinant(as_matrix(G)), root = std::sqrt(det);
        const double rho = root * *number(slot, R::template at<column::EllipseWeight>);
        const double m = this->particles().mass[i];
        const double drive = m * fluid_.state.pressure(rho, e[i]) / (rho * rho);
        // Alone: nothing draws it out, and it pulls at nothing.
        const Mat<Dim> inverse_B = B.trace() > 0.0 ? inverse(B) : Mat<Dim>{};
        const Mat<Dim> G_M = as_matrix(G) * symmetric(R::template at<column::EllipseSpread>);
        Mat<Dim> S = (-drive * root) * G_M, Q;
        for (int a = 0; a < Dim; ++a) S(a, a) += drive * rho;
        for (int a = 0; a < Dim; ++a)
            for (int b = 0; b < Dim; ++b)
                for (int c = 0; c < Dim; ++c) {
                    Lambda(a, b) += C(a, c) * inverse_B(c, b);
                    Q(a, b) += S(a, c) * inverse_B(c, b);
                }
        const Mat<Dim> G_Lambda = [&] {
            Mat<Dim> product;
            for (int a = 0; a < Dim; ++a)
                for (int b = 0; b < Dim; ++b)
                    for (int c = 0; c < Dim; ++c) product(a, b) += G(a, c) * Lambda(c, b);
            return product;
        }();
        SymTensor<Dim> G_dot;
        for (int a = 0; a < Dim; ++a)
            for (int b = a; b < Dim; ++b) G_dot(a, b) = -(G_Lambda(a, b) + G_Lambda(b, a));
        *number(slot, R::template at<column::EllipsePull>) = drive * root;
        std::copy_n(Q.c.begin(), Q.c.size(), number(slot, R::template at<column::EllipseStrain>));
        std::copy_n(G_dot.c.begin(), G_dot.c.size(), shape_dot + i * G_dot.c.size());
        bool finite = std::isfinite(drive * root);
        for (const double q : Q.c) finite = finite && std::isfinite(q);
        return std::size_t{!finite};
    });
    if (wrong == 0) return {};
    return fmt::format(
        "{} particles have neighbours on one line only, or a density and an energy outside the law ({})",
        wrong, fluid_.state.describe());
}

template <int Dim>
std::string Ellipses<Dim>::rates(const Now& now) {
    using R = EllipseRecord<Dim>;
    if (auto reason = follow(*packed_, now.state); !reason.empty()) return reason;
    this->nature_.reach = packed_->range();
    SweepInput<Dim> in = packed_->input();
    in.weight = &unit_;
    SweepOutput<Dim> out;
    out.records = packed_->record(0);
    sweeps_->density(in, out);
    if (auto reason = close_sums(now); !reason.empty()) return reason;
    packed_->template refresh<R>(R::template at<column::EllipsePull>);
    out.v_dot = now.v_dot;
    out.e_dot = now.rate.energy().data();
    sweeps_->force(in, out);
    return {};
}

template <int Dim>
std::vector<double> Ellipses<Dim>::summed_density(std::span<const double> y) const {
    using R = EllipseRecord<Dim>;
    std::vector<double> rho(this->particles().size(), std::numeric_limits<double>::quiet_NaN());
    const ConstState<Dim> state = this->state_of(y);
    auto own = packed_->for_observer();
    if (!follow(own, state).empty()) return rho;
    SweepInput<Dim> in = own.input();
    in.weight = &unit_;
    SweepOutput<Dim> out;
    out.records = own.record(0);
    sweeps_->density(in, out);
    const double* const shape = state.find(field_kind::shape);
    for (std::size_t slot = 0; slot < rho.size(); ++slot) {
        const std::size_t i = own.list().order()[slot];
        rho[i] = std::sqrt(determinant(as_matrix(shape_of<Dim>(shape, i)))) *
                 own.record(slot)[R::template at<column::EllipseWeight>];
    }
    return rho;
}

/// Only the shape of what is too long: the volume stays.
template <int Dim>
bool Ellipses<Dim>::settle(double, const State<Dim>& state) {
    if (!std::isfinite(scheme_.largest_aspect)) return false;
    const double limit = scheme_.largest_aspect * scheme_.largest_aspect;
    double* const shape = state.find(field_kind::shape);
    const std::size_t changed = parallel_count(this->particles().size(), [&](std::size_t i) {
        auto eigen = axes(shape, i);
        const double most = extremes(eigen).second;
        if (!(most > limit * (1.0 + 1e-12) * extremes(eigen).first)) return std::size_t{0};
        double before = 1.0, after = 1.0;
        for (double& value : eigen.value.c) {
            before *= value;
            value = std::max(value, most / limit);
            after *= value;
        }
        for (double& value : eigen.value.c) value *= std::pow(before / after, 1.0 / Dim);
        const auto G = from_eigen(eigen.value, eigen.vectors);
        std::copy_n(G.c.begin(), G.c.size(), shape + i * G.c.size());
        return std::size_t{1};
    });
    return Parts::here().any(changed > 0);
}

/// By the gradient that one particle after the other finds with circles.
template <int Dim>
void Ellipses<Dim>::shorten_along_gradient(std::span<double> y,
                                           const std::vector<double>& rho) const {
    using R = EllipseRecord<Dim>;
    double* const shape = State<Dim>(this->layout(), y).find(field_kind::shape);
    auto near = packed_->for_observer();
    if (!follow(near, ConstState<Dim>(this->layout(), y)).empty()) return;
    for (std::size_t slot = 0; slot < rho.size(); ++slot) {
        const std::size_t i = near.list().order()[slot];
        const double* const own = near.record(slot);
        Vec<Dim> gradient;
        for (const std::uint32_t entry :
             near.list().entries(slot / static_cast<std::size_t>(near.list().width()))) {
            const double* const other = near.record(entry / R::numbers);
            Vec<Dim> r_ji;
            for (int a = 0; a < Dim; ++a) r_ji[a] = other[a] - own[a];
            const double u = std::sqrt(dot(r_ji, r_ji)) / scheme_.range;
            gradient += (other[R::template at<column::Mass>] * unit_.minus_slope_over_r(u) /
                         std::pow(scheme_.range, Dim + 2)) *
                        r_ji;
        }
        const double steep = std::sqrt(dot(gradient, gradient));
        if (!(steep > 0.0)) continue;
        const double shorter = 1.0 + scheme_.gradient_share * steep * scheme_.range / rho[i];
        SymTensor<Dim> G = shape_of<Dim>(shape, i);
        const double more = (shorter * shorter - 1.0) * G(0, 0) / (steep * steep);
        for (int a = 0; a < Dim; ++a)
            for (int b = a; b < Dim; ++b) G(a, b) += more * gradient[a] * gradient[b];
        std::copy_n(G.c.begin(), G.c.size(), shape + i * G.c.size());
    }
}

template <int Dim>
std::vector<double> Ellipses<Dim>::start(const Points<Dim>& position, const Points<Dim>& velocity,
                                         double T) {
    expect_start<Dim>(*this, position, velocity);
    std::vector<double> y(this->layout().size(), 0.0);
    const State<Dim> state(this->layout(), y);
    state.position() = position;
    double* const shape = state.find(field_kind::shape);
    constexpr std::size_t size = symmetric_size(Dim);
    for (std::size_t i = 0; i < this->particles().size(); ++i)
        for (std::size_t a = 0; a < Dim; ++a)
            shape[i * size + a] = 1.0 / (scheme_.range * scheme_.range);
    if (scheme_.gradient_share > 0.0) shorten_along_gradient(y, summed_density(y));
    const auto rho = summed_density(y);
    auto started = fluid_start<Dim>(
        this->model(), [&](std::size_t) -> const AnyEquationOfState& { return fluid_.state; },
        position, velocity, rho, T);
    std::copy_n(shape, rho.size() * size,
                State<Dim>(this->layout(), started).find(field_kind::shape));
    this->model().layout().set_scale(field_kind::shape, 1.0 / (scheme_.range * scheme_.range));
    return started;
}

template <int Dim>
double Ellipses<Dim>::largest_aspect(std::span<const double> y) const {
    const double* const shape = this->state_of(y).find(field_kind::shape);
    double largest = 1.0;
    for (std::size_t i = 0; i < this->particles().size(); ++i) {
        const auto [least, most] = extremes(axes(shape, i));
        largest = std::max(largest, std::sqrt(most / least));
    }
    return Parts::here().most(largest);
}

template <int Dim>
auto Ellipses<Dim>::answer(Ask what, std::span<const double> y) const -> Answer {
    if (what == Ask::damping) return {};  // asked without a state, too
    const ConstState<Dim> state = this->state_of(y);
    if (what == Ask::energy) return {carried_energy(this->particles(), state)};
    if (what == Ask::density) return {0.0, summed_density(y)};
    if (what == Ask::neighbour_forces)
        return {carried_energies(this->particles(), state) / this->particles().spacing};
    return {};
}

SPAM_COMPILED(template class Ellipses);

}  // namespace spam
