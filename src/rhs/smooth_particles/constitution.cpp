// SPDX-License-Identifier: GPL-3.0-or-later
#include "constitution.hpp"

#include <spam/core/error.hpp>

#include <fmt/format.h>

namespace spam {

template <int Dim>
void check_materials(const Particles<Dim>& particles, std::size_t materials) {
    if (!particles.material.empty() && particles.material.size() != particles.size())
        throw InputError(fmt::format("material: {} numbers for {} particles; give one for each",
                                     particles.material.size(), particles.size()));
    for (std::size_t i = 0; i < particles.material.size(); ++i)
        if (particles.material[i] < 0 ||
            static_cast<std::size_t>(particles.material[i]) >= materials)
            throw InputError(
                fmt::format("material: particle {} has number {}, and there are {} materials, from "
                            "0 on",
                            particles.id[i], particles.material[i], materials));
}

#define SPAM_INSTANTIATE(D) template void check_materials(const Particles<D>&, std::size_t);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
