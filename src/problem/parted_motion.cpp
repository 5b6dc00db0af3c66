// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/parted_state.hpp>
#include <spam/integrate/methods.hpp>
#include <spam/neighbors/neighbourhood.hpp>
#include <spam/problem/parted_motion.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace spam {
namespace {

/// Recursive bisection: the numbers of each part, by cuts across the longest extent, as many particles on either
/// side as parts lie there (to one). Particles at one place go by number, so that all processes find the same. Of
/// extents that are nearly as long the first counts: were they to take turns, most particles would go to another part
/// each time.
template <int Dim>
void bisect(const Points<Dim>& x, std::span<std::uint32_t> numbers,
            std::span<std::vector<std::uint32_t>> parts) {
    if (parts.size() == 1) {
        parts.front().assign(numbers.begin(), numbers.end());
        std::sort(parts.front().begin(), parts.front().end());
        return;
    }
    const Points<Dim> own = x(Eigen::all, numbers);
    Eigen::Index axis = 0;
    if (own.cols() > 0) {
        const Point<Dim> extent = own.rowwise().maxCoeff() - own.rowwise().minCoeff();
        while (extent[axis] < 0.9 * extent.maxCoeff()) ++axis;
    }
    const std::size_t below = parts.size() / 2, cut = numbers.size() * below / parts.size();
    std::nth_element(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(cut),
                     numbers.end(), [&](std::uint32_t i, std::uint32_t j) {
                         return std::pair(x(axis, i), i) < std::pair(x(axis, j), j);
                     });
    bisect<Dim>(x, numbers.first(cut), parts.first(below));
    bisect<Dim>(x, numbers.subspan(cut), parts.subspan(below));
}

}  // namespace

Observers of_the_whole(Observers observers) {
    const auto as_a_whole = [](auto& observer) {
        if (observer)
            observer = [of_all = std::move(observer)](double t) {
                const Parts::Here here(Parts::alone_here());
                return of_all(t);
            };
    };
    as_a_whole(observers.output), as_a_whole(observers.snapshot), as_a_whole(observers.step);
    as_a_whole(observers.revise), as_a_whole(observers.change), as_a_whole(observers.checkpoint);
    as_a_whole(observers.last), as_a_whole(observers.enough);
    return observers;
}

template <int Dim>
PartedMotion<Dim>::PartedMotion(Model<Dim>& model, std::span<const double> y0,
                                const IntegratorOptions& options, Parts& processes, double t0)
    : whole_(model),
      options_(options),
      processes_(processes),
      alone_(processes.alone()),
      before_(processes.traffic()) {
    if (alone()) {
        motion_ = std::make_unique<Motion<Dim>>(model, y0, options, t0);
        return;
    }
    y_.assign(y0.begin(), y0.end());
    part(t0);
}

template <int Dim>
void PartedMotion<Dim>::refuse(const Model<Dim>& model, const IntegratorOptions& options,
                               Parts& processes) {
    if (processes.alone()) return;
    const auto* const particles = dynamic_cast<const ParticleModel<Dim>*>(&model);
    if (particles == nullptr)
        throw InputError("ranks: this model is not one of particles; leave --ranks out");
    if (options.adaptive() && options.method.find("gsl:") == 0)
        throw InputError(
            "ranks: GSL's adaptive methods choose steps by the particles of one rank; use arkode: or "
            "cvode: ones, or a fixed step");
    if (processes.count() > model.particles().size())
        throw InputError(fmt::format("ranks: there are {} of them for {} particles; give fewer",
                                     processes.count(), model.particles().size()));
    const Parts::Here here(processes);
    std::vector<std::uint32_t> all(model.particles().size());
    std::iota(all.begin(), all.end(), 0U);
    std::vector<std::vector<std::uint32_t>> parts(processes.count());
    bisect<Dim>(model.particles().reference_position, all, parts);
    processes.set_numbers(parts[processes.own()]);
    particles->part(processes.numbers())->events();
}

/// Of the state in y_ and of what the whole model remembers.
template <int Dim>
void PartedMotion<Dim>::part(double t) {
    const Points<Dim> x = whole_.box().wrapped(Eigen::Map<const Points<Dim>>(
        y_.data(), Dim, static_cast<Eigen::Index>(whole_.particles().size())));
    std::vector<std::uint32_t> numbers(whole_.particles().size());
    std::iota(numbers.begin(), numbers.end(), 0U);
    std::vector<std::vector<std::uint32_t>> parts(processes_.count());
    bisect<Dim>(x, numbers, parts);
    Archive memory;
    {
        const Parts::Here as_a_whole(Parts::alone_here());
        whole_.remember(memory);
    }
    known_memory_ = memory.take();
    const Parts::Here here(processes_);
    if (motion_) pairs_before_ += motion_->pair_interactions();
    motion_.reset();
    part_.reset();
    count_moved(parts);
    processes_.set_numbers(parts[processes_.own()]);
    part_ = dynamic_cast<const ParticleModel<Dim>&>(whole_).part(processes_.numbers());
    events_ = !part_->events().empty();
    Archive back(known_memory_);
    part_->remember(back);
    motion_ = std::make_unique<Motion<Dim>>(*part_, own_y(), options_, t);
    known_ = now();
    images_ = 0;
}

