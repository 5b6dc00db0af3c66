// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/event.hpp>
#include <spam/core/state.hpp>
#include <spam/neighbors/cluster_list.hpp>

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace spam {

/// The radial relative velocity of two approaching particles turned round, exactly elastically and
/// along r_ij, so that momentum, angular momentum and kinetic energy stay:
///     v_i -= (2 mu/m_i) (v_ij . r_ij/r^2) r_ij,  v_j += (2 mu/m_j) (...),  1/mu = 1/m_i + 1/m_j.
/// [HHM04] IV. An infinite mass is that of a particle that is held or driven, whose velocity stays. Returns whether
/// they were approaching by more than rounding.
template <int Dim>
struct ElasticReflection {
    bool operator()(double m_i, double m_j, const Point<Dim>& r_ij, Eigen::Ref<Point<Dim>> v_i,
                    Eigen::Ref<Point<Dim>> v_j) const;
};

/// The restriction of the distance of closest approach, [HHM04] IV and IX (i): particles on their way
/// towards each other are reflected at the distance R. A pair counts from a state (arm()) in which it
/// is further apart; pairs that are nearer then are left alone until they are out again.
///
/// Distances are looked at where steps end. For particles that move with v a pair that comes and goes
/// within a step is seen too, by the cubic through r^2 and its slope at both ends: what is left to be
/// missed is an approach below R by less than the error of the cubic, O(dt^4), or two approaches of
/// one pair in one step. Where an averaged velocity moves the particles (`moves_with_v` false) only the
/// ends count; there a reflection of v does not keep the pair apart either, as the average hardly
/// changes: it passes the surface once, with separating v, and is left alone inside.
template <int Dim>
class ClosestApproach {
  public:
    using Points_ = Eigen::Ref<const Points<Dim>>;

    /// `distance`: R > 0. Throws InputError when a periodic length is not above 2 R.
    ClosestApproach(std::vector<double> mass, const Box<Dim>& box, double distance,
                    bool moves_with_v);

    /// A step begins at t with positions x and velocities v, Dim x N, finite.
    void arm(double t, const Points_& x, const Points_& v);
    /// Of the nearest pair from the surface, (r^2 - R^2)/2R, the least since arm(); infinite where
    /// there are no pairs, -infinity where something has moved too far for the list of pairs.
    double distance(double t, const Points_& x, const Points_& v);
    /// The particles with these numbers are held or driven: they reflect others as infinitely heavy ones do.
    void hold(const std::vector<bool>& held);
    /// Of a part of a run: takes the particles of the other parts as well; ours have these numbers among all.
    void join(std::span<const std::uint32_t> numbers);
    /// Reflects every approaching pair at the surface, again and again where some touch more than one
    /// other. Returns how many reflections that were.
    std::size_t reflect(const Points_& x, Eigen::Ref<Points<Dim>> v);

    /// The pairs let through; after reading, its lists are made anew.
    void remember(Archive& archive);

    /// How near the surface a pair must be found.
    double tolerance() const { return 1e-12 * R_; }
    std::size_t particles() const { return mass_.size(); }
    std::size_t list_builds() const { return list_->builds(); }

  private:
    using Numbers = std::pair<std::uint32_t, std::uint32_t>;
    struct Armed {
        Numbers numbers;
        Point<Dim> image;  ///< r_ij = x_i - x_j - image, as long as the step lasts
        double r2, slope;  ///< at arm(): r^2 and d(r^2)/dt / 2 = r . v
    };

    std::unique_ptr<ClusterList<Dim>> new_list() const;
    void build_list();
    void arm_pairs();
    bool watches(const Points_& x);
    void choose_skin();
    bool holds(std::size_t i) const { return std::isinf(mass_[i]); }
    std::vector<Numbers> touching(const Points_& x) const;
    Point<Dim> separation(const Points_& x, const Numbers& pair) const;

    std::vector<double> mass_;
    Box<Dim> box_;
    bool periodic_;
    double R_;
    bool moves_with_v_;
    static constexpr double first_share = 0.1;
    double share_ = first_share;  ///< skin of the list, of R
    std::unique_ptr<ClusterList<Dim>> list_;
    std::size_t served_ = 0;       ///< steps begun since the list was built
    std::vector<Numbers> near_;    ///< pairs closer than R + skin when the list was built
    std::vector<Numbers> passed_;  ///< at the surface with separating v, and not inside yet
    std::vector<Armed> armed_;
    double t_ = 0.0;
    Points<Dim> x_, v_;  ///< as arm() met them
    Displacement<Dim> then_{};
};

/// The event of a model whose y holds x and v, for particles first, first + 1, ... of it. `layout` must
/// outlive it. `held`: those of the model that are held or driven; the caller books what they give to others. Every
/// part of a run is told where all particles are, once a look, watches all pairs and reflects them alike.
template <int Dim>
Event closest_approach_event(ClosestApproach<Dim> approach, const FieldLayout<Dim>& layout,
                             const std::vector<bool>& held = {}, std::size_t first = 0);

SPAM_COMPILED(extern template struct ElasticReflection);
SPAM_COMPILED(extern template class ClosestApproach);

}  // namespace spam
