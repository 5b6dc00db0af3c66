// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/pair_term.hpp>

namespace spam {

/// How bodies touch.
struct ContactScheme {
    double energy = 0.2;  ///< e_c, of two particles at one place; 0.1 to 0.3 of m c^2 are usual
    double range = 1.0;   ///< s, half a spacing to a spacing; 0.9 to 1 spacings are usual
    /// Above 0: particles of one body touch as well, where they are farther apart than this in the
    /// reference configuration. For bodies that may fold; 2.5 spacings are usual.
    double folds_beyond = 0.0;
};

/// Contact of bodies without adhesion and friction: particles of different bodies repel each other by
/// phi = e_c (1 - r^2/s^2)^4 inside s (physics/contact_potential.hpp). p is kept exactly, L and E to
/// integrator error. It acts among all bodies; the law that holds a body together must act in each of them
/// alone (ParticleModel::add_term_among), or it would glue them to each other.
///
/// Bodies are those of Particles::body when the term is made, and stay so: what a run later finds to be
/// connected (Model::set_bodies) does not change which particles repel each other. In a box with mirrors
/// the image of a particle is of its body.
template <int Dim>
class Contact final : public PairTerm<Dim> {
  public:
    /// Throws InputError for an energy that is not above 0, a range below half the spacing (particles would
    /// pass between those of another body) or above it (bodies would be pushed apart that do not overlap),
    /// folds_beyond that is neither 0 nor above the range, one
    /// body that does not fold, and a periodic box narrower than a fifth of the range.
    Contact(const Selection<Dim>& among, const ContactScheme& scheme);

    const ContactScheme& scheme() const { return scheme_; }
    /// Distance of the closest two particles that touch; the range where none do. Without images behind
    /// walls.
    double closest(std::span<const double> y) const;

  private:
    ContactScheme scheme_;
    std::vector<std::int32_t> bodies_;  ///< as they were when this was made
};

SPAM_COMPILED(extern template class Contact);

}  // namespace spam
