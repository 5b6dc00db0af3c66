// SPDX-License-Identifier: GPL-3.0-or-later
#include "../core/levels.hpp"
#include "lagrangian_sweeps.hpp"
#include "packed_particles.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/sums.hpp>
#include <spam/physics/lagrangian_record.hpp>
#include <spam/rhs/total_lagrangian_model.hpp>

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
constexpr std::size_t present_at = StressedRecord<Dim>::present_at;
template <int Dim>
constexpr std::size_t volume_at = StressedRecord<Dim>::volume_at;
template <int Dim>
constexpr std::size_t K_at = StressedRecord<Dim>::K_at;
template <int Dim>
constexpr std::size_t F_at = StressedRecord<Dim>::F_at;
template <int Dim>
constexpr std::size_t B_at = StressedRecord<Dim>::B_at;

template <int Dim>
using Tensor = Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>;

template <int Dim>
LagrangianSweeps<Dim> best_sweeps() {
    return at_level(instruction_set(), [](auto level) { return lagrangian_sweeps<Dim, level>(); });
}

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
struct TotalLagrangianModel<Dim>::Stresses {
    const HyperelasticMaterial<Dim>& material;
    std::vector<double>& records;
    bool penalised;  ///< the sweep of the penalty makes B of P
    std::atomic<bool> finite = true;

    static void call(void* context, std::size_t first_slot, std::size_t count) {
        auto& self = *static_cast<Stresses*>(context);
        double* const record = self.records.data() + first_slot * stride<Dim>;
        double* const B = record + B_at<Dim>;
        if (!self.material.stresses(count, stride<Dim>, record + F_at<Dim>, B)) self.finite = false;
        if (self.penalised) return;
        for (std::size_t k = 0; k < count * stride<Dim>; k += stride<Dim>) {
            SymTensor<Dim> K;
            std::copy_n(record + k + K_at<Dim>, K.c.size(), K.c.begin());
            const Mat<Dim> stress = tensor_at<Dim>(B + k) * K;
            std::copy(stress.c.begin(), stress.c.end(), B + k);
        }
    }
};

template <int Dim>
TotalLagrangianModel<Dim>::~TotalLagrangianModel() = default;

template <int Dim>
TotalLagrangianModel<Dim>::TotalLagrangianModel(Particles<Dim> particles,
                                                const HyperelasticMaterial<Dim>& material,
                                                const TotalLagrangianScheme& scheme,
                                                const Box<Dim>& box)
    : ParticleModel<Dim>(std::move(particles), box, {Field::position, Field::velocity}),
      material_(material),
      scheme_(validated(scheme, this->particles(), material.stiffness())),
      sweeps_(std::make_unique<const LagrangianSweeps<Dim>>(best_sweeps<Dim>())),
      list_(scheme.range, 0.0, box, sweeps_->width, stride<Dim>) {
    if (!this->particles().reference_position.allFinite())
        throw InputError("particles: a reference position is not finite");
    list_.build(this->particles().reference_position);
    pack_reference();
    find_corrections();
}

template <int Dim>
SweepInput<Dim> TotalLagrangianModel<Dim>::input(const std::vector<double>& records) const {
    return {list_.view(), {records.data(), stride<Dim>}, scheme_.range, &this->box()};
}

/// What stays: X and V; and K = 1 to begin with.
template <int Dim>
void TotalLagrangianModel<Dim>::pack_reference() {
    const auto order = list_.order();
    records_.assign(order.size() * stride<Dim>, 0.0);
    for (std::size_t slot = 0; slot < order.size(); ++slot) {
        double* const record = &records_[slot * stride<Dim>];
        for (std::size_t a = 0; a < Dim; ++a) {
            const double X = this->particles().reference_position.data()[Dim * order[slot] + a];
            record[a] = record[present_at<Dim> + a] = this->box().wrap(static_cast<int>(a), X);
            record[K_at<Dim> + a] = 1.0;
        }
        record[volume_at<Dim>] = this->particles().mass[order[slot]] / scheme_.density;
    }
}

/// K_i = [sum_j V_j (X_j - X_i) (x) grad_i W_ij]^-1, by the sweep that will multiply with it.
template <int Dim>
void TotalLagrangianModel<Dim>::find_corrections() {
    LagrangianOutput<Dim> out{records_.data()};
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
}

/// The positions now, moved by the periods that wrapping took off X.
template <int Dim>
void TotalLagrangianModel<Dim>::load(std::span<const double> y,
                                     std::vector<double>& records) const {
    constexpr auto d = static_cast<std::size_t>(Dim);
    const double* const x = ConstState<Dim>(this->layout(), y).position().data();
    const double* const X = this->particles().reference_position.data();
    const auto order = list_.order();
    parallel_for(order.size(), [&](std::size_t slot) {
        double* const record = &records[slot * stride<Dim>];
        for (std::size_t a = 0; a < d; ++a) {
            const std::size_t k = order[slot] * d + a;
            record[present_at<Dim> + a] = x[k] - (X[k] - record[a]);
        }
    });
}

