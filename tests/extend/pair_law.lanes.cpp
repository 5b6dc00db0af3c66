// SPDX-License-Identifier: GPL-3.0-or-later
// A law of pairs of one's own, in one file: phi = k (1 - r^2/s^2)^3 inside s.
#if defined(SPAM_LEVEL)  // compiled by spam_add_sweeps(), once for every instruction set
#include <spam/rhs/run_sweep.hpp>
using namespace spam;
namespace {

struct Bump {
    static constexpr bool light = true;
    double k, s;
    static Bump with(const PassConstants& c) { return {c.own[0], c.own[1]}; }
    template <class T>
    T q(const T& r2) const {
        return positive_part(T(1.0) - r2 * T(1.0 / (s * s)));
    }
};
struct Force : Bump {
    static Force with(const PassConstants& c) { return {Bump::with(c)}; }
    template <class T>
    struct Sums {
        Vec<2, T> force;
    };
    template <class T, class R>
    void add(const Pair<2, T>& pair, const R&, const R&, Sums<T>& sums) const {
        sums.force -= (T(6.0 * k / (s * s)) * q(pair.r2) * q(pair.r2)) * pair.r_ji;
    }
    template <class T, class R>
    static Vec<2, T> result(const R& i, const Sums<T>& sums) {
        return (T(1.0) / i.m) * sums.force;
    }
    template <class To, class T>
    static void store(const To& to, const Vec<2, T>& v_dot) {
        to.set(to.out.v_dot, v_dot);
    }
};
struct Energy : Bump {
    static Energy with(const PassConstants& c) { return {Bump::with(c)}; }
    template <class T>
    struct Sums {
        T energy{};
    };
    template <class T, class R>
    void add(const Pair<2, T>& pair, const R&, const R&, Sums<T>& sums) const {
        const T bump = q(pair.r2);
        sums.energy += T(0.5 * k) * bump * bump * bump;
    }
    template <class To, class T>
    void store(const To& to, const Sums<T>& sums) const {
        to.set(to.out.energy, sums.energy - T(0.5 * k));  // without what a particle has of itself
    }
};
const RegisterSweeps<2> bump(
    "bump", InstructionSet::SPAM_LEVEL,
    pair_sweeps<InstructionSet::SPAM_LEVEL, GeneralSweep, 2, PointRecord<2>, Force, Energy>);
}  // namespace
#else
#include "own_law.hpp"  // the test: its force is the gradient of its energy
OWN_LAW("bump", {})
#endif
