// SPDX-License-Identifier: GPL-3.0-or-later
#include "complex_modes.hpp"
#include <spam/analysis/kicked_lattice.hpp>

namespace spam {

template <int Dim>
KickedLattice<Dim>::KickedLattice(const LatticeModes<Dim>& modes, const Points<Dim>& k, double mass,
                                  const Point<Dim>& v0)
    : mass_(mass) {
    for (Eigen::Index q = 0; q < k.cols(); ++q) {
        const ComplexModes found = complex_modes(modes.acceleration_rate(k.col(q)));
        const Eigen::VectorXcd shares = found.shares(v0.template cast<std::complex<double>>());
        Wave wave{found.vectors * shares.asDiagonal(), found.values.cwiseSqrt()};
        const double rate = wave.lambda.real().cwiseAbs().maxCoeff();
        if (rate > fastest_rate_) {
            fastest_rate_ = rate;
            fastest_ = k.col(q);
        }
        waves_.push_back(std::move(wave));
    }
}

template <int Dim>
double KickedLattice<Dim>::kinetic(double t) const {
    double sum = 0.0;
    for (const Wave& wave : waves_)
        sum += (wave.shape * (t * wave.lambda).array().cosh().matrix()).squaredNorm();
    return 0.5 * mass_ * sum / static_cast<double>(waves_.size());
}

template <int Dim>
double KickedLattice<Dim>::kinetic_rate(double t) const {
    double sum = 0.0, change = 0.0;
    for (const Wave& wave : waves_) {
        const Eigen::ArrayXcd lambda = wave.lambda.array();
        // By exp(fastest_rate t) smaller than they are: at late times only their ratio is finite.
        const Eigen::ArrayXcd growing = 0.5 * (t * (lambda - fastest_rate_)).exp();
        const Eigen::ArrayXcd falling = 0.5 * (-t * (lambda + fastest_rate_)).exp();
        const Eigen::VectorXcd v = wave.shape * (growing + falling).matrix();
        const Eigen::VectorXcd v_dot = wave.shape * (lambda * (growing - falling)).matrix();
        sum += v.squaredNorm();
        change += 2.0 * v.dot(v_dot).real();
    }
    return change / sum;
}

SPAM_COMPILED(template class KickedLattice);

}  // namespace spam
