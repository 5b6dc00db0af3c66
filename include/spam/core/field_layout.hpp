// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/field.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace spam {

/// Where each field lies in y. y holds one block per field, each block `components x particles` (or elements),
/// column-major (the components of one particle are adjacent); fields of elements come after those of particles,
/// accounts of the whole system last:
///     y = [ x_0 y_0 x_1 y_1 ... | vx_0 vy_0 ... | rho_0 ... | sxx_0 syy_0 sxy_0 ... | e_0 ... | work ]
/// Which blocks exist follows from scheme, material and externals (the model decides).
template <int Dim>
class FieldLayout {
  public:
    /// One field in y.
    struct Block {
        /// Which field it is.
        Field field;
        std::size_t components;  ///< per particle or element, or of the account
        std::size_t offset;      ///< first entry of the block in y
        std::size_t size;        ///< entries
        double scale;            ///< typical magnitude; the absolute tolerance is atol * scale
        Holder holder;           ///< `particle` for accounts

        /// "stress", and of elements "element_stress": no two blocks have the same.
        std::string name() const;
    };

    /// Of so many particles; the fields in any order, each once. Scales are 1 until set_scale().
    FieldLayout(std::size_t particles, const std::vector<Field>& fields);

    /// One more field, at its place; nothing where y holds it already. Blocks behind it move: no y may
    /// have been made yet.
    void add(Field field, Holder holder = Holder::particle);
    /// How many elements there are; before fields of theirs are added.
    void set_elements(std::size_t elements) { elements_ = elements; }

    /// N
    std::size_t particles() const { return particles_; }
    /// M; 0 where particles alone hold fields.
    std::size_t elements() const { return elements_; }
    std::size_t size() const { return size_; }  ///< entries of y
    /// In the order of y.
    const std::vector<Block>& blocks() const { return blocks_; }
    /// nullptr where y does not carry the field.
    const Block* find(Field field, Holder holder = Holder::particle) const {
        for (const Block& block : blocks_)  // most often, and quicker than names
            if (block.field.same_kind(field) && block.holder == holder) return &block;
        return find_by_name(field, holder);
    }
    /// Whether y carries the field.
    bool has(Field field, Holder holder = Holder::particle) const {
        return find(field, holder) != nullptr;
    }

    /// Typical magnitude of a field, in the units of the run, whatever holds it.
    void set_scale(Field field, double scale);

    /// Which number entry k of y is.
    struct Entry {
        /// Which field it belongs to.
        Field field;
        /// Whether a particle or an element holds it; `particle` for accounts.
        Holder holder;
        std::size_t number;  ///< of the particle or element; 0 for accounts
        /// Place among the components of the field, from 0.
        std::size_t component;
    };
    /// What entry k is. Precondition: k < size().
    Entry entry(std::size_t k) const;
    /// The field and component of entry k: "velocity_y", "stress_xy", "density".
    std::string entry_name(std::size_t k) const;

  private:
    const Block* find_by_name(Field field, Holder holder) const;

    std::size_t particles_;
    std::size_t elements_ = 0;
    std::size_t size_ = 0;
    std::vector<Block> blocks_;
};

SPAM_COMPILED(extern template class FieldLayout);

}  // namespace spam
