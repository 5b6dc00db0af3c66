// SPDX-License-Identifier: GPL-3.0-or-later
#include "trials.hpp"
#include <spam/analysis/bonded_lattice.hpp>
#include <spam/analysis/wave_vectors.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace material_vectors_study {
namespace {

using std::numbers::pi;

/// Calls visit(k) for the wave vectors of a sample of 12 x 12 but translations, until it returns true.
template <class Visit>
bool any_wave(const Eigen::Matrix2d& F, const Visit& visit) {
    constexpr int cells = 12;
    const Eigen::Matrix2d strained = F.inverse().transpose();
    for (int a = 0; a < cells; ++a)
        for (int b = 0; b <= cells / 2; ++b)  // k and -k are the same
            if (a + b > 0) {
                const Point<2> free = first_zone(
                    2.0 * pi * triangular_basis().inverse().transpose() * Point<2>(a, b) / cells);
                if (visit(Point<2>(strained * free))) return true;
            }
    return false;
}

bool grows(const MaterialVectorScheme& scheme, double tension) {
    for (int kind = 0; kind < 16; ++kind) {
        const double minor = kind == 15 ? 1.0 : kind < 5 ? 0.0 : kind < 10 ? 0.5 : -1.0;
        const Eigen::Matrix2d turn =
            Eigen::Rotation2Dd(kind % 5 * pi / 24.0).toRotationMatrix();  // 0 to 30 degrees
        const Eigen::Matrix2d cauchy =
            turn * Eigen::Vector2d(tension, minor * tension).asDiagonal() * turn.transpose();
        Eigen::Matrix2d F;
        try {
            F = deformation_under<2>(solid(), Eigen::Matrix2d(0.5 * (cauchy + cauchy.transpose())));
        } catch (const InputError&) {
            continue;  // no such state of strain
        }
        const BondedLattice<2> lattice(triangular_basis(), solid(), scheme, F);
        if (any_wave(F, [&](const Point<2>& k) { return lattice.growth_rate(k) > 1e-8; }))
            return true;
    }
    return false;
}

}  // namespace

double tension_borne(const MaterialVectorScheme& scheme) {
    int steps = 0;  // of 0.02
    while (steps < 100 && !grows(scheme, 0.02 * (steps + 1) * solid().stiffness())) ++steps;
    return 0.02 * steps;
}

double lowest_frequency(const MaterialVectorScheme& scheme) {
    const Eigen::Matrix2d F = Eigen::Matrix2d::Identity();
    const BondedLattice<2> lattice(triangular_basis(), solid(), scheme, F);
    const double c_T = std::sqrt(solid().eta / rho);
    double lowest = HUGE_VAL;
    any_wave(F, [&](const Point<2>& k) {
        lowest = std::min(lowest, lattice.frequencies(k).back() / (c_T * k.norm()));
        return false;
    });
    return lowest;
}

}  // namespace material_vectors_study
