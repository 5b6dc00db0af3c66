// SPDX-License-Identifier: GPL-3.0-or-later
#include "plane_stress_return.hpp"

#include <spam/core/lanes.hpp>

#include <algorithm>

namespace spam {
namespace {

constexpr std::size_t W = native_lanes(InstructionSet::SPAM_LEVEL);
using T = Lanes<static_cast<int>(W)>;

/// W particles. The search for the root is a chain of operations that wait for each other: two groups are
/// searched for at a time.
struct Group {
    T xx, yy, xy, limit, square, p, d;
    PlaneStressMultiplier<T> root;

    SPAM_INLINE Group(const PlaneStressVonMises& surface, const LinearHardening& flow,
                      const double* plastic_strain, const double* trial) {
        for (std::size_t l = 0; l < W; ++l) {
            const int lane = static_cast<int>(l);
            set_lane(xx, lane, trial[3 * l]);
            set_lane(yy, lane, trial[3 * l + 1]);
            set_lane(xy, lane, trial[3 * l + 2]);
        }
        p = 0.5 * (xx + yy);
        d = 0.5 * (xx - yy);
        const T Y = flow.Y + flow.H * load_lanes<static_cast<int>(W)>(plastic_strain);
        const T p2 = p * p, s2 = 3.0 * (d * d + xy * xy);
        square = p2 + s2;
        limit = Y * Y;
        // What does not yield is put on the surface, where the root is 0.
        const T inside = limit - where_below(limit, square, limit);
        root = {where_below(limit, square, p2),
                where_below(limit, square, s2) + inside,
                Y,
                surface.falls()[0],
                surface.falls()[1],
                2.0 / 3.0 * flow.H};
    }
    SPAM_INLINE void store(double* to) const {
        const T f = 1.0 / (1.0 + root.a * root.g), h = 1.0 / (1.0 + root.b * root.g);
        const auto returned = [&](const T& trial, const T& there) SPAM_FLAT {
            return trial + where_below(limit, square, there - trial);
        };
        const T x = returned(xx, f * p + h * d), y = returned(yy, f * p - h * d);
        const T z = returned(xy, h * xy);
        for (std::size_t l = 0; l < W; ++l) {
            to[3 * l] = lane(x, static_cast<int>(l));
            to[3 * l + 1] = lane(y, static_cast<int>(l));
            to[3 * l + 2] = lane(z, static_cast<int>(l));
        }
    }
};

SPAM_INLINE void two_groups(const PlaneStressVonMises& surface, const LinearHardening& flow,
                            const double* plastic_strain, const double* trial, double* to) {
    Group one(surface, flow, plastic_strain, trial);
    Group other(surface, flow, plastic_strain + W, trial + 3 * W);
    for (bool on = true; on;) {
        const bool first = one.root.advance(), second = other.root.advance();
        on = first || second;
    }
    one.store(to);
    other.store(to + 3 * W);
}

}  // namespace

template <InstructionSet Level>
void return_plane_stress_at(const PlaneStressVonMises& surface, const LinearHardening& flow,
                            std::size_t count, const double* plastic_strain, const double* trial,
                            double* to) {
    std::size_t k = 0;
    for (; k + 2 * W <= count; k += 2 * W)
        two_groups(surface, flow, plastic_strain + k, trial + 3 * k, to + 3 * k);
    if (k == count) return;
    double strain[2 * W] = {}, stress[6 * W] = {};
    std::copy(plastic_strain + k, plastic_strain + count, strain);
    std::copy(trial + 3 * k, trial + 3 * count, stress);
    two_groups(surface, flow, strain, stress, stress);
    std::copy(stress, stress + 3 * (count - k), to + 3 * k);
}

template void return_plane_stress_at<InstructionSet::SPAM_LEVEL>(const PlaneStressVonMises&,
                                                                 const LinearHardening&,
                                                                 std::size_t, const double*,
                                                                 const double*, double*);

}  // namespace spam
