// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/parts.hpp>
#include <spam/neighbors/pair_list.hpp>
#include <spam/physics/closest_approach.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace spam {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Least value on [0, 1] of the cubic with values f and slopes d at both ends, d_0 < 0 < d_1.
double least_of_cubic(double f_0, double d_0, double f_1, double d_1) {
    const double A = 6.0 * (f_0 - f_1) + 3.0 * (d_0 + d_1);
    const double B = -6.0 * (f_0 - f_1) - 4.0 * d_0 - 2.0 * d_1;
    const double root = std::sqrt(std::max(0.0, B * B - 4.0 * A * d_0));
    const double s = B > 0.0 ? -2.0 * d_0 / (B + root) : (root - B) / (2.0 * A);
    const double s2 = s * s, s3 = s2 * s;
    return f_0 + (f_1 - f_0) * (3.0 * s2 - 2.0 * s3) + d_0 * (s3 - 2.0 * s2 + s) + d_1 * (s3 - s2);
}

/// A tight periodic box leaves less room.
template <int Dim>
double skin(double share, double R, const Box<Dim>& box) {
    double skin = share * R;
    for (int a = 0; a < Dim; ++a)
        if (box.periodic(a)) skin = std::min(skin, 0.49 * std::max(0.0, box.length(a) - 2.002 * R));
    return skin;
}

/// Of this part's particles first, first + 1, ... among those of all parts that are watched.
std::vector<std::uint32_t> numbers_among(std::size_t first, std::size_t count) {
    Parts& parts = Parts::here();
    const Parts::Among among(parts, first);
    std::vector<std::uint32_t> numbers(count);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = parts.number(i);
    const double lowest = -parts.most(count == 0 ? -infinity : -static_cast<double>(numbers[0]));
    for (std::uint32_t& number : numbers) number -= static_cast<std::uint32_t>(lowest);
    return numbers;
}

}  // namespace

template <int Dim>
bool ElasticReflection<Dim>::operator()(double m_i, double m_j, const Point<Dim>& r_ij,
                                        Eigen::Ref<Point<Dim>> v_i,
                                        Eigen::Ref<Point<Dim>> v_j) const {
    const double approach = (v_i - v_j).dot(r_ij);
    if (!(approach < -4.0 * eps * (v_i.norm() + v_j.norm()) * r_ij.norm())) return false;
    const double mu = std::isinf(m_i) ? m_j : std::isinf(m_j) ? m_i : m_i * m_j / (m_i + m_j);
    const Point<Dim> impulse = (-2.0 * mu * approach / r_ij.squaredNorm()) * r_ij;
    v_i += impulse / m_i;
    v_j -= impulse / m_j;
    return true;
}

template <int Dim>
ClosestApproach<Dim>::ClosestApproach(std::vector<double> mass, const Box<Dim>& box,
                                      double distance, bool moves_with_v)
    : mass_(std::move(mass)),
      box_(box),
      periodic_(box.periodic()),
      R_(distance),
      moves_with_v_(moves_with_v),
      list_(new_list()) {
    require_one_image(box, 1.001 * distance);
}

template <int Dim>
std::unique_ptr<ClusterList<Dim>> ClosestApproach<Dim>::new_list() const {
    return std::make_unique<ClusterList<Dim>>(1.001 * R_, skin(first_share, R_, box_),
                                              box_.of_images(), 1);
}

template <int Dim>
void ClosestApproach<Dim>::hold(const std::vector<bool>& held) {
    for (std::size_t i = 0; i < held.size(); ++i)
        if (held[i]) mass_[i] = infinity;
}

template <int Dim>
void ClosestApproach<Dim>::join(std::span<const std::uint32_t> numbers) {
    mass_ = Parts::here().by_number(std::span<const double>(mass_), 1, numbers);
}

template <int Dim>
void ClosestApproach<Dim>::remember(Archive& archive) {
    archive(passed_);
    if (!archive.reading()) return;
    list_ = new_list();
    share_ = first_share;
    served_ = 0;
    near_.clear();
    armed_.clear();
}

