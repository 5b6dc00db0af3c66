// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of rotating_body share.
#pragma once

#include "../solid_choice.hpp"
#include "top.hpp"

namespace rotating_body {

using namespace spam;

enum class Shape { cube, ball, block };
inline std::string_view to_string(Shape shape) {
    return shape == Shape::cube ? "cube" : shape == Shape::ball ? "ball" : "block";
}

struct Parameters {
    Shape shape = Shape::cube;
    int size = 7;
    std::optional<double> speed{}, turns{};
    SolidChoice solid{.formulation = Formulation::updated};
    bool compare = false;

    bool block() const { return shape == Shape::block; }
};

/// One run. Axes 1, 2, 3 of the body are x, y, z at the start.
struct Body : Variant<3> {
    double speed = 0.0;
    Point<3> inertia;       ///< of the lattice at rest
    Point<3> omega;         ///< at the start
    Points<3> reference{};  ///< about the centre
    const SmoothParticles<3>* smooth = nullptr;

    double turn() const { return 2.0 * std::numbers::pi / omega.norm(); }
    FreeTop top() const { return {inertia, omega[0], omega[1]}; }
};
Body make_body(const Parameters& p, Formulation formulation, double speed, const Scheme& scheme);

/// Angular velocity about the body's own axes: of L and the inertia at rest, by the rotation that brings the shape at
/// rest nearest to that of now.
std::vector<Column<3>> own_angular_velocity(const Body& body);

/// Times at which omega_2 changes its sign, linear between rows.
std::vector<double> flips(const History& h);

void draw(Session& session, const Parameters& p, const std::vector<Body>& bodies,
          const std::vector<RunRecord>& runs);

}  // namespace rotating_body
