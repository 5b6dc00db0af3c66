// SPDX-License-Identifier: GPL-3.0-or-later
// The finite-element twin of the tension test, [HH07] 13.
#pragma once

#include "../common.hpp"
#include <spam/material/plastic_fields.hpp>
#include <spam/rhs/elements.hpp>

namespace tension_elements {

using namespace spam;

/// `columns` x `rows` elements, heights `taper` less at the middle, drawn out at both ends. The material is that
/// of the triangular lattice, lambda = eta = sqrt(3/16), rho = sqrt(4/3), with the yield stress of the plane law.
struct Parameters {
    int columns = 60, rows = 12;
    double taper = 0.1;
    double end_speed = 0.0469;  ///< of each end along x; across it the ends are free
    double yield_stress = 0.0115, hardening = 0.0;
    double failure_strain = Failure::never;
    HourglassControl hourglass{0.1, 0.0};
};

struct Bar {
    std::shared_ptr<ParticleModel<2>> model;
    std::vector<double> y0;  ///< velocities in proportion to x, so that no wave comes from the ends
    double strain_rate;      ///< of the whole, in parts of its first length
};

/// Throws InputError where a number makes no sense.
Bar make_bar(const Parameters& p);

/// Plastic strains of all elements, in the order of the mesh: row by row from the lower left.
Eigen::RowVectorXd plastic_strains(const Model<2>& model, std::span<const double> y);

/// Distance of the lowest column of nodes from the middle, in elements.
double neck(const Parameters& p, const Model<2>& model, std::span<const double> y);

/// `largest_plastic_strain`, `mean_plastic_strain`, `neck`, `neck_height`, `length`, `elements_broken`.
std::vector<Column<2>> columns_of(const Parameters& p);

/// Until `t_end`, with checks and pictures. `known`: whether all parameters are as above, so that something is
/// known of the run.
void compute(Session& session, const Parameters& p, double t_end, bool known);

}  // namespace tension_elements
