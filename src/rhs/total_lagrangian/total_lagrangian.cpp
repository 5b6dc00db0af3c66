// SPDX-License-Identifier: GPL-3.0-or-later
#include "../smooth_particles/constitution.hpp"
#include "../sweeps/packed_particles.hpp"
#include "../sweeps/term_sweeps.hpp"
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/symmetric_eigen.hpp>
#include <spam/physics/lagrangian_record.hpp>
#include <spam/rhs/total_lagrangian.hpp>

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace spam {
namespace {

/// Where in a record what begins.
template <int Dim>
constexpr std::size_t stride = StressedRecord<Dim>::numbers;
template <int Dim>
constexpr int present_at = StressedRecord<Dim>::template at<column::Present>;
template <int Dim>
constexpr int volume_at = StressedRecord<Dim>::template at<column::Volume>;
template <int Dim>
constexpr int K_at = StressedRecord<Dim>::template at<column::Correction>;
template <int Dim>
constexpr int F_at = StressedRecord<Dim>::template at<column::Deformation>;
template <int Dim>
constexpr int B_at = StressedRecord<Dim>::template at<column::ReferenceStress>;

/// Of records that hold velocities in place of present positions: images have the same.
template <int Dim>
constexpr auto moving_kinds = [] {
    auto kinds = StressedRecord<Dim>::kinds;
    for (std::size_t a = 0; a < Dim; ++a)
        kinds[static_cast<std::size_t>(present_at<Dim>) + a].quantity = Quantity::velocity;
    return kinds;
}();

template <int Dim>
using Tensor = Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>;

template <int Dim>
TotalLagrangianScheme validated(const TotalLagrangianScheme& scheme,
                                const Particles<Dim>& particles, double stiffness) {
    valid_range<Dim>(scheme.range, particles.spacing, particles.size());
    if (!(scheme.density > 0.0) || !std::isfinite(scheme.density))
        throw InputError(
            fmt::format("density: {} of the reference configuration must be positive; sqrt(4/3) m "
                        "is that of the triangular lattice",
                        scheme.density));
    if (!(scheme.penalty >= 0.0) || !std::isfinite(scheme.penalty))
        throw InputError(fmt::format("penalty: {} must be a number not below 0; try --penalty 0.1",
                                     scheme.penalty));
    if (scheme.penalty > 0.0 && !(stiffness > 0.0))
        throw InputError(
            fmt::format("penalty: {} is measured in the material's stiffness, which is {}; use "
                        "--penalty 0 or another material",
                        scheme.penalty, stiffness));
    return scheme;
}

}  // namespace

/// The material as the sweep calls it.
template <int Dim>
struct TotalLagrangian<Dim>::Stresses {
    const HyperelasticMaterial<Dim>& material;
    double* records;
    double t;
    const ConstState<Dim>& state;
    mutable std::atomic<bool> finite = true;

    static void call(const void* context, const SweptBlock& block) {
        const auto& self = *static_cast<const Stresses*>(context);
        const std::size_t count = block.count;
        double* const record = self.records + block.first_slot * stride<Dim>;
        double* const B = record + B_at<Dim>;
        if (!self.material.stresses({block.particle, count}, stride<Dim>, record + F_at<Dim>, B,
                                    self.state, self.t))
            self.finite = false;
        for (std::size_t k = 0; k < count * stride<Dim>; k += stride<Dim>) {
            const auto K = numbers_at<SymTensor<Dim>>(record + k + K_at<Dim>);
            const Mat<Dim> stress = numbers_at<Mat<Dim>>(B + k) * K;
            std::copy(stress.c.begin(), stress.c.end(), B + k);
        }
    }
};

template <int Dim>
TotalLagrangian<Dim>::~TotalLagrangian() = default;

template <int Dim>
TotalLagrangian<Dim>::TotalLagrangian(const Selection<Dim>& among,
                                      const HyperelasticMaterial<Dim>& material,
                                      const TotalLagrangianScheme& scheme)
    : Term<Dim>(among),
      material_(material.of(this->particles())),
      scheme_(validated(scheme, this->particles(), material.stiffness())),
      weight_(scheme.kernel, scheme.range),
      sweeps_(std::make_unique<const Sweeps<Dim>>(
          best_sweeps([&](auto level) { return lagrangian_sweeps<Dim, level>(scheme.kernel); }))),
      near_(scheme.range, ListUse::for_good, this->box(), sweeps_->width, sweeps_->numbers,
            StressedRecord<Dim>::kinds) {
    check_materials(this->particles(), material.count());
    if (material_.flows())
        throw InputError(fmt::format(
            "material: '{}' flows by changing what neighbours remember, and these never change; use a "
            "solid with a plastic metric, or --formulation material_vectors",
            material_.describe()));
    if (!this->particles().reference_position.allFinite())
        throw InputError("particles: a reference position is not finite");
    this->look_after(near_);
    near_.build(this->particles().reference_position);
    pack_reference();
    find_corrections();
    auto& nature = this->nature_;
    nature.description = fmt::format(
        "total Lagrangian, {}, density {:.6g}, {} weight of range {} between reference "
        "positions, penalty kappa = {}",
        material_.describe(), scheme_.density, to_string(scheme_.kernel), scheme_.range,
        scheme_.penalty);
    nature.fields = material_.history();
    if (!material_.keeps_energy()) nature.promises.energy = Promise::not_kept;
    nature.smooth = !material_.settles();
    nature.reach = scheme_.range;
}

template <int Dim>
SweepInput<Dim> TotalLagrangian<Dim>::input(const Neighbourhood<Dim>& near) const {
    SweepInput<Dim> in{near.list().view(), near.records(), scheme_.range, &weight_};
    in.constants.inverse_density = 1.0 / scheme_.density;
    in.constants.penalty = scheme_.penalty * material_.stiffness();
    return in;
}

/// What stays: X and V; and K = 1 to begin with.
template <int Dim>
void TotalLagrangian<Dim>::pack_reference() {
    using R = ReferenceRecord<Dim>;
    const double* const X = this->particles().reference_position.data();
    near_.template write<R>(0, R::numbers, [&](std::size_t i, double* record) {
        std::copy_n(X + Dim * i, Dim, record);
        std::copy_n(X + Dim * i, Dim, record + present_at<Dim>);
        std::fill_n(record + K_at<Dim>, Dim, 1.0);
        record[volume_at<Dim>] = this->particles().mass[i] / scheme_.density;
    });
}

/// K_i = [sum_j V_j (X_j - X_i) (x) grad_i W_ij]^-1, by the sweep that will multiply with it.
template <int Dim>
void TotalLagrangian<Dim>::find_corrections() {
    SweepOutput<Dim> out;
    out.records = near_.record(0);
    sweeps_->gradient(input(near_), out);
    for (std::size_t slot = 0; slot < near_.list().size(); ++slot) {
        double* const record = near_.record(slot);
        const Tensor<Dim> A = Eigen::Map<const Tensor<Dim>>(record + F_at<Dim>);
        SymTensor<Dim> moments;
        for (int a = 0; a < Dim; ++a)
            for (int b = a; b < Dim; ++b) moments(a, b) = A(b, a);
        const auto [least, most] = std::ranges::minmax(symmetric_eigen(moments).value.c);
        if (!(least > 1e-6 * most))
            throw InputError(fmt::format(
                "range: particle {} has too few neighbours within {} spacings for a deformation "
                "gradient; widen --range",
                this->particles().id[near_.list().order()[slot]],
                scheme_.range / this->particles().spacing));
        const Tensor<Dim> K = A.inverse();
        for (int a = 0; a < Dim; ++a)
            for (int b = a; b < Dim; ++b)
                record[K_at<Dim> + static_cast<std::size_t>(symmetric_index(Dim, a, b))] =
                    0.5 * (K(a, b) + K(b, a));
    }
    near_.template refresh<StressedRecord<Dim>>(K_at<Dim>);
}

/// The positions now, of the images that the list took of X.
template <int Dim>
void TotalLagrangian<Dim>::load(const ConstState<Dim>& state, Neighbourhood<Dim>& near) const {
    near.template write<StressedRecord<Dim>>(
        present_at<Dim>, Dim, [x = state.position().data()](std::size_t i, double* present) {
            std::copy_n(x + Dim * i, Dim, present);
        });
}

/// The order that the equations force: A, F, P and B = P K^t - the penalty, which takes M/V K^t off B - force.
template <int Dim>
std::string TotalLagrangian<Dim>::rates(const Now& now) {
    load(now.state, near_);
    const SweepInput<Dim> in = input(near_);
    SweepOutput<Dim> out;
    out.records = near_.record(0);
    out.v_dot = now.v_dot;
    const Stresses stresses{material_, near_.record(0), now.t, now.state};
    out.close = Stresses::call;
    out.context = &stresses;
    sweeps_->gradient(in, out);
    if (!stresses.finite) return complaint();
    if (material_.has_rates()) memory_rates(now);
    near_.template refresh<StressedRecord<Dim>>(F_at<Dim>);
    out.close = nullptr;
    if (scheme_.penalty > 0.0) {
        sweeps_->second(in, out);
        sweep_walls(near_, in, sweeps_->second);
    } else {
        std::fill_n(now.v_dot, Dim * this->particles().size(), 0.0);
        near_.for_each_wall([](BehindWall<Dim>& wall) { std::ranges::fill(wall.v_dot, 0.0); });
    }
    near_.template refresh<StressedRecord<Dim>>(B_at<Dim>);
    sweeps_->force(in, out);
    sweep_walls(near_, in, sweeps_->force);
    return {};
}

/// F is linear in the positions: F_dot = F(v).
template <int Dim>
void TotalLagrangian<Dim>::memory_rates(const Now& now) {
    if (!moving_) moving_ = std::make_unique<Neighbourhood<Dim>>(near_.for_observer());
    moving_->write(
        present_at<Dim>, Dim,
        [v = now.state.velocity().data()](std::size_t i, double* velocity) {
            std::copy_n(v + Dim * i, Dim, velocity);
        },
        moving_kinds<Dim>);
    SweepOutput<Dim> out;
    out.records = moving_->record(0);
    sweeps_->gradient(input(*moving_), out);
    const auto order = near_.list().order();
    for (const Field field : material_.history()) now.rate.field(field).setZero();
    // Without slots that only fill up a cluster: they have a particle's number, and no deformation.
    parallel_for(near_.list().size(), [&](std::size_t slot) {
        const Mat<Dim> F = numbers_at<Mat<Dim>>(near_.record(slot) + F_at<Dim>);
        material_.rates(now.t, order[slot], F,
                        numbers_at<Mat<Dim>>(moving_->record(slot) + F_at<Dim>), now.state,
                        now.rate);
    });
}

/// By the deformation gradients of the state that has been accepted.
template <int Dim>
bool TotalLagrangian<Dim>::settle(double t, const State<Dim>& state) {
    if (!material_.settles()) return false;
    load(ConstState<Dim>(state), near_);
    SweepOutput<Dim> out;
    out.records = near_.record(0);
    sweeps_->gradient(input(near_), out);
    return parallel_count(near_.list().size(), [&](std::size_t slot) -> std::size_t {
               const Mat<Dim> F = numbers_at<Mat<Dim>>(near_.record(slot) + F_at<Dim>);
               return material_.settle(t, near_.list().order()[slot], F, state) ? 1 : 0;
           }) > 0;
}

/// Names the first particle, in the order of the slots, whose stress has no meaning.
template <int Dim>
std::string TotalLagrangian<Dim>::complaint() const {
    const auto order = near_.list().order();
    const auto finite = [&](std::size_t slot, int at) {
        const double* const first = near_.record(slot) + at;
        return std::all_of(first, first + Dim * Dim, [](double x) { return std::isfinite(x); });
    };
    std::size_t slot = 0;
    while (slot + 1 < near_.list().size() && finite(slot, B_at<Dim>)) ++slot;
    return fmt::format("the {} of particle {} is not finite",
                       finite(slot, F_at<Dim>) ? "stress" : "deformation gradient",
                       this->particles().id[order[slot]]);
}

/// For observers: records of their own, so that those of the right-hand side stay as they are.
template <int Dim>
Neighbourhood<Dim> TotalLagrangian<Dim>::deformed(std::span<const double> y) const {
    Neighbourhood<Dim> own = near_.for_observer();
    load(this->state_of(y), own);
    SweepOutput<Dim> out;
    out.records = own.record(0);
    sweeps_->gradient(input(own), out);
    return own;
}

template <int Dim>
std::vector<Mat<Dim>> TotalLagrangian<Dim>::gradients(std::span<const double> y) const {
    const Neighbourhood<Dim> own = deformed(y);
    std::vector<Mat<Dim>> F(own.list().size());
    for (std::size_t slot = 0; slot < F.size(); ++slot)
        F[own.list().order()[slot]] = numbers_at<Mat<Dim>>(own.record(slot) + F_at<Dim>);
    return F;
}

template <int Dim>
double TotalLagrangian<Dim>::potential_energy(std::span<const double> y) const {
    const ConstState<Dim> state = this->state_of(y);
    Neighbourhood<Dim> own = deformed(y);
    std::vector<double> penalty(own.list().size(), 0.0);
    if (scheme_.penalty > 0.0) {
        own.template refresh<StressedRecord<Dim>>(F_at<Dim>);
        SweepOutput<Dim> out;
        out.energy = penalty.data();
        sweeps_->energy(input(own), out);
    }
    const auto [stored, of_penalty] = exact_sums(penalty.size(), [&](std::size_t slot) {
        const std::size_t i = own.list().order()[slot];
        const double* const record = own.record(slot);
        return std::array<double, 2>{
            record[volume_at<Dim>] *
                material_.energy(i, numbers_at<Mat<Dim>>(record + F_at<Dim>), state),
            penalty[i]};
    });
    return stored + of_penalty;
}

template <int Dim>
auto TotalLagrangian<Dim>::answer(Ask what, std::span<const double> y) const -> Answer {
    if (what == Ask::energy) return {potential_energy(y)};
    Answer found = Term<Dim>::answer(what, y);
    if (what != Ask::density && what != Ask::deformation) return found;
    found.deformation = gradients(y);
    if (what == Ask::density)
        for (const Mat<Dim>& F : found.deformation)
            found.density.push_back(scheme_.density /
                                    Eigen::Map<const Tensor<Dim>>(F.c.data()).determinant());
    return found;
}

SPAM_COMPILED(template class TotalLagrangian);

}  // namespace spam
