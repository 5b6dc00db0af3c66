// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "bond_sweeps.hpp"
#include <spam/core/archive.hpp>
#include <spam/core/tensor.hpp>
#include <spam/neighbors/cluster_list.hpp>
#include <spam/physics/material_vectors.hpp>

#include <functional>
#include <vector>

namespace spam {

/// Who is whose neighbour, and the material vector of each: rows of bonds by particle k, partners j
/// ascending, every pair in both rows. A row holds whoever is nearer than range + skin; what is beyond the
/// range weighs exactly nothing, so that a neighbour enters and leaves with no trace, and rows serve until
/// particles have moved by half the skin (a common rigid motion apart).
template <int Dim>
class BondTable {
  public:
    static constexpr double skin = 0.1;  ///< of the range
    /// The material vector of a bond that is new or weighs nothing: r_kj is its separation.
    using Anchor = std::function<Vec<Dim>(std::size_t k, const Vec<Dim>& r_kj)>;

    /// Only particles of the same body share bonds. Throws InputError where a periodic length is not above
    /// twice range + skin.
    BondTable(double range, const Box<Dim>& box, int lanes, std::vector<std::int32_t> bodies,
              const MaterialWeight& weight = {});

    /// Whether everybody nearer than the range is in these rows.
    bool serves(const Eigen::Ref<const Points<Dim>>& x) { return list_.serves(x); }
    /// Rows anew. Bonds that weigh something keep their vectors.
    void update(const Eigen::Ref<const Points<Dim>>& x, const Anchor& anchor);

    std::size_t particles() const { return rows_.count.size(); }
    std::size_t groups() const { return rows_.first.empty() ? 0 : rows_.first.size() - 1; }
    std::size_t bonds() const { return bonds_; }  ///< both directions of each pair
    std::size_t builds() const { return list_.builds(); }

    std::size_t row(std::size_t k) const { return rows_.count[k]; }
    std::uint32_t partner(std::size_t k, std::size_t m) const {
        return rows_.partner[rows_.slot(k, m)];
    }
    Vec<Dim> X(std::size_t k, std::size_t m) const { return rows_.X(k, m); }
    double g(std::size_t k, std::size_t m) const { return rows_.vectors[rows_.number(k, m, Dim)]; }
    /// The partner sees no change: its vector to k is another one.
    void set_X(std::size_t k, std::size_t m, const Vec<Dim>& X);
    /// x_j - x_k, the nearest image.
    Vec<Dim> separation(const double* x, std::size_t k, std::size_t j) const;

    /// Particles are summed in blocks of so many, whose bonds fit the cache.
    static constexpr std::size_t block = 128;
    std::size_t blocks() const { return reach_.size(); }
    /// The first and the last block that a block has bonds with.
    struct Reach {
        std::size_t first, last;
    };
    const Reach& reach(std::size_t b) const { return reach_[b]; }

    /// For the loops of right-hand sides, which write t.
    BondView<Dim> view();

    /// After reading, rows and their age are those that were written.
    void remember(Archive& archive);

  private:
    /// Bond m of particle k, with those of its group.
    struct Rows {
        std::size_t lanes;
        std::vector<std::uint32_t> count{};  ///< by particle
        std::vector<std::size_t> first{};    ///< by group
        std::vector<std::uint32_t> partner{}, reverse{};
        std::vector<double> vectors{};

        std::size_t slot(std::size_t k, std::size_t m) const {
            return first[k / lanes] + m * lanes + k % lanes;
        }
        std::size_t number(std::size_t k, std::size_t m, std::size_t a) const {
            return (first[k / lanes] + m * lanes) * (Dim + 1) + a * lanes + k % lanes;
        }
        Vec<Dim> X(std::size_t k, std::size_t m) const;
    };
    void lay_out(std::vector<std::uint32_t> count);
    void find_reverse();
    void find_reach();

    double range_;
    MaterialWeight weight_;
    Box<Dim> box_;
    std::size_t bonds_ = 0;
    std::vector<std::int32_t> bodies_;
    ClusterList<Dim> list_;
    std::vector<double> built_at_;
    Rows rows_;
    std::vector<Reach> reach_;  ///< by block
    std::vector<double> t_;
};

extern template class BondTable<2>;
extern template class BondTable<3>;

}  // namespace spam
