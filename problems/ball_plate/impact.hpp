// SPDX-License-Identifier: GPL-3.0-or-later
// A ball on its way into a plate: how both are made, what is watched, and what is known of it.
#pragma once

#include "../breaking/element_frames.hpp"
#include "../breaking/matter.hpp"

namespace ball_plate {

using namespace breaking;

enum class Ends { free, held };
std::string_view to_string(Ends ends);

struct Parameters {
    Matter matter;
    double speed = 1.0;
    bool compare = false;
    double radius = 8.0;
    int columns = 80, rows = 8;
    double gap = 1.1;
    std::optional<double> travel;  ///< by default that of the lecture's numbers
    Ends ends = Ends::free;
    /// How particles of ball and plate act on each other: like neighbours of one body, or by repulsion alone.
    ContactKind contact_kind = ContactKind::none;
    ContactScheme contact{.energy = 1.0};  ///< of ContactKind::repulsive

    /// Elements have no neighbours but those of their mesh: ball and plate meet by a contact or not at all.
    std::optional<ContactScheme> repulsion() const {
        if (contact_kind == ContactKind::none && matter.kind != MatterKind::elements) return {};
        return contact;
    }

    double travelled() const {
        return travel.value_or(matter.kind == MatterKind::pair_md    ? 75.0
                               : matter.kind == MatterKind::elements ? 125.0
                                                                     : 20.0);
    }
};

constexpr std::int32_t ball = 0, plate = 1;  ///< bodies

struct Impact : Variant<2> {
    double speed;
};

/// Of the lecture.
std::vector<double> speeds_of(MatterKind kind);
/// Of classical Runge-Kutta.
double step_of(const Parameters& p);

/// The ball moves downwards.
Impact make_impact(const Session& session, const Parameters& p, double speed);

/// `ball_speed`, `pieces`, `largest_piece`, `closest_pair`; of elements those of their own.
std::vector<Column<2>> columns_of(const Parameters& p);

void report(Session& session, const Parameters& p, const Impact& impact, const RunRecord& run);
/// The states kept of one impact, or how several have ended.
void draw(Session& session, const Parameters& p, const std::vector<Impact>& impacts,
          const std::vector<RunRecord>& runs);

}  // namespace ball_plate