template <int Dim>
Point<Dim> ClosestApproach<Dim>::separation(const Points_& x, const Numbers& pair) const {
    const Point<Dim> r = x.col(pair.first) - x.col(pair.second);
    return periodic_ ? box_.nearest(r) : r;
}

/// A list that is soon used up looks further next time; never by the clock.
template <int Dim>
void ClosestApproach<Dim>::choose_skin() {
    if (list_->builds() == 0) return;
    if (served_ < 8) share_ = std::min(1.25 * share_, 3.0);
    if (served_ > 60) share_ = std::max(share_ / 1.25, 0.05);
    list_->set_skin(skin(share_, R_, box_));
}

template <int Dim>
void ClosestApproach<Dim>::build_list() {
    choose_skin();
    list_->build(x_);
    near_.clear();
    const auto order = list_->order();
    for (std::size_t slot = 0; slot < list_->clusters(); ++slot)
        for (const std::uint32_t other : list_->entries(slot))
            if (order[slot] < list_->particle(other) &&
                !(holds(order[slot]) && holds(list_->particle(other))))
                near_.push_back({order[slot], list_->particle(other)});
    served_ = 0;
}

template <int Dim>
void ClosestApproach<Dim>::arm(double t, const Points_& x, const Points_& v) {
    t_ = t;
    x_ = x;
    v_ = v;
    ++served_;
    if (!list_->serves(x_)) build_list();
    arm_pairs();
}

template <int Dim>
void ClosestApproach<Dim>::arm_pairs() {
    then_ = list_->displacement();
    const auto slope_of = [&](const Numbers& pair, const Point<Dim>& r) {
        return r.dot(v_.col(pair.first) - v_.col(pair.second));
    };
    std::erase_if(passed_, [&](const Numbers& pair) {
        const Point<Dim> r = separation(x_, pair);
        return r.squaredNorm() <= R_ * R_ || slope_of(pair, r) < 0.0;
    });
    armed_.clear();
    for (const Numbers& pair : near_) {
        const Point<Dim> r = separation(x_, pair);
        const double r2 = r.squaredNorm();
        if (r2 <= R_ * R_ || std::binary_search(passed_.begin(), passed_.end(), pair)) continue;
        const Point<Dim> image = x_.col(pair.first) - x_.col(pair.second) - r;
        armed_.push_back({pair, image, r2, slope_of(pair, r)});
    }
}

/// Whether no other pair than those of the list can have come near since arm(). The list may serve at
/// both ends with different rigid motions: in between it does where they turn by little, 0.05, against
/// each other, as it looks a thousandth further than R.
template <int Dim>
bool ClosestApproach<Dim>::watches(const Points_& x) {
    if (!list_->serves(x)) return false;
    double trace = 0.0;
    const Displacement<Dim> now = list_->displacement();
    for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b) trace += now.rotation[a][b] * then_.rotation[a][b];
    return Dim - trace < 0.05 * 0.05;
}

template <int Dim>
double ClosestApproach<Dim>::distance(double t, const Points_& x, const Points_& v) {
    if (!watches(x)) {
        build_list();  // for where the step began
        arm_pairs();
        if (!watches(x)) return -infinity;
    }
    double least = infinity;
    for (const Armed& pair : armed_) {
        const auto [i, j] = pair.numbers;
        const Point<Dim> r = x.col(i) - x.col(j) - pair.image;
        const double r2 = r.squaredNorm();
        least = std::min(least, r2);
        if (!moves_with_v_ || !(pair.slope < 0.0)) continue;
        const double slope = r.dot(v.col(i) - v.col(j));
        if (slope > 0.0)
            least = std::min(least, least_of_cubic(pair.r2, 2.0 * (t - t_) * pair.slope, r2,
                                                   2.0 * (t - t_) * slope));
    }
    return (least - R_ * R_) / (2.0 * R_);
}

