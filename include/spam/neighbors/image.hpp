// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/quantity.hpp>

#include <array>
#include <cstddef>

namespace spam {

/// A number of a record: which component of what.
struct NumberKind {
    Quantity quantity = Quantity::scalar;
    unsigned char a = 0, b = 0;
};

/// How an image is made from a particle, number by number: n' = sign n + shift.
template <int Dim>
struct Image {
    struct Change {
        double sign = 1.0, shift = 0.0;

        Change then(const Change& next) const {
            return {next.sign * sign, next.sign * shift + next.shift};
        }
    };
    std::array<Change, Dim> position, velocity, stress, heat_flux;  ///< of the latter two the signs
    Change temperature;

    /// The image of this image.
    Image then(const Image& next) const {
        Image both;
        for (std::size_t a = 0; a < Dim; ++a) {
            both.position[a] = position[a].then(next.position[a]);
            both.velocity[a] = velocity[a].then(next.velocity[a]);
            both.stress[a] = stress[a].then(next.stress[a]);
            both.heat_flux[a] = heat_flux[a].then(next.heat_flux[a]);
        }
        both.temperature = temperature.then(next.temperature);
        return both;
    }

    Change of(const NumberKind& number) const {
        const std::size_t a = number.a, b = number.b;
        switch (number.quantity) {
            case Quantity::scalar:
                break;
            case Quantity::position:
                return position[a];
            case Quantity::velocity:
                return velocity[a];
            case Quantity::temperature:
                return temperature;
            case Quantity::stress:
                return {stress[a].sign * stress[b].sign, 0.0};
            case Quantity::heat_flux:
                return {heat_flux[a].sign, 0.0};
            case Quantity::vector:
                return {position[a].sign, 0.0};
            case Quantity::tensor:
                return {position[a].sign * position[b].sign, 0.0};
        }
        return {};
    }
};

}  // namespace spam
