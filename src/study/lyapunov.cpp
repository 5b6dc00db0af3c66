// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/integrate/interrupt.hpp>
#include <spam/study/lyapunov.hpp>

#include <Eigen/QR>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace spam {
namespace {

template <int Dim>
std::size_t size_without_accounts(const Model<Dim>& model) {
    std::size_t size = 0;
    for (const auto& block : model.layout().blocks())
        if (block.field.role() != Role::account) size += block.size;
    return size;
}

template <int Dim>
void refuse_tangents(Model<Dim>& model, const IntegratorOptions& options) {
    if (options.adaptive())
        throw InputError(
            "integrator: the steps of an adaptive method would depend on the tangents; give a fixed step, --dt");
    if (options.method.starts_with("cvode:"))
        throw InputError(fmt::format(
            "integrator: {} goes on from earlier steps, and tangents that are orthogonalised have none; use rk4, "
            "leapfrog or a fixed step of another method",
            options.method));
    if (model.settles())
        throw InputError(
            "lyapunov: particles are changed after steps (a material that yields or breaks, bonds that come and go, a wall "
            "that reflects), where tangents jump; use an elastic solid of fixed neighbours or smooth particles, and "
            "periods in place of walls");
    if (!model.smooth())
        throw InputError(
            "lyapunov: these rates jump (balanced torques of particles, Gauss' principle), and tangents with them; use "
            "torques of pairs, or none that are balanced");
    if (!model.events().empty())
        throw InputError(
            "lyapunov: tangents jump where particles are reflected; leave reflections out");
}

}  // namespace

template <int Dim>
template <class Visit>
void TangentMotion<Dim>::each_block(const Visit& visit) const {
    for (const auto& block : model_.layout().blocks())
        if (block.field.role() != Role::account) visit(block.offset, block.size);
}

/// From blocks of y and its tangents to y and tangents, and back.
template <int Dim>
void TangentMotion<Dim>::rates(double t, std::span<const double> from, std::span<double> to) {
    const std::size_t each = 1 + count_, n = tangent_.size();
    each_block([&](std::size_t offset, std::size_t size) {
        std::copy_n(&from[each * offset], size, &y_[offset]);
    });
    const std::size_t accounts = y_.size() - n;
    std::copy_n(from.end() - static_cast<std::ptrdiff_t>(accounts), accounts,
                y_.end() - static_cast<std::ptrdiff_t>(accounts));
    model_.rates(t, y_, y_dot_);
    evaluations_ += 1 + 2 * count_;
    each_block([&](std::size_t offset, std::size_t size) {
        std::copy_n(&y_dot_[offset], size, &to[each * offset]);
    });
    std::copy_n(y_dot_.end() - static_cast<std::ptrdiff_t>(accounts), accounts,
                to.end() - static_cast<std::ptrdiff_t>(accounts));
    if (!model_.failure().empty()) return std::fill(to.begin(), to.end(), y_dot_.front());
    for (std::size_t m = 1; m < each; ++m) {
        each_block([&](std::size_t offset, std::size_t size) {
            std::copy_n(&from[each * offset + m * size], size, &tangent_[offset]);
        });
        model_.tangent(t, y_, tangent_, tangent_dot_);
        each_block([&](std::size_t offset, std::size_t size) {
            std::copy_n(&tangent_dot_[offset], size, &to[each * offset + m * size]);
        });
    }
}

template <int Dim>
TangentMotion<Dim>::TangentMotion(Model<Dim>& model, std::span<const double> y0,
                                  const Eigen::MatrixXd& tangents, const IntegratorOptions& options,
                                  double t0)
    : model_(model),
      count_(static_cast<std::size_t>(tangents.cols())),
      y_(y0.begin(), y0.end()),
      y_dot_(y0.size()),
      tangent_(size_without_accounts(model)),
      tangent_dot_(tangent_.size()) {
    refuse_tangents(model, options);
    const std::size_t each = 1 + count_, accounts = y0.size() - tangent_.size();
    state_ = std::make_unique<Vector>(each * tangent_.size() + accounts, context_);
    ode_.rates = [this](double t, std::span<const double> y, std::span<double> y_dot) {
        rates(t, y, y_dot);
    };
    ode_.failure = [this] { return model_.failure(); };
    ode_.entry_name = [](std::size_t k) {
        return fmt::format("number {} of y and its tangents", k);
    };
    ode_.time_scale = model.time_scale();
    ode_.inseparable = model.inseparable();
    ode_.accounts = accounts;
    for (const auto& block : model.layout().blocks())
        if (block.field.role() != Role::account)
            ode_.blocks.push_back(
                {std::string(block.field.name()), each * block.offset, each * block.size});
    ode_.absolute_tolerance.assign(state_->span().size(),
                                   1.0);  // GSL wants some with fixed steps too
    each_block([&](std::size_t offset, std::size_t size) {
        std::copy_n(&y0[offset], size, &state_->span()[each * offset]);
    });
    std::copy_n(y0.end() - static_cast<std::ptrdiff_t>(accounts), accounts,
                state_->span().end() - static_cast<std::ptrdiff_t>(accounts));
    integrator_ = make_integrator(options, ode_, *state_, t0, context_);
    set_tangents(tangents);
}

