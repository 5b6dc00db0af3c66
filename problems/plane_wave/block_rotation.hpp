// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/model.hpp>

namespace spam {

/// How a square block of material turns, [HHM04] III B and V.
struct BlockRotation {
    double angular_momentum = 0.0;  ///< sum m (dx dv_y - dy dv_x), about the block's centre of mass
    double second_moment = 0.0;     ///< sum m dy^2, likewise; rho side^4/12 of a continuum
};

/// Of the side x side block whose particles' reference positions surround `centre` (periodic images
/// included); it moves with the material. `velocity`: Dim x N; accelerations give the rate instead.
/// Which particles belong to a block smaller than a few spacings depends on where it lies: the mean
/// over `shifts` x `shifts` centres, evenly spread over a unit of lattice (1 x sqrt(3/4) spacings),
/// does not.
BlockRotation block_rotation(const Model<2>& model, const Points<2>& position,
                             const Points<2>& velocity, const Point<2>& centre, double side,
                             int shifts = 6);

}  // namespace spam
