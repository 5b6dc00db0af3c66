// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>
#include <spam/neighbors/image.hpp>

#include <optional>
#include <string>

namespace spam {

/// "left", "right", "bottom", "top", "front", "back": the lower and the upper side across x, y, z.
constexpr const char* name_of_side(int a, bool upper) {
    constexpr const char* names[]{"left", "right", "bottom", "top", "front", "back"};
    return names[2 * a + (upper ? 1 : 0)];
}

/// What one side of a box is.
enum class WallKind {
    open,
    mirror,   ///< the images' velocity across the wall is opposite: slip without friction
    no_slip,  ///< images have velocity 2 V - v: matter sticks to a wall that moves with V
    rigid,    ///< no images: a particle that has passed is turned back, v_n -> -v_n
};

/// A plane wall across one direction. A mirror and a no-slip wall act by images of the particles before them,
/// [HH07] 7: an image has the owner's density and pressure; its velocity and temperature are those that make
/// the mean of both that of the wall. Insulated, unless a temperature is given.
///
/// A rigid wall is met by particles one by one and acts by nothing else, so that every law of matter takes it
/// that moves particles with their own velocities. There is nothing behind it: sums over neighbours, a
/// density above all, have half of their parts there, and a fluid is drawn to it. A particle is turned back
/// at the end of the step in which it has passed, where it is: neither kind of energy changes, and it may
/// stand behind the wall by what it goes in a step.
template <int Dim>
struct Wall {
    /// What the side does to particles before it.
    WallKind kind = WallKind::open;
    double at = 0.0;                           ///< its coordinate
    Point<Dim> velocity = Point<Dim>::Zero();  ///< of no_slip, along the wall
    /// Of what is behind the wall, in the units of the run, above 0; without one the wall is insulated.
    std::optional<double> temperature = std::nullopt;

    /// Whether there is no wall at all.
    bool open() const { return kind == WallKind::open; }
    /// Whether it acts by images.
    bool has_images() const { return kind == WallKind::mirror || kind == WallKind::no_slip; }
    /// Whether energy passes it: friction heats and moves matter, a temperature warms or cools it.
    bool passes_energy() const { return kind == WallKind::no_slip || temperature.has_value(); }

    /// Image behind the wall across direction `axis`. Precondition: has_images().
    Image<Dim> image(int axis) const {
        const auto a = static_cast<std::size_t>(axis);
        Image<Dim> image;
        image.position[a] = {-1.0, 2.0 * at};
        if (kind == WallKind::no_slip)
            for (std::size_t b = 0; b < Dim; ++b)
                image.velocity[b] = {-1.0, 2.0 * velocity[static_cast<Eigen::Index>(b)]};
        else
            image.velocity[a].sign = image.stress[a].sign = -1.0;
        if (temperature)
            image.temperature = {-1.0, 2.0 * *temperature};
        else
            image.heat_flux[a].sign = -1.0;
        return image;
    }

    /// "mirror", "no-slip", "rigid", "moving with (0.5, 0), T = 1.5"
    std::string describe() const;
};

}  // namespace spam