template <int Dim>
void TangentMotion<Dim>::advance_to(double t) {
    while (integrator_->t() < t) {
        InterruptWatch::check();
        integrator_->step(t);
    }
}

template <int Dim>
std::vector<double> TangentMotion<Dim>::y() const {
    std::vector<double> y = y_;
    each_block([&](std::size_t offset, std::size_t size) {
        std::copy_n(&std::as_const(*state_).span()[(1 + count_) * offset], size, &y[offset]);
    });
    return y;
}

template <int Dim>
Eigen::MatrixXd TangentMotion<Dim>::tangents() const {
    Eigen::MatrixXd all(static_cast<Eigen::Index>(tangent_.size()),
                        static_cast<Eigen::Index>(count_));
    each_block([&](std::size_t offset, std::size_t size) {
        for (std::size_t m = 0; m < count_; ++m)
            std::copy_n(&std::as_const(*state_).span()[(1 + count_) * offset + (m + 1) * size],
                        size,
                        &all(static_cast<Eigen::Index>(offset), static_cast<Eigen::Index>(m)));
    });
    return all;
}

template <int Dim>
void TangentMotion<Dim>::set_tangents(const Eigen::MatrixXd& tangents) {
    each_block([&](std::size_t offset, std::size_t size) {
        for (std::size_t m = 0; m < count_; ++m)
            std::copy_n(&tangents(static_cast<Eigen::Index>(offset), static_cast<Eigen::Index>(m)),
                        size, &state_->span()[(1 + count_) * offset + (m + 1) * size]);
    });
    integrator_->reset(integrator_->t());
}

template <int Dim>
std::vector<double> shares(const Model<Dim>& model, std::span<const double> tangent) {
    std::vector<double> whole(tangent.begin(), tangent.end());
    whole.resize(model.layout().size(), 0.0);  // accounts have none
    const ConstState<Dim> at(model.layout(), whole);
    const Eigen::RowVectorXd squares =
        at.position().colwise().squaredNorm() + at.velocity().colwise().squaredNorm();
    return {squares.begin(), squares.end()};
}

template <int Dim>
void require_spectrum(Model<Dim>& model, const IntegratorOptions& integrator,
                      std::size_t exponents) {
    constexpr std::size_t most = 2000;
    const std::size_t n = size_without_accounts(model);
    if (exponents > most)
        throw InputError(fmt::format(
            "exponents: {} tangents of {} numbers are too many, {} are allowed; give fewer, "
            "--exponents M: the M largest",
            exponents, n, most));
    if (exponents < 1 || exponents > n)
        throw InputError(
            fmt::format("exponents: {} must be between 1 and {}, the numbers in y", exponents, n));
    refuse_tangents(model, integrator);
}

