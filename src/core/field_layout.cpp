// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/field_layout.hpp>

#include <algorithm>
#include <array>

namespace spam {

std::string_view field_name(Field field) {
    constexpr std::array<std::string_view, 5> names{"position", "velocity", "density", "stress",
                                                    "energy"};
    return names[static_cast<std::size_t>(field)];
}

template <int Dim>
std::size_t FieldLayout<Dim>::components(Field field) {
    switch (field) {
        case Field::position:
        case Field::velocity:
            return Dim;
        case Field::stress:
            return static_cast<std::size_t>(symmetric_size(Dim));
        case Field::density:
        case Field::energy:
            break;
    }
    return 1;
}

template <int Dim>
FieldLayout<Dim>::FieldLayout(std::size_t particles, const std::vector<Field>& fields)
    : particles_(particles) {
    std::vector<Field> ordered = fields;
    std::sort(ordered.begin(), ordered.end());
    for (const Field field : ordered) {
        blocks_.push_back({field, components(field), size_, 1.0});
        size_ += components(field) * particles;
    }
}

template <int Dim>
const typename FieldLayout<Dim>::Block* FieldLayout<Dim>::find(Field field) const {
    const auto it = std::find_if(blocks_.begin(), blocks_.end(),
                                 [field](const Block& b) { return b.field == field; });
    return it == blocks_.end() ? nullptr : &*it;
}

template <int Dim>
void FieldLayout<Dim>::set_scale(Field field, double scale) {
    for (Block& block : blocks_)
        if (block.field == field) block.scale = scale;
}

template <int Dim>
typename FieldLayout<Dim>::Entry FieldLayout<Dim>::entry(std::size_t k) const {
    const Block* block = &blocks_.front();
    for (const Block& b : blocks_)
        if (b.offset <= k) block = &b;
    const std::size_t local = k - block->offset;
    return {block->field, local / block->components, local % block->components};
}

template class FieldLayout<1>;
template class FieldLayout<2>;
template class FieldLayout<3>;

}  // namespace spam
