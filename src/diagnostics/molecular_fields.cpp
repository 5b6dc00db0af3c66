// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/tensor.hpp>
#include <spam/diagnostics/molecular_fields.hpp>
#include <spam/kernel/weight_integrals.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

/// Of the moments of a particle by mass: 1, v, both energies, the number, v v, and its virial.
template <int Dim>
struct MomentRows {
    static constexpr int size = symmetric_size(Dim);
    static constexpr int density = 0, momentum = 1, kinetic = 1 + Dim, potential = 2 + Dim,
                         number = 3 + Dim, flux = 4 + Dim, virial = flux + size,
                         all = virial + size;
};

/// factor r r, added to the components of a symmetric tensor.
template <int Dim, class Vector, class Numbers>
void add_square(double factor, const Vector& r, Numbers&& to) {
    for (int a = 0; a < Dim; ++a)
        for (int b = a; b < Dim; ++b) to[symmetric_index(Dim, a, b)] += factor * r[a] * r[b];
}

template <int Dim>
std::vector<PairForce<Dim>> pairs_of(const ParticleModel<Dim>& model, std::span<const double> y) {
    for (int a = 0; a < Dim; ++a)
        for (const bool upper : {false, true})
            if (model.box().wall(a, upper).has_images())
                throw InputError(fmt::format(
                    "walls: fields of molecules know no images behind the wall at the {}; "
                    "use a rigid one",
                    name_of_side(a, upper)));
    std::vector<PairForce<Dim>> all;
    for (const auto& term : model.terms()) {
        const auto* law = dynamic_cast<const ForcesOfPairs<Dim>*>(term.get());
        const auto pairs = law != nullptr ? law->pair_forces(y) : std::nullopt;
        if (!pairs)
            throw InputError(fmt::format(
                "model: the stress of '{}' is not known pair by pair; use pair potentials or springs",
                term->nature().description));
        all.insert(all.end(), pairs->begin(), pairs->end());
    }
    return all;
}

}  // namespace

template <int Dim>
MolecularFields<Dim>::MolecularFields(const AnyWeight<Dim>& weight, const ParticleModel<Dim>& model,
                                      std::span<const double> y)
    : weight_(weight),
      box_(model.box().without_walls()),
      particles_(weight, model.particles().mass, ConstState<Dim>(model.layout(), y).position(),
                 box_) {
    using Rows = MomentRows<Dim>;
    const ConstState<Dim> state(model.layout(), y);
    const Points<Dim> x = box_.wrapped(state.position());
    const std::vector<double>& mass = model.particles().mass;
    moments_ = Eigen::MatrixXd::Zero(Rows::all, x.cols());
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const auto v = state.velocity().col(i);
        moments_(Rows::density, i) = 1.0;
        moments_.col(i).template segment<Dim>(Rows::momentum) = v;
        moments_(Rows::kinetic, i) = 0.5 * v.squaredNorm();
        moments_(Rows::number, i) = 1.0 / mass[static_cast<std::size_t>(i)];
        add_square<Dim>(1.0, v, &moments_(Rows::flux, i));
    }
    double longest = 0.0;
    for (const PairForce<Dim>& pair : pairs_of(model, y)) {
        const auto i = static_cast<Eigen::Index>(pair.i), j = static_cast<Eigen::Index>(pair.j);
        for (const Eigen::Index end : {i, j}) {
            const double half = 0.5 * moments_(Rows::number, end);
            moments_(Rows::potential, end) += half * pair.energy;
            add_square<Dim>(half * pair.force_over_r, pair.r_ij, &moments_(Rows::virial, end));
        }
        if (pair.force_over_r == 0.0) continue;
        Point<Dim> middle = x.col(i) - 0.5 * pair.r_ij;
        for (int a = 0; a < Dim; ++a) middle[a] = box_.wrap(a, middle[a]);
        bonds_.push_back({middle, pair.r_ij, pair.force_over_r});
        longest = std::max(longest, pair.r_ij.norm());
    }
    reach_ = weight_.range() + 0.5 * longest;
    std::sort(bonds_.begin(), bonds_.end(),
              [](const Bond& a, const Bond& b) { return a.middle[0] < b.middle[0]; });
}

