// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/parallel.hpp>
#include <spam/core/parts.hpp>
#include <spam/neighbors/motion_since.hpp>

namespace spam {

template <int Dim>
void MotionSince<Dim>::begin(const Eigen::Ref<const Points<Dim>>& position,
                             const RigidMotion<Dim>& motion) {
    then_ = position;
    motion_ = motion;
}

template <int Dim>
Displacement<Dim> MotionSince<Dim>::displacement(double distance) const {
    Displacement<Dim> d;
    const Point<Dim> shift = motion_.to - motion_.rotation * motion_.from;
    for (int a = 0; a < Dim; ++a) {
        d.shift[a] = shift[a];
        for (int b = 0; b < Dim; ++b) d.rotation[a][b] = motion_.rotation(a, b);
    }
    d.then = then_.data();
    d.limit2 = distance * distance;
    return d;
}

template <int Dim>
bool MotionSince<Dim>::none_beyond(double distance,
                                   const Eigen::Ref<const Points<Dim>>& position) const {
    const Displacement<Dim> now = displacement(distance);
    const double* const x = position.data();
    return parallel_count(static_cast<std::size_t>(then_.cols()),
                          [&](std::size_t i) { return now.too_far(i, x + Dim * i); }) == 0;
}

template <int Dim>
bool MotionSince<Dim>::within(double distance, const Eigen::Ref<const Points<Dim>>& position,
                              const Box<Dim>& box) {
    // Any rigid motion will do for the criterion: a better one is looked for when the last one is
    // used up.
    const auto all_within = [&] { return !Parts::here().any(!none_beyond(distance, position)); };
    if (all_within()) return true;
    motion_ = box.periodic() || box.walled() ? best_translation<Dim>(then_, position)
                                             : best_rigid_motion<Dim>(then_, position);
    for (int a = 0; a < Dim; ++a)  // walls stay where they are
        if (box.walled(a)) motion_.to[a] = motion_.from[a];
    return all_within();
}

SPAM_COMPILED(template class MotionSince);

}  // namespace spam