/// The same with the integrator's memory.
template <int Dim>
void PartedMotion<Dim>::part_anew() {
    const Parts::Here here(processes_);
    Archive memory;
    motion_->integrator().remember(memory);
    part(t());
    Archive back(memory.bytes());
    motion_->integrator().remember(back);
    known_ = now();
}

template <int Dim>
void PartedMotion<Dim>::go_on_from(PartedMotion& before) {
    const Parts::Here here(processes());
    Archive memory;
    before.motion_->integrator().remember(memory);
    Archive back(memory.bytes());
    motion_->integrator().remember(back);
    known_ = now();
}

template <int Dim>
void PartedMotion<Dim>::count_moved(const std::vector<std::vector<std::uint32_t>>& parts) {
    const auto before = std::exchange(owner_, std::vector<std::size_t>(whole_.particles().size()));
    for (std::size_t p = 0; p < parts.size(); ++p)
        for (const std::uint32_t i : parts[p]) owner_[i] = p;
    if (before.empty()) return;
    ++partitions_;
    for (std::size_t i = 0; i < before.size(); ++i) moved_ += before[i] != owner_[i];
}

/// Whether a quarter more images of others' particles are needed than at first: parting anew then pays.
template <int Dim>
bool PartedMotion<Dim>::mixed() {
    const Parts::Here here(processes_);
    std::size_t images = 0;
    for (const auto& term : part_->terms())
        for (const auto* near : term->neighbourhoods())
            images += near->list().slots() - near->list().size();
    images = processes_.total(images);
    most_images_ = std::max(most_images_, images);
    if (images_ == 0) images_ = images;
    return images > images_ + images_ / 4;
}

template <int Dim>
std::span<const double> PartedMotion<Dim>::y() {
    if (alone()) return motion_->y();
    looked_at_ = true;
    if (known_ == now()) {
        if (watched_) tell_whole();
        return y_;
    }
    known_ = now();
    {
        const Parts::Here here(processes_);
        whole_state<Dim>(processes_, part_->layout(), motion_->y(), y_);
    }
    tell_whole();
    // A method with fixed steps and no memory goes the same way from here, but where an event has lists of its own.
    if (options_.dt && !events_ && options_.method.find("cvode:") != 0 && mixed()) part_anew();
    return y_;
}

template <int Dim>
bool PartedMotion<Dim>::edit(const std::function<bool(std::span<double> y)>& change) {
    if (alone()) return motion_->edit(change);
    y();
    if (!change(y_)) return false;
    tell_part();
    const Parts::Here here(processes_);
    motion_->edit([&](std::span<double> own) {
        std::ranges::copy(own_y(), own.begin());
        return true;
    });
    return true;
}

template <int Dim>
std::size_t PartedMotion<Dim>::pair_interactions() {
    return processes().total(pairs_before_ + motion_->pair_interactions());
}

template <int Dim>
std::vector<Remark> PartedMotion<Dim>::watch() {
    if (looked_at_) tell_part();
    const Parts::Here here(processes());
    watched_ = true;
    return motion_->model().watch(t(), motion_->y());
}

template <int Dim>
void PartedMotion<Dim>::remember(Archive& archive) {
    if (!alone() && archive.reading()) y(), part(t());
    {
        const Parts::Here here(processes());
        motion_->remember(archive);
    }
    if (alone() || !archive.reading()) return;
    known_ = now();
    tell_whole();
}

template <int Dim>
RunStatistics::Ranks PartedMotion<Dim>::exchanges() const {
    const Parts::Traffic now = processes().traffic();
    return {processes().count(), now.exchanges - before_.exchanges,
            processes().total(now.bytes - before_.bytes),
            processes().most(now.seconds - before_.seconds)};
}

template <int Dim>
auto PartedMotion<Dim>::sharing() const -> Sharing {
    if (alone()) return {};
    const auto n = static_cast<double>(whole_.particles().size());
    const std::size_t own = pairs_before_ + motion_->pair_interactions();
    const auto pairs = static_cast<double>(std::max<std::size_t>(processes_.total(own), 1));
    return {
        static_cast<double>(most_images_) / n,
        processes_.most(static_cast<double>(own)) * static_cast<double>(processes_.count()) / pairs,
        static_cast<double>(moved_) / n /
            static_cast<double>(std::max<std::size_t>(partitions_, 1))};
}

template <int Dim>
std::vector<double> PartedMotion<Dim>::own_y() const {
    return own_state<Dim>(processes_, whole_.layout(), y_);
}

/// What parts remember beyond y.
template <int Dim>
void PartedMotion<Dim>::tell_whole() {
    Archive memory;
    {
        const Parts::Here here(processes_);
        part_->remember(memory);
    }
    watched_ = false;
    known_memory_ = memory.take();
    Archive back(known_memory_);
    whole_.remember(back);
}

/// The other way round, where it is not the same any more: bodies found anew, counts of sums that an observer took.
template <int Dim>
void PartedMotion<Dim>::tell_part() {
    looked_at_ = false;
    Archive memory;
    {
        const Parts::Here as_a_whole(Parts::alone_here());
        whole_.remember(memory);
    }
    if (memory.bytes() == known_memory_) return;
    known_memory_ = memory.take();
    const Parts::Here here(processes_);
    Archive back(known_memory_);
    part_->remember(back);
}

SPAM_COMPILED(template class PartedMotion);

}  // namespace spam
