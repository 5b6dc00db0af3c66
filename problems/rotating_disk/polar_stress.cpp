// SPDX-License-Identifier: GPL-3.0-or-later
#include "polar_stress.hpp"

using namespace spam;

namespace {

/// From the centre; any direction at the centre itself.
Point<2> direction(const Point<2>& r) {
    return r.norm() > 0.0 ? Point<2>(r.normalized()) : Point<2>::UnitX();
}

/// 3 x N: xx, yy, xy.
Points<3> cartesian_stress(const Model<2>& model, std::span<const double> y, double density) {
    const auto* bonded = dynamic_cast<const BondedModel<2>*>(&model);
    if (bonded == nullptr) return ConstState<2>(model.layout(), y).stress();
    const auto virial = bonded->law.stress(y, 1.0 / density);
    Points<3> all(3, static_cast<Eigen::Index>(virial.size()));
    for (Eigen::Index i = 0; i < all.cols(); ++i)
        all.col(i) = Point<3>::Map(virial[static_cast<std::size_t>(i)].c.data());
    return all;
}

}  // namespace

PolarStress polar_stress(const Model<2>& model, std::span<const double> y, double density) {
    const Points<3> stress = cartesian_stress(model, y, density);
    const Points<2> x = ConstState<2>(model.layout(), y).position();
    const Point<2> centre = x.rowwise().mean();
    PolarStress all;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const Point<2> n = direction(x.col(i) - centre);
        const double xx = stress(0, i), yy = stress(1, i), xy = stress(2, i);
        all.r.push_back(model.particles().reference_position.col(i).norm());
        all.radial.push_back(xx * n.x() * n.x() + yy * n.y() * n.y() + 2.0 * xy * n.x() * n.y());
        all.hoop.push_back(xx * n.y() * n.y() + yy * n.x() * n.x() - 2.0 * xy * n.x() * n.y());
        all.shear.push_back((yy - xx) * n.x() * n.y() + xy * (n.x() * n.x() - n.y() * n.y()));
    }
    return all;
}
