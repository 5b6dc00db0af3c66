// SPDX-License-Identifier: GPL-3.0-or-later
#include "zero_modes.hpp"

#include <spam/physics/quadrilateral.hpp>
#include <spam/setup/meshes.hpp>

#include <gsl/gsl_linalg.h>

namespace mesh_modes {

std::string_view to_string(Mode mode) {
    switch (mode) {
        case Mode::hourglass_x:
            return "hourglass_x";
        case Mode::hourglass_y:
            return "hourglass_y";
        case Mode::butterfly:
            break;
    }
    return "butterfly";
}

std::unique_ptr<ParticleModel<2>> make_mesh(int n, const HourglassControl& control) {
    const double density = triangular_density;
    MeshedBodies bodies = make_nodes({rectangle_mesh(n, n)}, density);
    auto model = std::make_unique<ParticleModel<2>>(std::move(bodies.nodes));
    model->add_term<Elements>(
        std::move(bodies.element),
        std::vector<Elements::Material>{{ElasticSolid::triangular_lattice(), density, control}});
    return model;
}

Points<2> velocities(const ParticleModel<2>& mesh, Mode mode) {
    const Points<2>& x = mesh.particles().reference_position;
    const Point<2> corner = x.rowwise().minCoeff();
    Points<2> v = Points<2>::Zero(2, x.cols());
    for (Eigen::Index k = 0; k < x.cols(); ++k) {
        const Point<2> place = x.col(k) - corner;
        const double s = std::lround(place.x() + place.y()) % 2 == 0 ? 1.0 : -1.0;
        if (mode == Mode::butterfly)
            v.col(k) = s * Point<2>(x(0, k), -x(1, k));
        else
            v(mode == Mode::hourglass_x ? 0 : 1, k) = s;
    }
    return v / v.cwiseAbs().maxCoeff();
}

namespace {

/// Of the mesh in its reference configuration: 3 x elements.
Eigen::MatrixXd stress_rates(ParticleModel<2>& mesh, const Points<2>& v) {
    std::vector<double> y(mesh.layout().size(), 0.0), y_dot(y.size());
    const State<2> state(mesh.layout(), y);
    state.position() = mesh.particles().reference_position;
    state.velocity() = v;
    mesh.rates(0.0, y, y_dot);
    return State<2>(mesh.layout(), y_dot).elements().stress();
}

}  // namespace

namespace {

/// Descending. By GSL: of Eigen's decomposition this one function would be compiled longer than any other file.
Eigen::VectorXd singular_values(const Eigen::MatrixXd& of) {
    Eigen::MatrixXd rows = of;  // GSL counts by rows, of which it wants as many as columns or more
    if (rows.cols() < rows.rows()) rows.transposeInPlace();
    const auto n = static_cast<std::size_t>(rows.rows());
    Eigen::MatrixXd right(rows.rows(), rows.rows());
    Eigen::VectorXd values(rows.rows()), work(rows.rows());
    auto a = gsl_matrix_view_array(rows.data(), static_cast<std::size_t>(rows.cols()), n);
    auto v = gsl_matrix_view_array(right.data(), n, n);
    auto s = gsl_vector_view_array(values.data(), n), w = gsl_vector_view_array(work.data(), n);
    gsl_linalg_SV_decomp(&a.matrix, &v.matrix, &s.vector, &w.vector);
    return values;
}

}  // namespace

double stress_rate(ParticleModel<2>& mesh, const Points<2>& v) {
    return stress_rates(mesh, v).cwiseAbs().maxCoeff();
}

std::vector<double> turns(const ParticleModel<2>& mesh, const Points<2>& displacement) {
    const Points<2>& X = mesh.particles().reference_position;
    std::vector<double> all;
    for (const Quadrilateral& corners : mesh.quadrilaterals()) {
        std::array<Vec<2>, 4> x, u;
        for (std::size_t c = 0; c < 4; ++c) {
            x[c] = {{X(0, corners[c]), X(1, corners[c])}};
            u[c] = {{displacement(0, corners[c]), displacement(1, corners[c])}};
        }
        const Mat<2> grad = QuadrilateralShape<>(x).gradient(u);
        all.push_back(0.5 * (grad(0, 1) - grad(1, 0)));
    }
    return all;
}

ZeroModes zero_modes(ParticleModel<2>& mesh) {
    const auto nodes = static_cast<Eigen::Index>(mesh.particles().size());
    const auto elements = static_cast<Eigen::Index>(mesh.quadrilaterals().size());
    Eigen::MatrixXd all(3 * elements, 2 * nodes);
    for (Eigen::Index k = 0; k < 2 * nodes; ++k) {
        Points<2> v = Points<2>::Zero(2, nodes);
        v(k % 2, k / 2) = 1.0;
        all.col(k) = stress_rates(mesh, v).reshaped();
    }
    const Eigen::VectorXd values = singular_values(all);
    Eigen::Index rank = 0;
    while (rank < values.size() && values[rank] > 1e-9 * values[0]) ++rank;
    const double next = rank < values.size() ? values[rank] : 0.0;
    return {static_cast<int>(2 * nodes - rank) - 3,
            values[rank - 1] / std::max(next, 1e-16 * values[0])};
}

}  // namespace mesh_modes
