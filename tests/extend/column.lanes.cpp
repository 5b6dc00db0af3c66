// SPDX-License-Identifier: GPL-3.0-or-later
// A column of one's own, in one file: charges of either sign, phi = q_i q_j (1 - r^2/s^2)^3 inside s.
#if defined(SPAM_LEVEL)
#include <spam/rhs/run_sweep.hpp>
using namespace spam;
namespace {

template <int Dim, class T>
struct Charge {
    T charge{};
};
using Charged = PointRecord<2>::And<Charge>;

template <bool OfEnergy>
struct Charges {
    double s;
    static Charges with(const PassConstants& c) { return {c.own[1]}; }
    template <class T>
    struct Sums {
        Vec<2, T> force;
        T energy{};
    };
    template <class T, class R>
    void add(const Pair<2, T>& pair, const R& i, const R& j, Sums<T>& sums) const {
        const T q = positive_part(T(1.0) - pair.r2 * T(1.0 / (s * s)));
        const T both = i.charge * j.charge;
        sums.force -= (T(6.0 / (s * s)) * both * q * q) * pair.r_ji;
        sums.energy += T(0.5) * both * q * q * q;
    }
    template <class T, class R>
    static Sums<T> result(const R& i, const Sums<T>& sums) {
        return {(T(1.0) / i.m) * sums.force, sums.energy - T(0.5) * i.charge * i.charge};
    }
    template <class To, class T>
    static void store(const To& to, const Sums<T>& found) {
        if constexpr (OfEnergy)
            to.set(to.out.energy, found.energy);
        else
            to.set(to.out.v_dot, found.force);
    }
};
const RegisterSweeps<2> charges("charges", InstructionSet::SPAM_LEVEL,
                                pair_sweeps<InstructionSet::SPAM_LEVEL, GeneralSweep, 2, Charged,
                                            Charges<false>, Charges<true>>);
}  // namespace
#else
#include "own_law.hpp"
OWN_LAW("charges", {spam::test::alternating(35)})
#endif
