// SPDX-License-Identifier: GPL-3.0-or-later
// A ball on its way into a plate: how both are made, what is watched, and what is known of it.
#pragma once

#include "../breaking/element_frames.hpp"
#include "../breaking/matter.hpp"
#include "parted_pieces.hpp"

namespace ball_plate {

using namespace breaking;

enum class Ends { free, held };
std::string_view to_string(Ends ends);

struct Parameters {
    int dimension = 2;
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
        return travel.value_or(matter.kind == MatterKind::pair_md ? (dimension == 3 ? 48.0 : 75.0)
                               : matter.kind == MatterKind::elements ? 125.0
                                                                     : 20.0);
    }
};

/// Bodies in space are crystals that fit each other: it breaks their symmetry, as rounding errors would, and no more.
constexpr double disorder_in_space = 1e-10;

constexpr std::int32_t ball = 0, plate = 1;  ///< bodies

template <int Dim>
struct Impact : Variant<Dim> {
    double speed;
    int seed;
    /// In space.
    std::unique_ptr<PartedPieces> parted = Dim == 3 ? std::make_unique<PartedPieces>() : nullptr;
};

/// Of the lecture.
std::vector<double> speeds_of(MatterKind kind);
/// How many of them are compared: several where what is known is a mean.
int seeds_of(const Parameters& p, double speed);
/// Of classical Runge-Kutta.
double step_of(const Parameters& p);

/// The ball moves downwards.
template <int Dim>
Impact<Dim> make_impact(const Session& session, const Parameters& p, double speed);

/// `ball_speed`, `pieces`, `largest_piece`, `closest_pair`; of elements those of their own.
template <int Dim>
std::vector<Column<Dim>> columns_of(const Parameters& p);

template <int Dim>
void report(Session& session, const Parameters& p, const Impact<Dim>& impact, const RunRecord& run);
/// How runs that differ in their seeds alone have ended in the mean.
void report_seeds(Session& session, const Parameters& p, const std::vector<Impact<3>>& impacts,
                  const std::vector<RunRecord>& runs);
/// The states kept of one impact, or how several have ended; in space a cut through the middle.
template <int Dim>
void draw(Session& session, const Parameters& p, const std::vector<Impact<Dim>>& impacts,
          const std::vector<RunRecord>& runs);

}  // namespace ball_plate
