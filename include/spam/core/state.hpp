// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/field_layout.hpp>

#include <Eigen/Core>

#include <cassert>
#include <span>
#include <type_traits>

namespace spam {

/// Positions, velocities, ... of many particles: Dim x particles, column-major.
template <int Dim>
using Points = Eigen::Matrix<double, Dim, Eigen::Dynamic>;

/// One small Eigen vector, at the boundary between fields and pair sums.
template <int Dim>
using Point = Eigen::Matrix<double, Dim, 1>;

/// Named views of a state vector y (or of its rates), which it does not own.
/// Shapes: position, velocity Dim x N; density, energy 1 x N; stress D(D+1)/2 x N,
/// tension-positive, components in the order of symmetric_index(). `Scalar` is double or const
/// double.
template <int Dim, class Scalar = double>
class StateView {
    template <int Rows>
    using Block = Eigen::Map<
        std::conditional_t<std::is_const_v<Scalar>, const Eigen::Matrix<double, Rows, -1>,
                           Eigen::Matrix<double, Rows, -1>>>;

  public:
    /// Of `y`, layout.size() numbers; both must outlive the view. It copies nothing.
    StateView(const FieldLayout<Dim>& layout, std::span<Scalar> y)
        : layout_(&layout),
          y_(y),
          count_(layout.particles()) {
        assert(y.size() == layout.size());
    }

    /// The same to read only.
    operator StateView<Dim, const double>() const requires(!std::is_const_v<Scalar>) {
        StateView<Dim, const double> same(*layout_, y_);
        same.first_ = first_;
        same.count_ = count_;
        same.holder_ = holder_;
        return same;
    }

    /// Of particles first, ..., first + count - 1 alone; accounts are those of all.
    StateView part(std::size_t first, std::size_t count) const {
        assert(first + count <= count_);
        StateView part = *this;
        part.first_ += first;
        part.count_ = count;
        return part;
    }

    /// Of elements in place of particles: stress(), energy() and field() are theirs, M of them.
    StateView elements() const {
        StateView elements = *this;
        elements.holder_ = Holder::element;
        elements.first_ = 0;
        elements.count_ = layout_->elements();
        return elements;
    }

    /// Dim x N, length; never wrapped into a periodic box. Here and below: precondition has(field).
    Block<Dim> position() const { return block<Dim>(Field::position); }
    /// Dim x N, length/time.
    Block<Dim> velocity() const { return block<Dim>(Field::velocity); }
    /// 1 x N, mass/length^Dim; in y only where the scheme integrates it (else Model::density).
    Block<1> density() const { return block<1>(Field::density); }
    /// D(D+1)/2 x N, tension positive; of solids only.
    Block<symmetric_size(Dim)> stress() const { return block<symmetric_size(Dim)>(Field::stress); }
    /// 1 x N, internal energy per mass, length^2/time^2.
    Block<1> energy() const { return block<1>(Field::energy); }
    /// Any field: components x N, or components x 1 of an account.
    Block<Eigen::Dynamic> field(Field field) const {
        const bool account = field.role() == Role::account;
        const auto* b = layout_->find(field, account ? Holder::particle : holder_);
        assert(b != nullptr);
        const std::size_t rows = b->components;
        return {y_.data() + b->offset + (account ? 0 : rows * first_),
                static_cast<Eigen::Index>(rows),
                static_cast<Eigen::Index>(account ? b->size / rows : count_)};
    }

    /// Its first number; null where the layout has no such field.
    Scalar* find(Field field) const {
        const auto* b = layout_->find(field, holder_);
        return b == nullptr ? nullptr : y_.data() + b->offset + b->components * first_;
    }

    /// Whether y carries the field for what is looked at (particles or elements).
    bool has(Field field) const { return layout_->has(field, holder_); }
    /// Where each field lies in y.
    const FieldLayout<Dim>& layout() const { return *layout_; }

  private:
    template <int, class>
    friend class StateView;

    template <int Rows>
    Block<Rows> block(Field field) const {
        const auto* b = layout_->find(field, holder_);
        assert(b != nullptr && b->components == Rows);
        return {y_.data() + b->offset + Rows * first_, Rows, static_cast<Eigen::Index>(count_)};
    }

    const FieldLayout<Dim>* layout_;
    std::span<Scalar> y_;
    std::size_t first_ = 0, count_;
    Holder holder_ = Holder::particle;
};

template <int Dim>
using State = StateView<Dim, double>;
template <int Dim>
using ConstState = StateView<Dim, const double>;

}  // namespace spam
