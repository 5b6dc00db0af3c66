// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/problem/observer.hpp>

#include <vector>

namespace spam {

/// What flies on as one: a connected part within the model's reach.
struct Piece {
    std::size_t particles = 0;
    std::int64_t key = 0;  ///< the same for the same particles
    double mass = 0.0;
    Point<2> position = Point<2>::Zero(), velocity = Point<2>::Zero();  ///< of its centre of mass
    double spin = 0.0;     ///< angular momentum about that
    double inertia = 0.0;  ///< moment of inertia about that
    double angular_velocity() const { return spin / inertia; }

    void remember(Archive& a) { a(particles, key, mass, position, velocity, spin, inertia); }
};

/// Of `least` particles or more, in the order of their first particles.
std::vector<Piece> pieces_at(const Model<2>& model, std::span<const double> y, std::size_t least);

/// The pieces at every row of a run.
class PiecesInMotion {
  public:
    struct Row {
        double t;
        std::vector<Piece> pieces;
        void remember(Archive& a) { a(t, pieces); }
    };
    /// One piece of the last row, since it has been made of the same particles.
    struct Flight {
        Piece last;
        std::vector<double> t, spin, angular_velocity;
        double spin_change() const;          ///< the largest
        std::vector<double> angles() const;  ///< by which it has turned, by trapezia
    };

    explicit PiecesInMotion(std::size_t least) : least_(least) {}
    Observer<2> observer();
    const std::vector<Row>& rows() const { return rows_; }
    std::vector<Flight> flights() const;

  private:
    std::size_t least_;
    std::vector<Row> rows_;
};

}  // namespace spam