/// The order that the equations force: A, F, P - penalty and M, B - force.
template <int Dim>
void TotalLagrangianModel<Dim>::pair_rates(double, std::span<const double> y,
                                           std::span<double> y_dot) {
    this->failure_.clear();
    const State<Dim> rate(this->layout(), y_dot);
    load(y, records_);
    rate.position() = ConstState<Dim>(this->layout(), y).velocity();

    const SweepInput<Dim> in = input(records_);
    LagrangianOutput<Dim> out{records_.data()};
    out.v_dot = rate.velocity().data();
    out.inverse_density = 1.0 / scheme_.density;
    out.penalty = scheme_.penalty * material_.stiffness();
    Stresses stresses{material_, records_, scheme_.penalty > 0.0};
    out.stresses = Stresses::call;
    out.context = &stresses;
    sweeps_->gradient(in, out);
    if (!stresses.finite) {
        fail_stress(y_dot);
        return;
    }
    if (stresses.penalised)
        sweeps_->penalty(in, out);
    else
        rate.velocity().setZero();
    sweeps_->force(in, out);
}

/// Names the first particle, in the order of the slots, whose stress has no meaning.
template <int Dim>
void TotalLagrangianModel<Dim>::fail_stress(std::span<double> y_dot) {
    const auto order = list_.order();
    const auto finite = [&](std::size_t slot, std::size_t at) {
        const double* const first = &records_[slot * stride<Dim> + at];
        return std::all_of(first, first + Dim * Dim, [](double x) { return std::isfinite(x); });
    };
    std::size_t slot = 0;
    while (slot + 1 < list_.size() && finite(slot, B_at<Dim>)) ++slot;
    this->fail(y_dot, fmt::format("the {} of particle {} is not finite",
                                  finite(slot, F_at<Dim>) ? "stress" : "deformation gradient",
                                  this->particles().id[order[slot]]));
}

/// For observers: records of their own, so that those of the right-hand side stay as they are.
template <int Dim>
std::vector<double> TotalLagrangianModel<Dim>::deformed(std::span<const double> y) const {
    std::vector<double> records = records_;
    load(y, records);
    sweeps_->gradient(input(records), {records.data()});
    return records;
}

template <int Dim>
std::vector<Mat<Dim>> TotalLagrangianModel<Dim>::deformation_gradients(
    std::span<const double> y) const {
    const std::vector<double> records = deformed(y);
    std::vector<Mat<Dim>> F(list_.size());
    for (std::size_t slot = 0; slot < F.size(); ++slot)
        F[list_.order()[slot]] = tensor_at<Dim>(&records[slot * stride<Dim> + F_at<Dim>]);
    return F;
}

template <int Dim>
std::vector<double> TotalLagrangianModel<Dim>::pair_density(std::span<const double> y) const {
    std::vector<double> rho;
    for (const Mat<Dim>& F : deformation_gradients(y))
        rho.push_back(scheme_.density / Eigen::Map<const Tensor<Dim>>(F.c.data()).determinant());
    return rho;
}

template <int Dim>
double TotalLagrangianModel<Dim>::pair_energy(std::span<const double> y) const {
    std::vector<double> records = deformed(y);
    std::vector<double> penalty(list_.size(), 0.0);
    if (scheme_.penalty > 0.0) {
        LagrangianOutput<Dim> out{records.data()};
        out.energy = penalty.data();
        out.penalty = scheme_.penalty * material_.stiffness();
        sweeps_->energy(input(records), out);
    }
    CompensatedSum sum;
    for (std::size_t slot = 0; slot < list_.size(); ++slot) {
        const double* const record = &records[slot * stride<Dim>];
        sum += record[volume_at<Dim>] * material_.energy(tensor_at<Dim>(record + F_at<Dim>));
        sum += penalty[list_.order()[slot]];
    }
    return sum;
}

template <int Dim>
Promises TotalLagrangianModel<Dim>::pair_promises() const {
    Promises p;
    p.angular_momentum = Promise::integrator_error;
    return this->in_box(p);
}

template <int Dim>
std::string TotalLagrangianModel<Dim>::pair_description() const {
    return fmt::format(
        "total Lagrangian, {}, density {:.6g}, lucy weight of range {} between reference "
        "positions, penalty kappa = {}",
        material_.describe(), scheme_.density, scheme_.range, scheme_.penalty);
}

template class TotalLagrangianModel<1>;
template class TotalLagrangianModel<2>;
template class TotalLagrangianModel<3>;

}  // namespace spam
