// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/fluid_record.hpp>
#include <spam/physics/heat_flow.hpp>
#include <spam/physics/mean_density.hpp>

namespace spam {

/// Of a particle with a concentration c, which passes as a temperature does: `Temperature` holds c, `HeatFlux` the
/// flux by rho^2.
template <int Dim, class T = double>
using ConcentrationRecord =
    typename PointRecord<Dim, T>::template And<column::Density, column::Temperature>;
template <int Dim, class T = double>
using SpeciesRecord = typename ConcentrationRecord<Dim, T>::template And<column::HeatFlux>;

/// Fick's law, Q_i = -D rho_i (grad c)_i, with the gradient of temperatures (heat_flow.hpp), as HeatFlow takes it:
/// by rho_i^2.
template <int Dim>
struct FickFlux {
    using Gradient = TemperatureGradient<Dim, ArithmeticMean>;
    template <class T>
    using Sums = typename Gradient::template Sums<T>;

    double diffusivity;
    static FickFlux with(const PassConstants& c) { return {c.conductivity}; }
    template <class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) {
        Gradient{}.add(pair, i, j, sums);
    }
    template <class T, class Record>
    Vec<Dim, T> result(const Record& i, const Sums<T>& sums) const {
        return (T(-diffusivity) / i.rho) * sums.value();
    }
    template <class To, class T>
    static void store(const To& to, const Vec<Dim, T>& q) {
        to.template write<SpeciesRecord<Dim>, column::HeatFlux>(q);
    }
};

}  // namespace spam
