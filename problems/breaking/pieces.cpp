// SPDX-License-Identifier: GPL-3.0-or-later
#include "pieces.hpp"

#include <spam/neighbors/connected_parts.hpp>
#include <spam/neighbors/pair_list.hpp>

namespace breaking {

template <int Dim>
std::vector<Piece> pieces_of(const Model<Dim>& model, std::span<const double> y, double reach) {
    const Points<Dim> x = ConstState<Dim>(model.layout(), y).position();
    std::vector<Piece> pieces;
    std::uint32_t i = 0;
    for (const auto number : connected_parts<Dim>(x, reach, model.box())) {
        pieces.resize(std::max(pieces.size(), static_cast<std::size_t>(number) + 1));
        pieces[static_cast<std::size_t>(number)].push_back(i++);
    }
    return pieces;
}

template <int Dim>
std::vector<std::size_t> piece_sizes(const Model<Dim>& model, std::span<const double> y,
                                     std::size_t least, double reach) {
    std::vector<std::size_t> sizes;
    for (const Piece& piece : pieces_of(model, y, reach * model.particles().spacing))
        sizes.push_back(piece.size());
    std::erase_if(sizes, [least](std::size_t n) { return n < least; });
    std::sort(sizes.rbegin(), sizes.rend());
    return sizes;
}

std::vector<Eigen::Index> particles_of_pieces(const Points<2>& position, double spacing,
                                              std::size_t least) {
    const auto piece = connected_parts<2>(position, piece_reach * spacing, {});
    std::vector<std::size_t> size(piece.size(), 0);
    for (const auto one : piece) ++size[static_cast<std::size_t>(one)];
    std::vector<Eigen::Index> all;
    for (std::size_t i = 0; i < piece.size(); ++i)
        if (size[static_cast<std::size_t>(piece[i])] >= least)
            all.push_back(static_cast<Eigen::Index>(i));
    return all;
}

template <int Dim>
FirstNeighbours<Dim>::FirstNeighbours(const Particles<Dim>& particles)
    : count_(Eigen::ArrayXd::Zero(particles.reference_position.cols())),
      reach_(piece_reach * particles.spacing) {
    const PairList<Dim> near(particles.reference_position, 1.3 * particles.spacing, {});
    for (std::size_t i = 0; i < near.size(); ++i)
        for (const std::uint32_t j : near.neighbours(i)) {
            if (j <= i || particles.body[i] != particles.body[j]) continue;
            pairs_.emplace_back(i, j);
            count_[static_cast<Eigen::Index>(i)] += 1.0;
            count_[static_cast<Eigen::Index>(j)] += 1.0;
        }
}

template <int Dim>
std::vector<double> FirstNeighbours<Dim>::lost(const Points<Dim>& position) const {
    Eigen::ArrayXd left = Eigen::ArrayXd::Zero(position.cols());
    for (const auto& [i, j] : pairs_)
        if ((position.col(i) - position.col(j)).norm() < reach_) {
            left[i] += 1.0;
            left[j] += 1.0;
        }
    const Eigen::ArrayXd lost = 1.0 - left / count_.max(1.0);
    return {lost.begin(), lost.end()};
}

template std::vector<Piece> pieces_of(const Model<2>&, std::span<const double>, double);
template std::vector<Piece> pieces_of(const Model<3>&, std::span<const double>, double);
template std::vector<std::size_t> piece_sizes(const Model<2>&, std::span<const double>, std::size_t,
                                              double);
template std::vector<std::size_t> piece_sizes(const Model<3>&, std::span<const double>, std::size_t,
                                              double);
template class FirstNeighbours<2>;
template class FirstNeighbours<3>;

}  // namespace breaking
