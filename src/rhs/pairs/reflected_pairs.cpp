// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/neighbors/pair_list.hpp>
#include <spam/physics/closest_approach.hpp>
#include <spam/rhs/particle_model.hpp>
#include <spam/rhs/reflected_pairs.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace spam {

template <int Dim>
ReflectedPairs<Dim>::ReflectedPairs(const Selection<Dim>& among, double distance)
    : Term<Dim>(among) {
    const Scheme scheme{.closest_approach = distance};
    scheme.validate(Dim);
    if (distance == 0.0)
        throw InputError("closest-approach: 0 reflects no pair; use 0.5 to 0.9 spacings");
    scheme.validate_distances(this->particles().spacing);
    require_one_image(this->box(), 1.001 * distance);
    this->nature_.description = fmt::format("approaching pairs reflected at {:g}", distance);
    this->nature_.potential = false;
    this->nature_.no_images =
        "the closest approach is of pairs of particles and lets them come nearer to a wall; leave "
        "--closest-approach out";
    this->nature_.events = [this, distance](const std::vector<bool>& held) {
        const auto& model = static_cast<const ParticleModel<Dim>&>(this->model());
        return std::vector<Event>{closest_approach_event<Dim>(
            {this->particles().mass, this->box(), distance, model.moves_with_velocity()},
            this->layout(), held, this->among().first())};
    };
}

template <int Dim>
std::string ReflectedPairs<Dim>::rates(const Now& now) {
    std::fill_n(now.v_dot, Dim * this->particles().size(), 0.0);
    return {};
}

SPAM_COMPILED(template class ReflectedPairs);

}  // namespace spam
