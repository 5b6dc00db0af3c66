// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/analysis/plane_wave.hpp>

#include <cmath>
#include <numbers>

namespace spam {

std::string_view to_string(Polarization polarization) {
    return polarization == Polarization::transverse ? "transverse" : "longitudinal";
}

Point<2> PlaneWave::direction() const {
    return polarization == Polarization::transverse ? Point<2>(1.0, 0.0) : Point<2>(0.0, 1.0);
}

double PlaneWave::frequency() const {
    const double modulus =
        polarization == Polarization::transverse ? solid.eta : solid.lambda + 2.0 * solid.eta;
    return k * std::sqrt(modulus / density);
}

void PlaneWave::add_to(const State<2>& state) const {
    auto x = state.position();
    auto sigma = state.stress();
    auto e = state.energy();
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const double y = x(1, i);
        const double strain = k * amplitude * std::cos(k * y);
        x.col(i) += amplitude * std::sin(k * y) * direction();
        if (polarization == Polarization::transverse) {
            sigma(2, i) += solid.eta * strain;
            e(0, i) += 0.5 * solid.eta * strain * strain / density;
        } else {
            const double modulus = solid.lambda + 2.0 * solid.eta;
            sigma(0, i) += solid.lambda * strain;
            sigma(1, i) += modulus * strain;
            e(0, i) += 0.5 * modulus * strain * strain / density;
            if (state.has(Field::density)) state.density()(0, i) /= 1.0 + strain;
        }
    }
}

double PlaneWave::coefficient(const Points<2>& reference, const Points<2>& field) const {
    double product = 0.0, norm = 0.0;
    for (Eigen::Index i = 0; i < reference.cols(); ++i) {
        const double s = std::sin(k * reference(1, i));
        product += s * direction().dot(field.col(i));
        norm += s * s;
    }
    return product / norm;
}

double PlaneWave::block_angular_momentum(double side, double omega, double y, double t) const {
    return density * std::pow(side, 4) / 12.0 * omega * k * amplitude * std::cos(k * y) *
           std::sin(omega * t);
}

double PlaneWave::block_torque(double side, double y) const {
    return std::pow(side, 4) / 12.0 * solid.eta * k * k * k * amplitude * std::cos(k * y);
}

StandingWave standing_wave(Polarization polarization, int cells, double amplitude,
                           const Scheme& scheme) {
    const auto law = ElasticSolid::triangular_lattice();
    const double density = std::sqrt(4.0 / 3.0);
    StandingWave standing{{polarization, amplitude, 0.0, density, law},
                          triangular_solid(cells, cells, law, scheme, density, 0.0),
                          nullptr};
    standing.wave.k = 2.0 * std::numbers::pi / standing.wavelength();
    Scheme free = scheme;
    free.angular_momentum = AngularMomentum::free;
    const auto small = smallest_triangular_solid(law, free, density, 0.0);
    standing.modes = std::make_shared<const LatticeModes<2>>(*small.model, small.y0);
    auto& layout = standing.solid.model->layout();
    standing.wave.add_to(State<2>(layout, standing.solid.y0));
    const double speed = standing.omega_lattice() * amplitude;
    layout.set_scale(Field::velocity, speed);
    layout.set_scale(Field::energy, speed * speed);
    return standing;
}

}  // namespace spam
