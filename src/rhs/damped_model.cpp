// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/sums.hpp>
#include <spam/rhs/damped_model.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {
namespace {

std::vector<Field> fields_of(const Model<2>& model) {
    std::vector<Field> fields;
    for (const auto& block : model.layout().blocks()) fields.push_back(block.field);
    return fields;
}

/// Rigid motion with the momentum and the angular momentum of the particles.
struct RigidRotation {
    Point<2> R, V;
    double omega;

    Point<2> velocity(const Point<2>& r) const {
        return V + omega * Point<2>(-(r.y() - R.y()), r.x() - R.x());
    }
};

template <class View>
Point<2> mean(const std::vector<double>& mass, const View& values) {
    CompensatedSum m, x, y;
    for (Eigen::Index i = 0; i < values.cols(); ++i) {
        const double m_i = mass[static_cast<std::size_t>(i)];
        m += m_i;
        x += m_i * values(0, i);
        y += m_i * values(1, i);
    }
    return Point<2>(x, y) / static_cast<double>(m);
}

template <class View>
RigidRotation rigid_rotation_of(const std::vector<double>& mass, const View& x, const View& v) {
    RigidRotation motion{mean(mass, x), mean(mass, v), 0.0};
    CompensatedSum L, I;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const double m = mass[static_cast<std::size_t>(i)];
        const Point<2> r = x.col(i) - motion.R, w = v.col(i) - motion.V;
        L += m * (r.x() * w.y() - r.y() * w.x());
        I += m * r.squaredNorm();
    }
    if (I > 0.0) motion.omega = L / I;
    return motion;
}

}  // namespace

DampedModel::DampedModel(std::unique_ptr<Model<2>> model, double gamma, Friction friction)
    : Model<2>(model->particles(), model->box(), fields_of(*model)),
      model_(std::move(model)),
      gamma_(gamma),
      friction_(friction) {
    if (!(gamma >= 0.0) || !std::isfinite(gamma))
        throw InputError(
            fmt::format("damping: {} must be a finite rate not below 0; 0.1 is usual", gamma));
}

void DampedModel::rates(double t, std::span<const double> y, std::span<double> y_dot) {
    model_->rates(t, y, y_dot);
    failure_ = model_->failure();
    const ConstState<2> state(layout(), y);
    const auto x = state.position(), v = state.velocity();
    auto v_dot = State<2>(layout(), y_dot).velocity();
    if (friction_ == Friction::all_motion) {
        v_dot -= gamma_ * v;
        return;
    }
    const RigidRotation motion = rigid_rotation_of(particles().mass, x, v);
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        v_dot.col(i) -= gamma_ * (v.col(i) - motion.velocity(x.col(i)));
}

double DampedModel::internal_energy(std::span<const double> y) const {
    return model_->internal_energy(y);
}

std::vector<double> DampedModel::density(std::span<const double> y) const {
    return model_->density(y);
}

Promises DampedModel::promises() const {
    Promises promises = model_->promises();
    if (gamma_ > 0.0) promises.energy = Promise::not_kept;
    if (gamma_ > 0.0 && friction_ == Friction::all_motion)
        promises.momentum = promises.angular_momentum = Promise::not_kept;
    return promises;
}

std::string DampedModel::describe() const {
    return fmt::format(
        "{}; friction gamma = {:g} of {}", model_->describe(), gamma_,
        friction_ == Friction::all_motion ? "all motion" : "what is not rigid motion");
}

void DampedModel::remember(Archive& archive) {
    Model<2>::remember(archive);
    model_->remember(archive);
}

void DampedModel::set_bodies(std::vector<std::int32_t> bodies) {
    model_->set_bodies(bodies);
    Model<2>::set_bodies(std::move(bodies));
}

}  // namespace spam