template <int Dim>
LyapunovSpectrum lyapunov_spectrum(Model<Dim>& model, std::span<const double> y0,
                                   const IntegratorOptions& integrator,
                                   const LyapunovOptions& options) {
    if (!(options.duration > 0.0) || !(options.interval > 0.0) ||
        !(options.discarded >= 0.0 && options.discarded < 1.0))
        throw InputError(fmt::format(
            "lyapunov: duration {:g} and interval {:g} must be above 0, and the part {:g} that is discarded from 0 to "
            "less than 1",
            options.duration, options.interval, options.discarded));
    const auto n = static_cast<Eigen::Index>(size_without_accounts(model));
    const auto M = static_cast<Eigen::Index>(options.exponents);
    require_spectrum(model, integrator, options.exponents);
    Eigen::VectorXd scale(n);
    for (const auto& block : model.layout().blocks())
        if (block.field.role() != Role::account)
            scale
                .segment(static_cast<Eigen::Index>(block.offset),
                         static_cast<Eigen::Index>(block.size))
                .setConstant(block.scale);

    // Orthonormal by the scales; what each has grown by is on the diagonal of R.
    Eigen::VectorXd growth(M);
    const auto orthonormal = [&](const Eigen::MatrixXd& V) -> Eigen::MatrixXd {
        const Eigen::HouseholderQR<Eigen::MatrixXd> qr(scale.cwiseInverse().asDiagonal() * V);
        growth = qr.matrixQR().diagonal().head(M).array().abs().log();
        return scale.asDiagonal() * (qr.householderQ() * Eigen::MatrixXd::Identity(n, M));
    };
    std::mt19937 random(options.seed);
    std::normal_distribution<double> normal;
    Eigen::MatrixXd V(n, M);
    for (double& number : V.reshaped()) number = normal(random);
    TangentMotion<Dim> motion(model, y0, orthonormal(scale.asDiagonal() * V), integrator);

    // Ten at least behind what is discarded: the errors come from ten blocks.
    const auto intervals =
        static_cast<std::size_t>(std::max({20.0, std::ceil(10.0 / (1.0 - options.discarded)) + 1.0,
                                           std::round(options.duration / options.interval)}));
    const double interval = options.duration / static_cast<double>(intervals);
    const std::size_t first = static_cast<std::size_t>(options.discarded * double(intervals));
    const double window = options.window > 0.0 ? options.window : options.duration / 40.0;
    const auto per_window =
        std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(window / interval)));
    LyapunovSpectrum found;
    Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(M, 10);
    Eigen::VectorXd in_window = Eigen::VectorXd::Zero(M), block_time = Eigen::VectorXd::Zero(10);
    ExactSum trace;
    double window_began = 0.0;
    for (std::size_t k = 0; k < intervals; ++k) {
        const double before = motion.t();
        motion.advance_to(options.duration * static_cast<double>(k + 1) /
                          static_cast<double>(intervals));
        V = orthonormal(motion.tangents());
        motion.set_tangents(V);
        in_window += growth;
        if ((k + 1) % per_window == 0 || k + 1 == intervals) {
            const Eigen::VectorXd rate = in_window / (motion.t() - window_began);
            found.windows.push_back({motion.t(), {rate.begin(), rate.end()}});
            if (options.at_window) {
                const Eigen::VectorXd leading = V.col(0).cwiseQuotient(scale);
                options.at_window(motion.t(), motion.y(), {leading.data(), std::size_t(n)});
            }
            in_window.setZero();
            window_began = motion.t();
        }
        if (k < first) continue;
        const auto block = static_cast<Eigen::Index>(10 * (k - first) / (intervals - first));
        blocks.col(block) += growth;
        block_time[block] += motion.t() - before;
        if (M < n) continue;
        // V is a whole basis: its trace is that of J.
        const auto y = motion.y();
        std::vector<double> Jv(static_cast<std::size_t>(n));
        for (Eigen::Index m = 0; m < n; ++m) {
            model.tangent(motion.t(), y, {V.col(m).data(), Jv.size()}, Jv);
            for (Eigen::Index a = 0; a < n; ++a)
                trace += V(a, m) / (scale[a] * scale[a]) * Jv[static_cast<std::size_t>(a)];
        }
    }
    for (Eigen::Index m = 0; m < M; ++m) {
        const Eigen::ArrayXd rates = blocks.row(m).transpose().array() / block_time.array();
        const double mean = blocks.row(m).sum() / block_time.sum();
        found.exponents.push_back(mean);
        found.errors.push_back(std::sqrt((rates - mean).square().mean() / 9.0));
    }
    if (M == n) found.trace = static_cast<double>(trace) / static_cast<double>(intervals - first);
    found.y = motion.y();
    found.rhs_evaluations = motion.rhs_evaluations();
    return found;
}

SPAM_COMPILED(template class TangentMotion);
#define SPAM_INSTANTIATE_SPECTRUM(D)                                                     \
    template void require_spectrum<D>(Model<D>&, const IntegratorOptions&, std::size_t); \
    template std::vector<double> shares<D>(const Model<D>&, std::span<const double>);    \
    template LyapunovSpectrum lyapunov_spectrum<D>(                                      \
        Model<D>&, std::span<const double>, const IntegratorOptions&, const LyapunovOptions&);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE_SPECTRUM)

}  // namespace spam
