// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/lanes.hpp>
#include <spam/kernel/general_weight.hpp>
#include <spam/neighbors/pair.hpp>
#include <spam/physics/pass_constants.hpp>
#include <spam/physics/record.hpp>

/// Particles as ellipses (ellipsoids in space), whose axes follow the motion around them, [HH01]. G_i, symmetric, is
/// what makes the ellipse a circle: u^2 = r . G_i r is 1 at its edge. W(u) is the weight of range 1, S = -W'/u,
/// b(u) = (1 - u)^2, both 0 beyond the edge.
///     rho_i = |G_i|^(1/2) sum_j m_j W(u_ij)
///     G_dot = -(Lambda^t G + G Lambda),   Lambda_i = C_i B_i^-1,   B = sum_j b r_ji r_ji^t,   C = sum_j b v_ji r_ji^t
/// By virtual work, with e' = P/rho^2, a_i = m_i e'_i |G_i|^(1/2) and M_i = sum_j m_j S r_ji r_ji^t, the sum of i gives
/// the forces -f_i on i and f_i on j:
///     f_i(r_ji) = (a_i m_j S G_i + b Q_i) r_ji,   Q_i = m_i e'_i (rho_i - |G_i|^(1/2) G_i M_i) B_i^-1
///     m_i e_dot_i = - sum_j f_i(r_ji) . v_ji
/// Energy and momentum are kept pair by pair, and the angular momentum because sum_j r_ji x f_i is 0: Q B and a G M
/// together are m e' rho, which is symmetric. b goes with the ellipse: of a fixed radius a gas that expands would run
/// out of neighbours, and B of an inverse.
namespace spam {
namespace column {

template <int Dim, class T>
struct Shape {
    SymTensor<Dim, T> G;
};
/// What the ellipse of a particle pulls with: a, and Q row by row.
template <int Dim, class T>
struct EllipsePull {
    T a{};
};
template <int Dim, class T>
struct EllipseStrain {
    Mat<Dim, T> Q;
};

/// Sums of the particle's own ellipse.
template <int Dim, class T>
struct EllipseWeight {
    T weight{};  ///< sum m W
};
template <int Dim, class T>
struct EllipseSpread {
    SymTensor<Dim, T> M;
};
template <int Dim, class T>
struct EllipseMoments {
    SymTensor<Dim, T> B;
};
template <int Dim, class T>
struct EllipseFlow {
    Mat<Dim, T> C;
};

}  // namespace column

template <int Dim, class T = double>
using ShapedRecord = typename MotionRecord<Dim, T>::template And<column::Shape>;
template <int Dim, class T = double>
using PullingRecord =
    typename ShapedRecord<Dim, T>::template And<column::EllipsePull, column::EllipseStrain>;
/// The same and the sums, which no neighbour reads.
template <int Dim, class T = double>
using EllipseRecord =
    typename PullingRecord<Dim, T>::template And<column::EllipseWeight, column::EllipseSpread,
                                                 column::EllipseMoments, column::EllipseFlow>;

inline namespace SPAM_LANES {

/// r . G r, above 0 also of a particle and itself, so that it has a root.
template <int Dim, class T>
SPAM_INLINE T squared_in(const SymTensor<Dim, T>& G, const Vec<Dim, T>& r) {
    return dot(r, G * r) + T(1e-300);
}
/// (1 - u)^2 inside.
template <class T>
SPAM_INLINE T parabola(const T& u) {
    const T rest = positive_part(T(1.0) - u);
    return rest * rest;
}

template <int Dim>
struct EllipseSums {
    GeneralWeight<Dim> unit;  ///< of range 1
    static EllipseSums with(const PassConstants&, const GeneralWeight<Dim>& unit) { return {unit}; }

    template <class T>
    struct Sums {
        T weight{};
        SymTensor<Dim, T> M, B;
        Mat<Dim, T> C;
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        using std::sqrt;
        const T u = sqrt(squared_in(i.G, pair.r_ji)), b = parabola(u);
        const T m_S = j.m * unit.minus_slope_over_r(u);
        sums.weight += j.m * unit.value(u);
        for (int a = 0; a < Dim; ++a) {
            const T b_r = b * pair.r_ji[a];
            for (int c = a; c < Dim; ++c) {
                sums.M(a, c) += m_S * pair.r_ji[a] * pair.r_ji[c];
                sums.B(a, c) += b_r * pair.r_ji[c];
            }
            for (int c = 0; c < Dim; ++c) sums.C(c, a) += b_r * pair.v_ji[c];
        }
    }
    template <class To, class T>
    static void store(const To& to, const Sums<T>& sums) {
        using R = EllipseRecord<Dim>;
        to.template write<R, column::EllipseWeight>(sums.weight);
        to.template write<R, column::EllipseSpread>(sums.M);
        to.template write<R, column::EllipseMoments>(sums.B);
        to.template write<R, column::EllipseFlow>(sums.C);
    }
};

/// Both ellipses: the force of a pair, equal and opposite, and the power of i's.
template <int Dim>
struct EllipseForce {
    GeneralWeight<Dim> unit;
    static EllipseForce with(const PassConstants&, const GeneralWeight<Dim>& unit) {
        return {unit};
    }

    template <class T>
    struct Sums {
        Vec<Dim, T> force;
        T power{};
    };
    /// f of the ellipse of `one`, where the other particle has mass m.
    template <class T, class Record>
    Vec<Dim, T> pull(const Record& one, const T& m, const Vec<Dim, T>& r_ji) const {
        using std::sqrt;
        const T u = sqrt(squared_in(one.G, r_ji));
        Vec<Dim, T> f = (one.a * m * unit.minus_slope_over_r(u)) * (one.G * r_ji);
        f += parabola(u) * (one.Q * r_ji);
        for (int a = 0; a < Dim; ++a) f[a] = rounded(f[a]);  // the same seen from j
        return f;
    }
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        const Vec<Dim, T> own = pull(i, j.m, pair.r_ji), other = pull(j, i.m, pair.r_ji);
        sums.force -= own + other;
        sums.power -= dot(own, pair.v_ji);
    }
    template <class T, class Record>
    static Sums<T> result(const Record& i, const Sums<T>& sums) {
        const T per_mass = T(1.0) / i.m;
        return {per_mass * sums.force, per_mass * sums.power};
    }
    template <class To, class T>
    static void store(const To& to, const Sums<T>& rates) {
        to.set(to.out.v_dot, rates.force);
        to.set(to.out.e_dot, rates.power);
    }
};

}  // namespace SPAM_LANES
}  // namespace spam