template <int Dim>
auto ClosestApproach<Dim>::touching(const Points_& x) const -> std::vector<Numbers> {
    std::vector<Numbers> pairs;
    for (const Armed& pair : armed_) {
        const auto [i, j] = pair.numbers;
        const double r2 = (x.col(i) - x.col(j) - pair.image).squaredNorm();
        const double size = x.col(i).template lpNorm<Eigen::Infinity>() +
                            x.col(j).template lpNorm<Eigen::Infinity>();
        if ((r2 - R_ * R_) / (2.0 * R_) <= 2.0 * tolerance() + 8.0 * eps * size)
            pairs.push_back(pair.numbers);
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

template <int Dim>
std::size_t ClosestApproach<Dim>::reflect(const Points_& x, Eigen::Ref<Points<Dim>> v) {
    const auto pairs = touching(x);
    const ElasticReflection<Dim> reflection;
    std::size_t reflections = 0;
    // Finitely many in exact arithmetic, as for hard disks; the rest is left to the next event.
    for (int round = 0; round < 1000; ++round) {
        const std::size_t before = reflections;
        for (const auto& [i, j] : pairs)
            reflections +=
                reflection(mass_[i], mass_[j], separation(x, {i, j}), v.col(i), v.col(j));
        if (reflections == before) break;
    }
    if (!moves_with_v_) {
        passed_.insert(passed_.end(), pairs.begin(), pairs.end());
        std::sort(passed_.begin(), passed_.end());
        passed_.erase(std::unique(passed_.begin(), passed_.end()), passed_.end());
    }
    return reflections;
}

template <int Dim>
Event closest_approach_event(ClosestApproach<Dim> approach, const FieldLayout<Dim>& layout,
                             const std::vector<bool>& held, std::size_t first) {
    const std::size_t count = approach.particles();
    if (!held.empty())
        approach.hold({held.begin() + static_cast<std::ptrdiff_t>(first),
                       held.begin() + static_cast<std::ptrdiff_t>(first + count)});
    const auto numbers = numbers_among(first, count);
    approach.join(numbers);
    const auto shared = std::make_shared<ClosestApproach<Dim>>(std::move(approach));
    const auto all_of = [&layout, first, count, numbers](std::span<const double> y) {
        const auto own = ConstState<Dim>(layout, y).part(first, count);
        const auto all = [&numbers](const auto& field) {
            const auto values = Parts::here().by_number(
                std::span<const double>(field.data(), static_cast<std::size_t>(field.size())), Dim,
                numbers);
            return Points<Dim>(Eigen::Map<const Points<Dim>>(
                values.data(), Dim, static_cast<Eigen::Index>(values.size()) / Dim));
        };
        return std::array{all(own.position()), all(own.velocity())};
    };
    Event event;
    event.name = "closest approach";
    event.tolerance = shared->tolerance();
    event.arm = [shared, all_of](double t, std::span<const double> y) {
        const auto [x, v] = all_of(y);
        const Parts::Here as_a_whole(Parts::alone_here());
        shared->arm(t, x, v);
    };
    event.distance = [shared, all_of](double t, std::span<const double> y) {
        const auto [x, v] = all_of(y);
        const Parts::Here as_a_whole(Parts::alone_here());
        return shared->distance(t, x, v);
    };
    event.apply = [shared, all_of, &layout, first, count, numbers](double, std::span<double> y) {
        auto [x, v] = all_of(y);
        const std::size_t reflections = shared->reflect(x, v);
        State<Dim>(layout, y).part(first, count).velocity() = v(Eigen::all, numbers);
        return reflections;
    };
    event.remember = [shared](Archive& archive) { shared->remember(archive); };
    return event;
}

#define SPAM_INSTANTIATE(D)                                                          \
    template struct ElasticReflection<D>;                                            \
    template class ClosestApproach<D>;                                               \
    template Event closest_approach_event(ClosestApproach<D>, const FieldLayout<D>&, \
                                          const std::vector<bool>&, std::size_t);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
