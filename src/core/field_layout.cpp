// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/field_layout.hpp>

#include <algorithm>

namespace spam {

template <int Dim>
FieldLayout<Dim>::FieldLayout(std::size_t particles, const std::vector<Field>& fields)
    : particles_(particles) {
    for (const Field field : fields) add(field);
}

template <int Dim>
void FieldLayout<Dim>::add(Field field) {
    const std::size_t components = field.components<Dim>();
    if (has(field) || components == 0) return;
    const std::size_t size = field.role() == Role::account ? components : components * particles_;
    const auto behind =
        std::upper_bound(blocks_.begin(), blocks_.end(), field.place(),
                         [](int place, const Block& block) { return place < block.field.place(); });
    blocks_.insert(behind, {field, components, 0, size, 1.0});
    size_ = 0;
    for (Block& block : blocks_) {
        block.offset = size_;
        size_ += block.size;
    }
}

template <int Dim>
const typename FieldLayout<Dim>::Block* FieldLayout<Dim>::find_by_name(Field field) const {
    for (const Block& block : blocks_)
        if (block.field == field) return &block;
    return nullptr;
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

template <int Dim>
std::string FieldLayout<Dim>::entry_name(std::size_t k) const {
    const Entry e = entry(k);
    return std::string(e.field.name()) + e.field.template suffix<Dim>(e.component);
}

template class FieldLayout<1>;
template class FieldLayout<2>;
template class FieldLayout<3>;

}  // namespace spam
