// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/neighbors/connected_parts.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace spam {
namespace {

constexpr std::uint32_t nobody = 0xffffffff;

/// Sets that grow together: each particle points towards the lowest one of its set.
class Sets {
  public:
    explicit Sets(std::size_t n) : towards_(n) {
        for (std::size_t i = 0; i < n; ++i) towards_[i] = static_cast<std::uint32_t>(i);
    }
    std::uint32_t lowest(std::uint32_t i) {
        while (towards_[i] != i) i = towards_[i] = towards_[towards_[i]];
        return i;
    }
    bool joined(std::uint32_t i, std::uint32_t j) { return lowest(i) == lowest(j); }
    void join(std::uint32_t i, std::uint32_t j) {
        i = lowest(i), j = lowest(j);
        towards_[std::max(i, j)] = std::min(i, j);
    }

  private:
    std::vector<std::uint32_t> towards_;
};

/// Particles in cells at least `reach` wide, in a hash table: a list of all pairs, which other searches
/// build, would need ten times the room and serve only once. Cells that share a place in the table cost
/// time, not correctness, since every separation is measured.
template <int Dim>
class Cells {
    using Coordinates = std::array<std::int64_t, Dim>;

  public:
    Cells(const Points<Dim>& position, double reach, const Box<Dim>& box)
        : x_(position),
          box_(box),
          reach2_(reach * reach) {
        const auto n = static_cast<std::size_t>(x_.cols());
        first_.assign(std::bit_ceil(std::max<std::size_t>(2 * n, 16)), nobody);
        next_.assign(n, nobody);
        for (int a = 0; a < Dim; ++a) {
            const auto k = static_cast<std::size_t>(a);
            double width =
                reach * (1.0 + 1e-9);  // rounding must not put two cells between neighbours
            if (box_.periodic(a)) {
                count_[k] = static_cast<std::int64_t>(
                    std::clamp(std::floor(box_.length(a) / width), 1.0, 1e9));
                width = box_.length(a) / static_cast<double>(count_[k]);
            }
            per_width_[k] = 1.0 / width;
        }
        stride_[0] = 1;  // neighbours along the first axis lie side by side in memory
        const auto across = static_cast<std::uint64_t>(std::pow(static_cast<double>(n), 1.0 / Dim));
        for (std::size_t a = 1; a < Dim; ++a) stride_[a] = stride_[a - 1] * (across | 1) * 2 + 1;
    }

    /// Joins i with the particles entered before that are closer than the reach, and enters it. Whether
    /// they are in one set already is asked first: it costs less than a separation, and in a crowd
    /// nearly all are.
    void enter(std::uint32_t i, Sets& sets) {
        const Coordinates own = cell_of(i);
        Coordinates other = own;
        visit<0>(own, other, [&](std::size_t place) {
            for (std::uint32_t j = first_[place]; j != nobody; j = next_[j])
                if (!sets.joined(i, j) && close(i, j)) sets.join(i, j);
        });
        const std::size_t place = place_of(own);
        next_[i] = first_[place];
        first_[place] = i;
    }

  private:
    Coordinates cell_of(std::uint32_t i) const {
        Coordinates cell;
        for (std::size_t a = 0; a < Dim; ++a) {
            const int axis = static_cast<int>(a);
            // What was flung away may lie further than an integer counts.
            const double c = std::floor(box_.wrap(axis, x_(axis, i)) * per_width_[a]);
            cell[a] = static_cast<std::int64_t>(std::abs(c) < 1e15 ? c : 1e15);
            // Next to the border rounding may lead to the other side of it.
            if (count_[a] > 0) cell[a] = std::clamp<std::int64_t>(cell[a], 0, count_[a] - 1);
        }
        return cell;
    }
    std::size_t place_of(const Coordinates& cell) const {
        std::uint64_t place = 0;
        for (std::size_t a = 0; a < Dim; ++a)
            place += static_cast<std::uint64_t>(cell[a]) * stride_[a];
        return place & (first_.size() - 1);
    }
    /// The 3^Dim cells around `own`, itself among them.
    template <std::size_t Axis, class Function>
    void visit(const Coordinates& own, Coordinates& other, const Function& f) const {
        if constexpr (Axis == Dim) {
            f(place_of(other));
        } else {
            for (std::int64_t step = -1; step <= 1; ++step) {
                other[Axis] = own[Axis] + step;
                if (count_[Axis] > 0) other[Axis] = (other[Axis] + count_[Axis]) % count_[Axis];
                visit<Axis + 1>(own, other, f);
            }
        }
    }
    bool close(std::uint32_t i, std::uint32_t j) const {
        double r2 = 0.0;
        for (int a = 0; a < Dim; ++a) {
            const double s = box_.nearest_image(a, box_.wrap(a, x_(a, i)) - box_.wrap(a, x_(a, j)));
            r2 += s * s;
        }
        return r2 < reach2_;
    }

    const Points<Dim>& x_;
    const Box<Dim>& box_;
    double reach2_;
    std::array<std::int64_t, Dim> count_{};  ///< of cells, in periodic directions only
    std::array<double, Dim> per_width_{};
    std::array<std::uint64_t, Dim> stride_{};
    std::vector<std::uint32_t> first_,
        next_;  ///< of the chain of particles at a place of the table
};

}  // namespace

template <int Dim>
std::vector<std::int32_t> connected_parts(const Points<Dim>& position, double reach,
                                          const Box<Dim>& box) {
    const auto n = static_cast<std::uint32_t>(position.cols());
    Cells<Dim> cells(position, reach, box);
    Sets sets(n);
    for (std::uint32_t i = 0; i < n; ++i) cells.enter(i, sets);
    std::vector<std::int32_t> body(n);
    std::int32_t bodies = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t lowest = sets.lowest(i);
        body[i] = lowest == i ? bodies++ : body[lowest];
    }
    return body;
}

template std::vector<std::int32_t> connected_parts(const Points<1>&, double, const Box<1>&);
template std::vector<std::int32_t> connected_parts(const Points<2>&, double, const Box<2>&);
template std::vector<std::int32_t> connected_parts(const Points<3>&, double, const Box<3>&);

}  // namespace spam
