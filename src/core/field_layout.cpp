// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/field_layout.hpp>

#include <algorithm>
#include <tuple>

namespace spam {

template <int Dim>
FieldLayout<Dim>::FieldLayout(std::size_t particles, const std::vector<Field>& fields)
    : particles_(particles) {
    for (const Field field : fields) add(field);
}

template <int Dim>
std::string FieldLayout<Dim>::Block::name() const {
    const std::string name(field.name());
    return holder == Holder::element ? "element_" + name : name;
}

template <int Dim>
void FieldLayout<Dim>::add(Field field, Holder holder) {
    const std::size_t components = field.components<Dim>();
    if (has(field, holder) || components == 0) return;
    const bool account = field.role() == Role::account;
    const std::size_t holders = holder == Holder::element ? elements_ : particles_;
    const auto place = [](const Field& f, Holder h) {
        return std::tuple(f.role() == Role::account, h, f.place());
    };
    const auto behind = std::upper_bound(
        blocks_.begin(), blocks_.end(), place(field, holder),
        [&](const auto& at, const Block& block) { return at < place(block.field, block.holder); });
    blocks_.insert(
        behind, {field, components, 0, account ? components : components * holders, 1.0, holder});
    size_ = 0;
    for (Block& block : blocks_) {
        block.offset = size_;
        size_ += block.size;
    }
}

template <int Dim>
const typename FieldLayout<Dim>::Block* FieldLayout<Dim>::find_by_name(Field field,
                                                                       Holder holder) const {
    for (const Block& block : blocks_)
        if (block.field == field && block.holder == holder) return &block;
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
    return {block->field, block->holder, local / block->components, local % block->components};
}

template <int Dim>
std::string FieldLayout<Dim>::entry_name(std::size_t k) const {
    const Entry e = entry(k);
    return std::string(e.field.name()) + e.field.template suffix<Dim>(e.component);
}

SPAM_COMPILED(template class FieldLayout);

}  // namespace spam
