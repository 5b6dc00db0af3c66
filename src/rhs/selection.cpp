// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/rhs/selection.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace spam {
namespace {

template <class Value>
std::vector<Value> part_of(const std::vector<Value>& all, std::size_t first, std::size_t count) {
    if (all.empty()) return {};
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

template <int Dim>
Selection<Dim>::Selection(Model<Dim>& model, std::size_t first, std::size_t count)
    : model_(&model),
      first_(first),
      count_(count) {
    const Particles<Dim>& all = model.particles();
    if (count == 0 || first >= all.size() || count > all.size() - first)
        throw InputError(
            fmt::format("selection: {} particles from number {} on are not among {}; choose some "
                        "of those",
                        count, first, all.size()));
    if (count == all.size()) return;
    part_ = std::make_shared<Particles<Dim>>(
        Particles<Dim>{part_of(all.mass, first, count), part_of(all.id, first, count),
                       part_of(all.body, first, count),
                       all.reference_position.middleCols(static_cast<Eigen::Index>(first),
                                                         static_cast<Eigen::Index>(count)),
                       all.spacing, part_of(all.material, first, count)});
}

template <int Dim>
void Selection<Dim>::update_bodies() {
    if (part_) part_->body = part_of(model_->particles().body, first_, count_);
}

template class Selection<1>;
template class Selection<2>;
template class Selection<3>;

}  // namespace spam
