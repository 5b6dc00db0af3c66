// SPDX-License-Identifier: GPL-3.0-or-later
#include "packed_particles.hpp"
#include "term_sweeps.hpp"
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/core/parallel.hpp>
#include <spam/physics/lagrangian_record.hpp>
#include <spam/rhs/total_lagrangian.hpp>

#include <Eigen/Eigenvalues>
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
constexpr std::size_t present_at = StressedRecord<Dim>::template at<column::Present>;
template <int Dim>
constexpr std::size_t volume_at = StressedRecord<Dim>::template at<column::Volume>;
template <int Dim>
constexpr std::size_t K_at = StressedRecord<Dim>::template at<column::Correction>;
template <int Dim>
constexpr std::size_t F_at = StressedRecord<Dim>::template at<column::Deformation>;
template <int Dim>
constexpr std::size_t B_at = StressedRecord<Dim>::template at<column::ReferenceStress>;

/// Of records that hold velocities in place of present positions: images have the same.
template <int Dim>
constexpr auto moving_kinds = [] {
    auto kinds = StressedRecord<Dim>::kinds;
    for (std::size_t a = 0; a < Dim; ++a) kinds[present_at<Dim> + a].quantity = Quantity::velocity;
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

template <int Dim>
Mat<Dim> tensor_at(const double* numbers) {
    Mat<Dim> t;
    std::copy(numbers, numbers + Dim * Dim, t.c.begin());
    return t;
}

}  // namespace

/// The material as the sweep calls it.
template <int Dim>
struct TotalLagrangian<Dim>::Stresses {
    const HyperelasticMaterial<Dim>& material;
    std::vector<double>& records;
    const ConstState<Dim>& state;
    mutable std::atomic<bool> finite = true;

