// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/box.hpp>

#include <vector>

namespace spam {

/// Images of particles behind the walls of a box, for averages of neighbours near them.
template <int Dim>
struct WallImages {
    Points<Dim> position, velocity;
    std::vector<Eigen::Index> owner;

    Eigen::Index count() const { return position.cols(); }
    /// Columns of the particles, then those of the images: the same values as their owners'.
    Eigen::MatrixXd with_particles(const Eigen::Ref<const Eigen::MatrixXd>& of_particles) const;
};

/// All within `reach` of a wall; of particles at `position` with `velocity`, Dim x N.
template <int Dim>
WallImages<Dim> images_behind_walls(const Box<Dim>& box, double reach, const Points<Dim>& position,
                                    const Points<Dim>& velocity);

}  // namespace spam
