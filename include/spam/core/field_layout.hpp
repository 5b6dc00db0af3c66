// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/tensor.hpp>

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace spam {

/// Fields a particle may carry in the state vector y, in the order of their blocks.
enum class Field { position, velocity, density, stress, energy };

std::string_view field_name(Field field);

/// Where each field lies in y. y holds one block per field, each block `components x particles`,
/// column-major (the components of one particle are adjacent):
///     y = [ x_0 y_0 x_1 y_1 ... | vx_0 vy_0 ... | rho_0 rho_1 ... | sxx_0 syy_0 sxy_0 ... | e_0
///     ... ]
/// Which blocks exist follows from scheme and material (the model decides).
template <int Dim>
class FieldLayout {
  public:
    struct Block {
        Field field;
        std::size_t components;  ///< per particle
        std::size_t offset;      ///< first entry of the block in y
        double scale;            ///< typical magnitude; the absolute tolerance is atol * scale
    };

    FieldLayout(std::size_t particles, const std::vector<Field>& fields);

    std::size_t particles() const { return particles_; }
    std::size_t size() const { return size_; }  ///< entries of y
    const std::vector<Block>& blocks() const { return blocks_; }
    const Block* find(Field field) const;  ///< nullptr where y does not carry the field
    bool has(Field field) const { return find(field) != nullptr; }

    /// Typical magnitude of a field, in the units of the run. Precondition: the field is present.
    void set_scale(Field field, double scale);

    /// Entry k of y in words, "velocity_y of particle 17", for guards and error messages.
    struct Entry {
        Field field;
        std::size_t particle;
        std::size_t component;
    };
    Entry entry(std::size_t k) const;

    static std::size_t components(Field field);

  private:
    std::size_t particles_;
    std::size_t size_ = 0;
    std::vector<Block> blocks_;
};

extern template class FieldLayout<1>;
extern template class FieldLayout<2>;
extern template class FieldLayout<3>;

}  // namespace spam
