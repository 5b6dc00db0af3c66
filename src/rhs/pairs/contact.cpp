// SPDX-License-Identifier: GPL-3.0-or-later
#include "../sweeps/term_sweeps.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parts.hpp>
#include <spam/neighbors/pair_list.hpp>
#include <spam/physics/core_potential.hpp>
#include <spam/rhs/contact.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

template <int Dim>
ContactScheme validated(const ContactScheme& scheme, const Particles<Dim>& particles) {
    if (!(scheme.energy > 0.0) || !std::isfinite(scheme.energy))
        throw InputError(
            fmt::format("contact: energy {:g} must be above 0, or bodies would pass through each "
                        "other; try 0.2",
                        scheme.energy));
    // What passes midway between two neighbours is half a spacing away from both.
    if (!(scheme.range >= 0.5 * particles.spacing) || !(scheme.range <= particles.spacing))
        throw InputError(fmt::format(
            "contact-range: {:g} must be at least half the spacing {:g}, or particles would pass "
            "between those of another body, and not above the spacing; 0.9 to 1 spacings are usual",
            scheme.range, particles.spacing));
    if (scheme.folds_beyond != 0.0 &&
        (!(scheme.folds_beyond > scheme.range) || !std::isfinite(scheme.folds_beyond)))
        throw InputError(fmt::format(
            "contact: particles of one body that are {:g} apart in the reference configuration are "
            "neighbours, which the contact range {:g} would push apart; use 2.5 spacings",
            scheme.folds_beyond, scheme.range));
    // A part of a run may hold one of several bodies.
    if (scheme.folds_beyond == 0.0 && Parts::here().alone() &&
        std::all_of(particles.body.begin(), particles.body.end(),
                    [&](std::int32_t body) { return body == particles.body.front(); }))
        throw InputError(
            "contact: one body that does not fold has nothing to touch; add another one, or leave "
            "the contact out");
    return scheme;
}

template <int Dim>
PairLaw<Dim> law_of(const ContactScheme& scheme, const Particles<Dim>& particles) {
    const bool folds = scheme.folds_beyond > 0.0;
    PairLaw<Dim> law{
        best_sweeps([](auto level) { return contact_sweeps<Dim, level>(); }), scheme.range,
        fmt::format("contact {:g} of range {:g} between bodies", scheme.energy, scheme.range)};
    if (folds)
        law.description += fmt::format(", and in each beyond {:g} of the reference configuration",
                                       scheme.folds_beyond);
    law.constants.core_energy = scheme.energy;
    law.constants.core_range = scheme.range;
    law.constants.apart = folds ? scheme.folds_beyond : 0.5;
    law.of_pair = [scheme, X = particles.reference_position, body = particles.body](
                      PairForce<Dim>& pair, const Point<Dim>& periods) {
        const double apart = (X.col(static_cast<Eigen::Index>(pair.i)) -
                              X.col(static_cast<Eigen::Index>(pair.j)) + periods)
                                 .norm();
        const bool touch = body[pair.i] != body[pair.j] ||
                           (scheme.folds_beyond > 0.0 && apart > scheme.folds_beyond);
        const CorePotential core{touch ? scheme.energy : 0.0, scheme.range};
        const double r2 = pair.r_ij.squaredNorm();
        pair.energy = core.energy(r2);
        pair.force_over_r = core.force_over_r(r2);
    };
    std::vector<double> body(particles.size());
    for (std::size_t i = 0; i < body.size(); ++i)
        body[i] = 2.0 * law.constants.apart * particles.body[i];
    law.columns.push_back(std::move(body));
    law.kinds.emplace_back();
    for (int a = 0; a < Dim; ++a) {
        std::vector<double> X(particles.size(), 0.0);
        for (std::size_t i = 0; folds && i < X.size(); ++i)
            X[i] = particles.reference_position(a, static_cast<Eigen::Index>(i));
        law.columns.push_back(std::move(X));
        law.kinds.push_back(
            {folds ? Quantity::position : Quantity::scalar, static_cast<unsigned char>(a), 0});
    }
    return law;
}

}  // namespace

template <int Dim>
Contact<Dim>::Contact(const Selection<Dim>& among, const ContactScheme& scheme)
    : PairTerm<Dim>(among, law_of(validated(scheme, among.particles()), among.particles())),
      scheme_(scheme),
      bodies_(among.particles().body) {}

template <int Dim>
double Contact<Dim>::closest(std::span<const double> y) const {
    const Points<Dim> x = this->state_of(y).position();
    const Points<Dim>& X = this->particles().reference_position;
    const Box<Dim>& box = this->box();
    const PairList<Dim> pairs(x, scheme_.range, box);
    double least = scheme_.range;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        for (const std::uint32_t j : pairs.neighbours(i)) {
            const auto difference = [&](const Points<Dim>& p) -> Point<Dim> {
                return p.col(static_cast<Eigen::Index>(i)) - p.col(static_cast<Eigen::Index>(j));
            };
            const Point<Dim> free = difference(x), r = box.nearest(free);
            const double apart = (difference(X) + (r - free)).norm();
            const bool folded = scheme_.folds_beyond > 0.0 && apart > scheme_.folds_beyond;
            if (folded || bodies_[i] != bodies_[j]) least = std::min(least, r.norm());
        }
    return least;
}

SPAM_COMPILED(template class Contact);

}  // namespace spam
