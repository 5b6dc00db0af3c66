// SPDX-License-Identifier: GPL-3.0-or-later
// The finite-element twin of the ball that hits a plate, [HH07] 13.
#pragma once

#include "../common.hpp"
#include <spam/rhs/elements.hpp>

namespace ball_plate_elements {

using namespace spam;

/// A ball of ball_side x ball_side elements above a plate of columns x rows elements of side 1, both of the
/// material of the triangular lattice, lambda = eta = sqrt(3/16), rho = sqrt(4/3), which yields and breaks: an
/// element whose plastic strain has passed `failure_strain` is removed. Nodes of one meet those of the other by a
/// core.
struct Parameters {
    double speed = 0.5;  ///< of the ball, downwards
    int ball_side = 14;
    double radius = 8.0;
    int columns = 80, rows = 8;
    double gap = 1.1;
    double yield_stress = 0.05, hardening = 0.0;
    double failure_strain = 1.0;
    HourglassControl hourglass{0.1, 0.0};
    ContactScheme contact{1.0, 1.0};
    bool held = true;  ///< the ends of the plate
};

constexpr std::int32_t ball = 0, plate = 1;  ///< bodies
/// Of rk4: contacts ask for it.
constexpr double step = 0.05;

struct Impact {
    std::shared_ptr<ParticleModel<2>> model;
    std::vector<double> y0;
};

/// Throws InputError where a number makes no sense.
Impact make_impact(const Parameters& p);

/// Of the ball's centre of mass, downwards.
double ball_speed(const Model<2>& model, std::span<const double> y);

/// `ball_speed`, `elements_broken`, `largest_plastic_strain`, `sag` (how far the plate's centre of mass is below its
/// first place).
std::vector<Column<2>> columns_of();

}  // namespace ball_plate_elements