/// Sum of r_ij F_ij B_ij, of every image of a bond that the weight meets.
template <int Dim>
void MolecularFields<Dim>::add_bonds(const Point<Dim>& place, double* flux) const {
    Point<Dim> home = place;
    for (int a = 0; a < Dim; ++a) home[a] = box_.wrap(a, place[a]);
    std::array<int, Dim> beyond{};  // periods on either side
    int images = 1;
    for (int a = 0; a < Dim; ++a) {
        auto& n = beyond[static_cast<std::size_t>(a)];
        if (box_.periodic(a)) n = static_cast<int>(std::ceil(reach_ / box_.length(a)));
        images *= 2 * n + 1;
    }
    for (int image = 0; image < images; ++image) {
        Point<Dim> at = home;
        int rest = image;
        for (int a = 0; a < Dim; ++a) {
            const int n = beyond[static_cast<std::size_t>(a)];
            at[a] += (rest % (2 * n + 1) - n) * box_.length(a);
            rest /= 2 * n + 1;
        }
        auto bond =
            std::lower_bound(bonds_.begin(), bonds_.end(), at[0] - reach_,
                             [](const Bond& one, double least) { return one.middle[0] < least; });
        for (; bond != bonds_.end() && bond->middle[0] < at[0] + reach_; ++bond) {
            const Point<Dim> from = at - bond->middle - 0.5 * bond->r_ij;
            const Point<Dim> to = from + bond->r_ij;
            const double span = weight_.range() + 0.5 * bond->r_ij.norm();
            if ((0.5 * (from + to)).squaredNorm() < span * span)
                add_square<Dim>(bond->force_over_r * mean_along(weight_, from, to), bond->r_ij,
                                flux);
        }
    }
}

/// MomentRows x M; rows of the flux complete.
template <int Dim>
Eigen::MatrixXd MolecularFields<Dim>::sums(const Places& places, BondStress stress) const {
    using Rows = MomentRows<Dim>;
    Eigen::MatrixXd sums = particles_.sum(moments_, places);
    if (stress == BondStress::at_particles)
        sums.middleRows<Rows::size>(Rows::flux) += sums.middleRows<Rows::size>(Rows::virial);
    else
        parallel_for(static_cast<std::size_t>(places.cols()), [&](std::size_t k) {
            const auto p = static_cast<Eigen::Index>(k);
            add_bonds(places.col(p), &sums(Rows::flux, p));
        });
    return sums;
}

template <int Dim>
Eigen::MatrixXd MolecularFields<Dim>::momentum_flux(const Places& places, BondStress stress) const {
    return sums(places, stress).template middleRows<MomentRows<Dim>::size>(MomentRows<Dim>::flux);
}

template <int Dim>
auto MolecularFields<Dim>::at(const Places& places, BondStress stress) const -> Values {
    using Rows = MomentRows<Dim>;
    const Eigen::MatrixXd all = sums(places, stress);
    Values values{all.row(Rows::density), all.template middleRows<Dim>(Rows::momentum),
                  Eigen::RowVectorXd(places.cols()),
                  all.row(Rows::kinetic) + all.row(Rows::potential),
                  all.template middleRows<Rows::size>(Rows::flux)};
    for (Eigen::Index p = 0; p < places.cols(); ++p) {
        const double rho = values.density(p);
        auto u = values.velocity.col(p);
        u /= rho;  // 0/0 where nothing is near
        values.temperature(p) =
            (2.0 * all(Rows::kinetic, p) - rho * u.squaredNorm()) / (Dim * all(Rows::number, p));
        if (rho > 0.0) add_square<Dim>(-rho, u, values.pressure.col(p));
    }
    return values;
}

SPAM_COMPILED(template class MolecularFields);

}  // namespace spam
