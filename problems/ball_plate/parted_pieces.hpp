// SPDX-License-Identifier: GPL-3.0-or-later
// What ball and plate break into, and whether each piece keeps its angular momentum once it has parted.
#pragma once

#include "../breaking/pieces.hpp"

#include <Eigen/Geometry>

namespace ball_plate {

using namespace spam;
using breaking::Piece;

/// Pieces in space that are alone: from row to row they have the same particles, and all others are farther away than
/// forces reach by a spacing, which is more than anything moves between rows.
struct PartedPieces {
    struct Parted {
        Piece piece;
        Point<3> L;  ///< about the origin, in the first row in which it was alone
        void remember(Archive& archive) { archive(piece, L); }
    };
    std::vector<Parted> parted{};
    double largest_change = 0.0;  ///< of L of a piece so far, by its sum m |x||v|

    /// At every row.
    void look(const Model<3>& model, std::span<const double> y) {
        const ConstState<3> state(model.layout(), y);
        std::vector<Parted> now;
        for (Piece& piece :
             breaking::pieces_of(model, y, model.reach() + model.particles().spacing)) {
            Point<3> L = Point<3>::Zero();
            double size = 0.0;
            for (const std::uint32_t i : piece) {
                const Point<3> x = state.position().col(i),
                               p = model.particles().mass[i] * state.velocity().col(i);
                L += x.cross(p);
                size += x.norm() * p.norm();
            }
            for (const Parted& before : parted)
                if (before.piece == piece && size > 0.0) {
                    largest_change = std::max(largest_change, (L - before.L).norm() / size);
                    L = before.L;
                }
            now.push_back({std::move(piece), L});
        }
        parted = std::move(now);
    }
    void remember(Archive& archive) { archive(parted, largest_change); }
};

}  // namespace ball_plate