    static void call(const void* context, const SweptBlock& block) {
        const auto& self = *static_cast<const Stresses*>(context);
        const std::size_t count = block.count;
        double* const record = self.records.data() + block.first_slot * stride<Dim>;
        double* const B = record + B_at<Dim>;
        if (!self.material.stresses({block.particle, count}, stride<Dim>, record + F_at<Dim>, B,
                                    self.state))
            self.finite = false;
        for (std::size_t k = 0; k < count * stride<Dim>; k += stride<Dim>) {
            SymTensor<Dim> K;
            std::copy_n(record + k + K_at<Dim>, K.c.size(), K.c.begin());
            const Mat<Dim> stress = tensor_at<Dim>(B + k) * K;
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
      material_(material),
      scheme_(validated(scheme, this->particles(), material.stiffness())),
      sweeps_(std::make_unique<const Sweeps<Dim>>(
          best_sweeps([](auto level) { return lagrangian_sweeps<Dim, level>(); }))),
      list_(scheme.range, 0.0, this->box().of_images(), sweeps_->width, stride<Dim>) {
    if (material_.flows())
        throw InputError(fmt::format(
            "material: '{}' flows by changing what neighbours remember, and these never change; use a "
            "solid with a plastic metric, or --formulation material_vectors",
            material_.describe()));
    if (!this->particles().reference_position.allFinite())
        throw InputError("particles: a reference position is not finite");
    list_.build(this->particles().reference_position);
    pack_reference();
    find_corrections();
}

template <int Dim>
SweepInput<Dim> TotalLagrangian<Dim>::input(const std::vector<double>& records) const {
    SweepInput<Dim> in{list_.view(), {records.data(), stride<Dim>}, scheme_.range};
    in.constants.inverse_density = 1.0 / scheme_.density;
    in.constants.penalty = scheme_.penalty * material_.stiffness();
    return in;
}

/// What stays: X and V; and K = 1 to begin with.
template <int Dim>
void TotalLagrangian<Dim>::pack_reference() {
    const auto order = list_.order();
    const Home<Dim> home = list_.home();
    records_.assign(list_.slots() * stride<Dim>, 0.0);
    for (std::size_t slot = 0; slot < order.size(); ++slot) {
        double* const record = &records_[slot * stride<Dim>];
        for (std::size_t a = 0; a < Dim; ++a) {
            const double X = this->particles().reference_position.data()[Dim * order[slot] + a];
            record[a] = record[present_at<Dim> + a] = home(order[slot], a, X);
            record[K_at<Dim> + a] = 1.0;
        }
        record[volume_at<Dim>] = this->particles().mass[order[slot]] / scheme_.density;
    }
    refresh(records_, 0);
}

/// K_i = [sum_j V_j (X_j - X_i) (x) grad_i W_ij]^-1, by the sweep that will multiply with it.
template <int Dim>
void TotalLagrangian<Dim>::find_corrections() {
    SweepOutput<Dim> out;
    out.records = records_.data();
    sweeps_->gradient(input(records_), out);
    for (std::size_t slot = 0; slot < list_.size(); ++slot) {
        double* const record = &records_[slot * stride<Dim>];
        const Tensor<Dim> A = Eigen::Map<const Tensor<Dim>>(record + F_at<Dim>);
        Eigen::SelfAdjointEigenSolver<Tensor<Dim>> modes;
        modes.computeDirect(A, Eigen::EigenvaluesOnly);  // good to 1e-8 of the largest
        const auto& strength = modes.eigenvalues();
        if (!(strength[0] > 1e-6 * strength[Dim - 1]))
            throw InputError(fmt::format(
                "range: particle {} has too few neighbours within {} spacings for a deformation "
                "gradient; widen --range",
                this->particles().id[list_.order()[slot]],
                scheme_.range / this->particles().spacing));
        const Tensor<Dim> K = A.inverse();
        for (int a = 0; a < Dim; ++a)
            for (int b = a; b < Dim; ++b)
                record[K_at<Dim> + static_cast<std::size_t>(symmetric_index(Dim, a, b))] =
                    0.5 * (K(a, b) + K(b, a));
    }
    refresh(records_, K_at<Dim>);
}

template <int Dim>
void TotalLagrangian<Dim>::refresh(std::vector<double>& records, std::size_t from) const {
    list_.refresh(records.data(), StressedRecord<Dim>::kinds, from);
}

/// The positions now, of the images that the list took of X.
template <int Dim>
void TotalLagrangian<Dim>::load(const ConstState<Dim>& state, std::vector<double>& records) const {
    const double* const x = state.position().data();
    const auto order = list_.order();
    const Home<Dim> home = list_.home();
    parallel_for(order.size(), [&](std::size_t slot) {
        double* const present = &records[slot * stride<Dim> + present_at<Dim>];
        for (std::size_t a = 0; a < Dim; ++a)
            present[a] = home(order[slot], a, x[order[slot] * Dim + a]);
    });
    refresh(records, present_at<Dim>);
}

/// The order that the equations force: A, F, P and B = P K^t - the penalty, which takes M/V K^t off B - force.
template <int Dim>
std::string TotalLagrangian<Dim>::rates(const Now& now) {
    load(now.state, records_);
    const SweepInput<Dim> in = input(records_);
    SweepOutput<Dim> out;
    out.records = records_.data();
    out.v_dot = now.v_dot;
    const Stresses stresses{material_, records_, now.state};
    out.close = Stresses::call;
    out.context = &stresses;
    sweeps_->gradient(in, out);
    if (!stresses.finite) return complaint();
    if (material_.has_rates()) memory_rates(now);
    refresh(records_, F_at<Dim>);
    out.close = nullptr;
    if (scheme_.penalty > 0.0)
        sweeps_->second(in, out);
    else
        std::fill_n(now.v_dot, Dim * this->particles().size(), 0.0);
    refresh(records_, B_at<Dim>);
    sweeps_->force(in, out);
    return {};
}

/// F is linear in the positions: F_dot = F(v).
template <int Dim>
void TotalLagrangian<Dim>::memory_rates(const Now& now) {
    moving_ = records_;
    const double* const v = now.state.velocity().data();
    const auto order = list_.order();
    parallel_for(order.size(), [&](std::size_t slot) {
        std::copy_n(v + order[slot] * Dim, Dim, &moving_[slot * stride<Dim> + present_at<Dim>]);
    });
    list_.refresh(moving_.data(), moving_kinds<Dim>, present_at<Dim>);
    SweepOutput<Dim> out;
    out.records = moving_.data();
    sweeps_->gradient(input(moving_), out);
    for (const Field field : material_.history()) now.rate.field(field).setZero();
    parallel_for(order.size(), [&](std::size_t slot) {
        const std::size_t at = slot * stride<Dim> + F_at<Dim>;
        const Mat<Dim> F = tensor_at<Dim>(&records_[at]);
        material_.rates(order[slot], F, tensor_at<Dim>(&moving_[at]), now.state, now.rate);
    });
}

/// By the deformation gradients of the state that has been accepted.
template <int Dim>
bool TotalLagrangian<Dim>::settle(double, const State<Dim>& state) {
    if (material_.history().empty() || material_.has_rates()) return false;
    load(ConstState<Dim>(state), records_);
    SweepOutput<Dim> out;
    out.records = records_.data();
    sweeps_->gradient(input(records_), out);
    return parallel_count(list_.size(), [&](std::size_t slot) -> std::size_t {
               const Mat<Dim> F = tensor_at<Dim>(&records_[slot * stride<Dim> + F_at<Dim>]);
               return material_.settle(list_.order()[slot], F, state) ? 1 : 0;
           }) > 0;
}

/// Names the first particle, in the order of the slots, whose stress has no meaning.
template <int Dim>
std::string TotalLagrangian<Dim>::complaint() const {
    const auto order = list_.order();
    const auto finite = [&](std::size_t slot, std::size_t at) {
        const double* const first = &records_[slot * stride<Dim> + at];
        return std::all_of(first, first + Dim * Dim, [](double x) { return std::isfinite(x); });
    };
    std::size_t slot = 0;
    while (slot + 1 < list_.size() && finite(slot, B_at<Dim>)) ++slot;
    return fmt::format("the {} of particle {} is not finite",
                       finite(slot, F_at<Dim>) ? "stress" : "deformation gradient",
                       this->particles().id[order[slot]]);
}

/// For observers: records of their own, so that those of the right-hand side stay as they are.
template <int Dim>
std::vector<double> TotalLagrangian<Dim>::deformed(std::span<const double> y) const {
    std::vector<double> records = records_;
    load(this->state_of(y), records);
    SweepOutput<Dim> out;
    out.records = records.data();
    sweeps_->gradient(input(records), out);
    return records;
}

template <int Dim>
std::vector<Mat<Dim>> TotalLagrangian<Dim>::deformation_gradients(std::span<const double> y) const {
    const std::vector<double> records = deformed(y);
    std::vector<Mat<Dim>> F(list_.size());
    for (std::size_t slot = 0; slot < F.size(); ++slot)
        F[list_.order()[slot]] = tensor_at<Dim>(&records[slot * stride<Dim> + F_at<Dim>]);
    return F;
}

template <int Dim>
std::vector<double> TotalLagrangian<Dim>::density(std::span<const double> y) const {
    std::vector<double> rho;
    for (const Mat<Dim>& F : deformation_gradients(y))
        rho.push_back(scheme_.density / Eigen::Map<const Tensor<Dim>>(F.c.data()).determinant());
    return rho;
}

template <int Dim>
double TotalLagrangian<Dim>::energy(std::span<const double> y) const {
    const ConstState<Dim> state = this->state_of(y);
    std::vector<double> records = deformed(y);
    std::vector<double> penalty(list_.size(), 0.0);
    if (scheme_.penalty > 0.0) {
        refresh(records, F_at<Dim>);
        SweepOutput<Dim> out;
        out.energy = penalty.data();
        sweeps_->energy(input(records), out);
    }
    const auto [stored, of_penalty] = exact_sums(list_.size(), [&](std::size_t slot) {
        const std::size_t i = list_.order()[slot];
        const double* const record = &records[slot * stride<Dim>];
        return std::array<double, 2>{
            record[volume_at<Dim>] * material_.energy(i, tensor_at<Dim>(record + F_at<Dim>), state),
            penalty[i]};
    });
    return stored + of_penalty;
}

template <int Dim>
std::string TotalLagrangian<Dim>::describe() const {
    return fmt::format(
        "total Lagrangian, {}, density {:.6g}, lucy weight of range {} between reference "
        "positions, penalty kappa = {}",
        material_.describe(), scheme_.density, scheme_.range, scheme_.penalty);
}

template class TotalLagrangian<1>;
template class TotalLagrangian<2>;
template class TotalLagrangian<3>;

}  // namespace spam
