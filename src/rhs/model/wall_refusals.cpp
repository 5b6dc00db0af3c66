// SPDX-License-Identifier: GPL-3.0-or-later
// Which particles and laws do not go together with the walls of a box.
#include <spam/core/error.hpp>
#include <spam/rhs/particle_model.hpp>

#include <fmt/format.h>

namespace spam {

template <int Dim>
void ParticleModel<Dim>::refuse_beyond_walls() const {
    const Points<Dim>& x = this->particles().reference_position;
    for_each_wall([&](int a, bool upper, const Wall<Dim>& wall) {
        for (Eigen::Index i = 0; i < x.cols(); ++i)
            if (upper ? x(a, i) > wall.at : x(a, i) < wall.at)
                throw InputError(fmt::format(
                    "{}: particle {} at {} = {:g} is beyond the {} wall at {:g}; move the body "
                    "or the wall",
                    name_of_side(a, upper), this->particles().id[static_cast<std::size_t>(i)],
                    "xyz"[a], x(a, i), wall.describe(), wall.at));
    });
}

/// Images have to mean something to the law; a rigid wall stops what moves with its own velocity.
template <int Dim>
void ParticleModel<Dim>::refuse_walls(const Term<Dim>& term) const {
    const auto& nature = term.nature();
    const auto no_images = [&](const Wall<Dim>& wall) -> std::string {
        if (!nature.no_images.empty()) return nature.no_images;
        if (nature.potential && wall.passes_energy())
            return "forces from a potential feel neither the velocity nor the temperature of a wall; use a "
                   "mirror";
        if (nature.own_heat && wall.passes_energy())
            return fmt::format(
                "a wall that exchanges energy cannot take up the heat of '{}'; use a mirror",
                nature.description);
        if (wall.temperature && !nature.conducts)
            return "nothing here conducts heat, and the temperature behind a wall has no effect; leave it "
                   "out";
        return {};
    };
    std::string reason, first, others;  // the same of other sides
    for_each_wall([&](int a, bool upper, const Wall<Dim>& wall) {
        const std::string why = wall.has_images() ? no_images(wall)
                                : !nature.moves_with_velocity
                                    ? "a rigid wall turns the velocity of a particle back, and "
                                      "particles that move with another velocity go on through "
                                      "it; use a mirror, or --transport plain"
                                    : "";
        if (why.empty()) return;
        if (reason.empty()) {
            reason = why;
            first = name_of_side(a, upper);
        } else if (why == reason) {
            others.append(others.empty() ? "" : ", ").append(name_of_side(a, upper));
        }
    });
    if (!reason.empty())
        throw InputError(fmt::format("{}: {}{}", first, reason,
                                     others.empty() ? "" : fmt::format(" (likewise {})", others)));
}

#define SPAM_INSTANTIATE(D)                                      \
    template void ParticleModel<D>::refuse_beyond_walls() const; \
    template void ParticleModel<D>::refuse_walls(const Term<D>&) const;
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
