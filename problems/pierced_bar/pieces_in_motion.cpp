// SPDX-License-Identifier: GPL-3.0-or-later
#include "pieces_in_motion.hpp"

#include <spam/neighbors/connected_parts.hpp>

#include <algorithm>
#include <cmath>

namespace spam {

std::vector<Piece> pieces_at(const Model<2>& model, std::span<const double> y, std::size_t least) {
    const ConstState<2> state(model.layout(), y);
    const auto& particles = model.particles();
    const auto number = connected_parts<2>(state.position(), model.reach(), model.box());
    std::vector<Piece> all;
    const auto each = [&](const auto& visit) {
        for (std::size_t k = 0; k < number.size(); ++k) {
            const auto i = static_cast<Eigen::Index>(k);
            visit(all[static_cast<std::size_t>(number[k])], k, particles.mass[k],
                  Point<2>(state.position().col(i)), Point<2>(state.velocity().col(i)));
        }
    };
    for (const auto one : number)
        all.resize(std::max(all.size(), static_cast<std::size_t>(one) + 1));
    each([&](Piece& p, std::size_t k, double m, const Point<2>& x, const Point<2>& v) {
        ++p.particles;
        // The sum of what a generator makes of their numbers.
        p.key += std::int64_t((std::uint64_t(particles.id[k]) + 1) * 0x9E3779B97F4A7C15ULL >> 16);
        p.mass += m;
        p.position += m * x;
        p.velocity += m * v;
    });
    for (Piece& p : all) {
        p.position /= p.mass;
        p.velocity /= p.mass;
    }
    each([](Piece& p, std::size_t, double m, const Point<2>& x, const Point<2>& v) {
        const Point<2> r = x - p.position, u = v - p.velocity;
        p.spin += m * (r.x() * u.y() - r.y() * u.x());
        p.inertia += m * r.squaredNorm();
    });
    std::erase_if(all, [least](const Piece& p) { return p.particles < least; });
    return all;
}

Observer<2> PiecesInMotion::observer() {
    return {.on_row =
                [this](double t, const Model<2>& model, std::span<const double> y) {
                    rows_.push_back({t, pieces_at(model, y, least_)});
                },
            .memory = [this](Archive& archive) { archive(rows_); }};
}

std::vector<PiecesInMotion::Flight> PiecesInMotion::flights() const {
    std::vector<Flight> all;
    if (rows_.empty()) return all;
    for (const Piece& last : rows_.back().pieces) {
        Flight flight{last, {}, {}, {}};
        for (auto row = rows_.rbegin(); row != rows_.rend(); ++row) {
            const auto same =
                std::find_if(row->pieces.begin(), row->pieces.end(), [&last](const Piece& p) {
                    return p.key == last.key && p.particles == last.particles;
                });
            if (same == row->pieces.end()) break;
            flight.t.push_back(row->t);
            flight.spin.push_back(same->spin);
            flight.angular_velocity.push_back(same->angular_velocity());
        }
        for (auto* values : {&flight.t, &flight.spin, &flight.angular_velocity})
            std::reverse(values->begin(), values->end());
        all.push_back(std::move(flight));
    }
    return all;
}

double PiecesInMotion::Flight::spin_change() const {
    double change = 0.0;
    for (const double one : spin) change = std::max(change, std::abs(one - spin.front()));
    return change;
}

std::vector<double> PiecesInMotion::Flight::angles() const {
    std::vector<double> angle(t.size(), 0.0);
    for (std::size_t k = 1; k < t.size(); ++k)
        angle[k] = angle[k - 1] +
                   0.5 * (t[k] - t[k - 1]) * (angular_velocity[k] + angular_velocity[k - 1]);
    return angle;
}

}  // namespace spam
