// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/neighbors/neighbourhood.hpp>

#include <algorithm>

namespace spam {

template <int Dim>
Neighbourhood<Dim>::Neighbourhood(double range, ListUse use, const Box<Dim>& box, int width,
                                  int numbers, std::span<const NumberKind> kinds)
    : range_(range),
      use_(use),
      box_(box.of_images()),
      width_(width),
      numbers_(static_cast<std::size_t>(numbers)),
      kinds_(kinds.begin(), kinds.end()) {
    forget();
}

template <int Dim>
Neighbourhood<Dim>::Neighbourhood(double range, double skin, const Box<Dim>& box, int width,
                                  int numbers, std::span<const NumberKind> kinds)
    : Neighbourhood(range, ListUse::once, box, width, numbers, kinds) {
    skin_ = skin;
    forget();
}

template <int Dim>
void Neighbourhood<Dim>::forget() {
    share_ = first_share;
    served_ = 0;
    list_ = std::make_shared<ClusterList<Dim>>(range_, skin(), box_, width_, numbers_);
    records_ = std::vector<double>();  // {} would keep its room
    walls_.clear();
    for (int a = 0; a < Dim; ++a)
        for (const bool upper : {false, true})
            if (box_.wall(a, upper).has_images()) walls_.emplace_back(a, upper);
}

template <int Dim>
void Neighbourhood<Dim>::set_range(double range) {
    range_ = range;
    forget();
}

/// By what the list that is used up has served: never by the clock, or no run could be repeated.
template <int Dim>
void Neighbourhood<Dim>::choose_skin() {
    if (served_ < 8) share_ = std::min(1.25 * share_, most_share);
    if (served_ > 60) share_ = std::max(share_ / 1.25, least_share);
    list_->set_skin(skin());
    served_ = 0;
}

template <int Dim>
void Neighbourhood<Dim>::build(const Eigen::Ref<const Points<Dim>>& x) {
    if (use_ == ListUse::again_and_again && list_->builds() > 0) choose_skin();
    list_->build(x);
    records_.resize(list_->slots() * numbers_);
}

template <int Dim>
Neighbourhood<Dim> Neighbourhood<Dim>::for_observer() const {
    if (!for_good()) return {range_, ListUse::once, box_, width_, numbers(), kinds_};
    Neighbourhood own = *this;
    own.walls_.clear();  // they have pointers into what was copied
    return own;
}

template <int Dim>
const BehindWall<Dim>* Neighbourhood<Dim>::behind(int a, bool upper) const {
    for (const BehindWall<Dim>& wall : walls_)
        if (wall.is(a, upper)) return &wall;
    return nullptr;
}

SPAM_COMPILED(template class Neighbourhood);

}  // namespace spam
