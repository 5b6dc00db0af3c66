// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/parts.hpp>
#include <spam/rhs/selection.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace spam {

template <int Dim>
Selection<Dim>::Selection(Model<Dim>& model, std::size_t first, std::size_t count)
    : model_(&model),
      first_(first),
      count_(count) {
    const Particles<Dim>& all = model.particles();
    const bool none = count == 0 && Parts::here().alone();  // a part of a run may have none of them
    if (none || first > all.size() || count > all.size() - first)
        throw InputError(
            fmt::format("selection: {} particles from number {} on are not among {}; choose some "
                        "of those",
                        count, first, all.size()));
    if (count == all.size()) return;
    std::vector<std::uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), static_cast<std::uint32_t>(first));
    part_ = std::make_shared<Particles<Dim>>(all.some(numbers));
}

template <int Dim>
void Selection<Dim>::update_bodies() {
    const auto& body = model_->particles().body;
    if (part_ && !body.empty())
        std::copy_n(body.begin() + static_cast<std::ptrdiff_t>(first_), count_,
                    part_->body.begin());
}

SPAM_COMPILED(template class Selection);

}  // namespace spam
