// SPDX-License-Identifier: GPL-3.0-or-later
// A projectile on its way through a bar: how both are made, what is watched, and what is known of it.
#pragma once

#include "../breaking/flowing.hpp"
#include "../fragmenting_bar/target.hpp"
#include "pieces_in_motion.hpp"

namespace pierced_bar {

using namespace spam;

struct Parameters {
    Target target{.offset = 0.0};
    breaking::FlowingMatter matter{.core = 1.0};
    ContactKind contact_kind = ContactKind::repulsive;
    ContactScheme contact{.energy = 1.0};

    std::optional<ContactScheme> repulsion() const {
        if (contact_kind == ContactKind::none) return {};
        return contact;
    }
};

struct Shot {
    std::shared_ptr<ParticleModel<2>> model;
    const MaterialVectors<2>* law;  ///< of the model
    std::vector<double> y0;
};

/// Of how many particles what is called a piece has at least.
constexpr std::size_t least_particles = 5;

Shot make_shot(const Parameters& p);

/// `plastic_heat`, `pieces`, `largest_piece`, `closest_pair`.
std::vector<Column<2>> columns_of(const Shot& shot);

/// pieces.csv: where every piece is at every row, and how it turns.
void write_pieces(const RunFolder& folder, const PiecesInMotion& pieces);

void report(Session& session, const RunRecord& run, const PiecesInMotion& pieces);
void draw(Session& session, const std::vector<NearestState<2>>& drawn, const RunRecord& run,
          const PiecesInMotion& pieces);

}  // namespace pierced_bar
