// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/model.hpp>

#include <memory>

namespace spam {

/// The particles of a model among which a term acts: all of them, or those stored as first, ...,
/// first + count - 1. Particles of one selection do not meet those of another, unless a further term acts
/// on both.
template <int Dim>
class Selection {
  public:
    /// All: whatever takes a selection takes a model. The model must outlive it.
    Selection(Model<Dim>& model)  // NOLINT(google-explicit-constructor)
        : model_(&model),
          count_(model.particles().size()) {}
    /// Throws InputError where there are not so many, or none.
    Selection(Model<Dim>& model, std::size_t first, std::size_t count);

    Model<Dim>& model() const { return *model_; }
    const Particles<Dim>& particles() const { return part_ ? *part_ : model_->particles(); }
    bool whole() const { return part_ == nullptr; }
    std::size_t first() const { return first_; }
    std::size_t count() const { return count_; }
    bool overlaps(const Selection& other) const {
        return first_ < other.first_ + other.count_ && other.first_ < first_ + count_;
    }
    /// A state of the model, as these particles see it.
    template <class Scalar>
    StateView<Dim, Scalar> of(const StateView<Dim, Scalar>& state) const {
        return whole() ? state : state.part(first_, count_);
    }

    /// After the model's particles have got other bodies.
    void update_bodies();

  private:
    Model<Dim>* model_;
    std::size_t first_ = 0, count_;
    std::shared_ptr<Particles<Dim>> part_;  ///< null where it is all
};

SPAM_COMPILED(extern template class Selection);

}  // namespace spam
