// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>
#include <spam/core/vec.hpp>

#include <array>
#include <cmath>

namespace spam {

/// Free or periodic space, direction by direction. Positions in y are never wrapped; images are
/// taken when separations are formed.
template <int Dim>
class Box {
  public:
    /// Free space in every direction.
    Box() = default;

    /// Periodic in each direction whose length is finite and positive; a length 0 leaves it free.
    explicit Box(const std::array<double, Dim>& lengths) {
        for (std::size_t a = 0; a < Dim; ++a) {
            if (lengths[a] <= 0.0) continue;
            length_[a] = lengths[a];
            inverse_[a] = 1.0 / lengths[a];
        }
    }

    bool periodic(int a) const { return length_[at(a)] > 0.0; }
    bool periodic() const {
        for (int a = 0; a < Dim; ++a)
            if (periodic(a)) return true;
        return false;
    }
    double length(int a) const { return length_[at(a)]; }

    /// The image of x inside [0, L) (a free coordinate is returned as it is).
    double wrap(int a, double x) const {
        const double w = x - length_[at(a)] * std::floor(x * inverse_[at(a)]);
        return periodic(a) && w >= length_[at(a)] ? 0.0 : w;
    }

    /// All positions (Dim x N) wrapped.
    Points<Dim> wrapped(Points<Dim> position) const {
        for (int a = 0; a < Dim; ++a)
            if (periodic(a))
                for (Eigen::Index i = 0; i < position.cols(); ++i)
                    position(a, i) = wrap(a, position(a, i));
        return position;
    }

    /// Smallest image of a separation of two wrapped coordinates, |s| < L. No branch: in a free
    /// direction zero is subtracted. Exactly antisymmetric.
    template <class T>
    T nearest_image(int a, const T& s) const {
        return s - T(length_[at(a)]) * nearest_integer(s * T(inverse_[at(a)]));
    }

  private:
    static constexpr std::size_t at(int a) { return static_cast<std::size_t>(a); }
    std::array<double, Dim> length_{};
    std::array<double, Dim> inverse_{};
};

}  // namespace spam
