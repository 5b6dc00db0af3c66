// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/tensor.hpp>
#include <spam/physics/torque_balance.hpp>

/// Torque scaling in space. A body's pair torques T = r_ij x F_ij, of direction n = T/|T|, are multiplied by the
/// factors s that make
///     sum |T| (s ln s - s)  least over s >= 0 with  sum s T + X = 0,   X = sum m u x v.
/// The sum is strictly convex: there is one such set of factors, and it turns and is mirrored with the body. With a
/// finite multiplier s = exp(-theta . n), and theta is where Phi = sum |T| s - theta . X is least. In the plane
/// n = +-z, and e^theta is the R of torque_balance.hpp.
///     torque_pair      one theta for all pairs of a body; a pair of two bodies gets the mean of their factors
///     torque_particle  the same with T_i = 1/2 sum_j T_ij in place of T, and s_ij = (s_i + s_j)/2
/// Where -X is no sum of the torques with positive weights there is no finite theta: Newton's steps then take the
/// factors of some pairs to 0, as the plane's rule takes those of a body whose torques have one sign.
namespace spam {

/// Sums over torques, by which Newton's method finds theta.
struct TorqueMoments {
    Vec<3> torque;        ///< sum s T
    SymTensor<3> spread;  ///< sum s |T| n n^t; its trace is sum s |T|
};

/// Newton's method for one body's theta. Each step is cut where a factor would change by more than e in the mean,
/// and halved until Phi falls; directions without torques are left out. For X = 0 it ends always, in about four
/// sums for bodies of hundreds and about thirty for fragments whose factors go to 0.
class TorqueBalance {
  public:
    /// Begins with the sums at theta = 0.
    void begin(const TorqueMoments& at_zero, const Vec<3>& X);
    /// Whether theta is found, or no step helps.
    bool done() const { return done_; }
    /// Takes the sums at theta, and goes on to the next one.
    void next(const TorqueMoments& at_theta);

    /// Where sums are wanted next; what was found, once done.
    const Vec<3>& theta() const { return theta_; }
    /// |sum s T + X| by the sum of |T| at theta = 0; below 1e-13 unless X cannot be balanced.
    double residual() const { return residual_; }

  private:
    void step_from(const TorqueMoments& sums);

    Vec<3> theta_, from_, step_, X_;
    double size_ = 0.0;      ///< sum |T| at theta = 0
    double Phi_ = 0.0;       ///< at from_
    double residual_ = 0.0;  ///< at from_
    int sums_ = 0;
    bool done_ = true;
};

/// The factor of a particle for torques of direction n.
template <class T, class Record>
T torque_factor(const Record& of, const Vec<3, T>& n) {
    return of.positive_factor * exponential(-dot(of.theta, n));
}

/// A torque's size, never 0, and its direction.
template <class T>
struct TorqueDirection {
    T size;
    Vec<3, T> n;
    explicit TorqueDirection(const Vec<3, T>& torque) {
        using std::max;
        using std::sqrt;
        size = sqrt(max(dot(torque, torque), T(1e-300)));
        n = (T(1.0) / size) * torque;
    }
};

/// f_ij with its torque multiplied by s, the mean of both particles' factors: f_ij += (s - 1) T x r_ij/r^2, which
/// leaves f_ij = -f_ji and the part along r_ij.
template <class T, class Record>
Vec<3, T> scale_torque(const Pair<3, T>& pair, const Record& i, const Record& j,
                       const Vec<3, T>& f_ij) {
    using std::max;
    const Vec<3, T> torque = cross(f_ij, pair.r_ji);
    const TorqueDirection<T> direction(torque);
    const T s = T(0.5) * (torque_factor(i, direction.n) + torque_factor(j, direction.n));
    // A particle's pair with itself has r = 0 and torque = 0; the floor keeps 0/0 out.
    return f_ij + ((s - T(1.0)) / max(pair.r2, T(1e-300))) * cross(pair.r_ji, torque);
}

/// Sums over the pairs of particle i, every one of which is met twice, once from each end; with the factors of its
/// record or, in the first sweep, without any.
template <bool scaled>
struct SpaceTorqueSums {
    template <class T>
    struct Sums {
        Vec<3, T> torque;
        SymTensor<3, T> spread;
    };
    template <class T, class Record>
    static void add(const Pair<3, T>& pair, const Record& i, const Record& j, Sums<T>& sums) {
        const Vec<3, T> torque = (i.m * j.m) * cross(stress_force(pair, i, j), pair.r_ji);
        const TorqueDirection<T> direction(torque);
        T s(1.0);
        if constexpr (scaled) s = torque_factor(i, direction.n);
        const Vec<3, T> of_pair = s * torque;
        sums.torque += of_pair;
        for (int a = 0; a < 3; ++a)
            for (int b = a; b < 3; ++b) sums.spread(a, b) += of_pair[a] * direction.n[b];
    }
    template <class To, class T>
    static void store(const To& to, const Sums<T>& sums) {
        to.set(to.out.torque_moments, std::make_tuple(sums.torque, sums.spread));
    }
};
/// Numbers that are stored of a particle.
inline constexpr std::size_t torque_moments = 9;

template <>
struct TorqueSums<3> : SpaceTorqueSums<false> {};

}  // namespace spam
