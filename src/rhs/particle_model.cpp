// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/rhs/particle_model.hpp>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>

namespace spam {
namespace {

template <int Dim>
auto moment(const Point<Dim>& r, const Point<Dim>& f) {
    Eigen::Matrix<double, Dim*(Dim - 1) / 2, 1> m;
    if constexpr (Dim == 2) m[0] = r.x() * f.y() - r.y() * f.x();
    if constexpr (Dim == 3) m = r.cross(f);
    return m;
}

}  // namespace

template <int Dim>
ParticleModel<Dim>::ParticleModel(Particles<Dim> particles, const Box<Dim>& box)
    : Model<Dim>(std::move(particles), box, {Field::position, Field::velocity}) {
    if (box.walled()) add_accounts();
}

template <int Dim>
void ParticleModel<Dim>::add_accounts() {
    for (const Field field : {Field::work, Field::heat, Field::impulse, Field::angular_impulse})
        this->layout().add(field);
    given_.resize((this->particles().size() + block - 1) / block);
}

template <int Dim>
void ParticleModel<Dim>::take(std::unique_ptr<Term<Dim>> term) {
    if (this->box().walled())
        if (auto why = term->no_walls(); !why.empty())
            throw InputError(fmt::format("wall: {} ({})", why, term->describe()));
    for (const auto& other : terms_) {
        if (!other->among().overlaps(term->among())) continue;
        for (const Field field : term->fields())
            for (const Field taken : other->fields())
                if (field == taken)
                    throw InputError(fmt::format(
                        "model: '{}' and '{}' both integrate the {} of a particle; leave "
                        "one of the two out",
                        other->describe(), term->describe(), field.name()));
        const Term<Dim>& averaged = term->moves_with_velocity() ? *other : *term;
        const Term<Dim>& fixed = term->moves_with_velocity() ? *term : *other;
        if (!averaged.moves_with_velocity() && fixed.potential())
            throw InputError(fmt::format(
                "transport: particles that move with an averaged velocity gain energy without limit "
                "from a potential of their positions ({}), whose forces push what the average does "
                "not move; use --transport plain, or leave the potential out",
                fixed.describe()));
    }
    for (const Field field : term->fields()) this->layout().add(field);
    whole_ = whole_ && term->among().whole();
    terms_.push_back(std::move(term));
    if (terms_.size() > 1 || !whole_) more_.resize(Dim * this->particles().size());
}

template <int Dim>
void ParticleModel<Dim>::add(std::unique_ptr<External<Dim>> external) {
    externals_.push_back(std::move(external));
    add_accounts();
}

template <int Dim>
bool ParticleModel<Dim>::moves_with_velocity() const {
    return std::all_of(terms_.begin(), terms_.end(),
                       [](const auto& term) { return term->moves_with_velocity(); });
}

/// In their order. The first finds its v_dot in place, where it finds all of it; what the others find is
/// added. Of particles that not every term acts among, the rates that none finds are zero and x_dot is v.
template <int Dim>
bool ParticleModel<Dim>::term_rates(double t, std::span<const double> y, std::span<double> y_dot) {
    const ConstState<Dim> state(this->layout(), y);
    const State<Dim> rate(this->layout(), y_dot);
    double* const v_dot = rate.velocity().data();
    bool moved = false;
    if (!whole_ || terms_.empty()) {
        std::fill(y_dot.begin(), y_dot.end(), 0.0);
        rate.position() = state.velocity();
        moved = true;
    }
    for (const auto& term : terms_) {
        const Selection<Dim>& among = term->among();
        const bool in_place = whole_ && term == terms_.front();
        double* const found = in_place ? v_dot : more_.data() + Dim * among.first();
        if (auto reason = term->rates({t, among.of(state), among.of(rate), found});
            !reason.empty()) {
            this->fail(y_dot, std::move(reason));
            return false;
        }
        if (!in_place) {
            double* const sum = v_dot + Dim * among.first();
            parallel_for(Dim * among.count(), [=](std::size_t k) { sum[k] += found[k]; });
        }
        moved = moved || term->moves();
    }
    if (!moved) rate.position() = state.velocity();
    return true;
}

template <int Dim>
void ParticleModel<Dim>::rates(double t, std::span<const double> y, std::span<double> y_dot) {
    this->failure_.clear();
    if (!term_rates(t, y, y_dot)) return;
    const State<Dim> rate(this->layout(), y_dot);
    for (const auto& b : this->layout().blocks())
        if (b.field.role() != Role::integrated) rate.field(b.field).setZero();
    const typename External<Dim>::Now now{t, this->particles(), {this->layout(), y}, rate};
    if (this->box().walled()) book_walls(now);
    for (const auto& external : externals_) {
        external->prepare(now);
        apply(*external, now);
    }
}

/// Blocks are the same for any number of threads, and what they are given is summed in their order.
/// give(first, last): what the particles of one are.
template <int Dim>
template <class GiveBlock>
typename ParticleModel<Dim>::Given ParticleModel<Dim>::sum_of_blocks(const GiveBlock& give) {
    const auto n = static_cast<Eigen::Index>(this->particles().size());
    parallel_for(
        given_.size(),
        [&](std::size_t b) {
            const Eigen::Index first = static_cast<Eigen::Index>(b) * block;
            given_[b] = give(first, std::min(n, first + block));
        },
        block);
    Given sum;
    for (const Given& given : given_) {
        sum.force += given.force;
        sum.torque += given.torque;
        sum.power += given.power;
        sum.heat += given.heat;
    }
    return sum;
}

template <int Dim>
void ParticleModel<Dim>::apply(External<Dim>& external, const typename External<Dim>::Now& now) {
    book(external, sum_of_blocks([&](Eigen::Index first, Eigen::Index last) {
             return apply_to(external, now, first, last);
         }),
         now.rate);
}

/// What particles do to each other cancels in the sums over all of them: what is left came through the
/// walls. Energy passes those that rub or have a temperature, and is booked as work where one moves (the
/// part of it that is heat is not told apart), else as heat.
template <int Dim>
void ParticleModel<Dim>::book_walls(const typename External<Dim>::Now& now) {
    const auto x = now.state.position(), v = now.state.velocity();
    const auto u = now.rate.position(), v_dot = now.rate.velocity();
    const bool energy = this->box().passes_energy() && now.rate.has(Field::energy);
    const Given sum = sum_of_blocks([&](Eigen::Index first, Eigen::Index last) {
        Given given;
        for (Eigen::Index i = first; i < last; ++i) {
            const double m = now.particles.mass[static_cast<std::size_t>(i)];
            const Point<Dim> force = m * v_dot.col(i);
            given.force += force;
            given.torque += moment<Dim>(x.col(i), force) + m * moment<Dim>(u.col(i), v.col(i));
            if (energy) given.power += force.dot(v.col(i)) + m * now.rate.energy()(0, i);
        }
        return given;
    });
    now.rate.field(Field::impulse) += sum.force;
    if constexpr (Dim > 1) now.rate.field(Field::angular_impulse) += sum.torque;
    const Field account = this->box().moving_walls() ? Field::work : Field::heat;
    now.rate.field(account)(0, 0) += sum.power;
}

/// The difference that the external makes to what the particles had before it.
template <int Dim>
typename ParticleModel<Dim>::Given ParticleModel<Dim>::apply_to(
    const External<Dim>& external, const typename External<Dim>::Now& now, Eigen::Index first,
    Eigen::Index last) const {
    const bool has_energy = now.rate.has(Field::energy);
    Eigen::Matrix<double, Dim, block> x_dot, v_dot;
    Eigen::Matrix<double, 1, block> e_dot;
    const Eigen::Index count = last - first;
    x_dot.leftCols(count) = now.rate.position().middleCols(first, count);
    v_dot.leftCols(count) = now.rate.velocity().middleCols(first, count);
    if (has_energy) e_dot.leftCols(count) = now.rate.energy().middleCols(first, count);
    external.add(now, first, last);
    Given given;
    const auto x = now.state.position(), v = now.state.velocity();
    const auto after = now.rate.velocity(), moves = now.rate.position();
    for (Eigen::Index k = 0; k < count; ++k) {
        const Eigen::Index i = first + k;
        const double m = now.particles.mass[static_cast<std::size_t>(i)];
        const Point<Dim> force = m * (after.col(i) - v_dot.col(k));
        given.force += force;
        given.torque += moment<Dim>(x.col(i), force);
        given.torque += m * moment<Dim>(moves.col(i) - x_dot.col(k), v.col(i));
        given.power += force.dot(v.col(i));
        if (has_energy) given.heat += m * (now.rate.energy()(0, i) - e_dot(0, k));
    }
    return given;
}

template <int Dim>
void ParticleModel<Dim>::book(const External<Dim>& external, const Given& given,
                              const State<Dim>& rate) const {
    rate.field(Field::impulse) += given.force;
    if constexpr (Dim > 1) rate.field(Field::angular_impulse) += given.torque;
    if (!has_energy(external))
        rate.field(external.thermal() ? Field::heat : Field::work)(0, 0) += given.power;
    rate.field(Field::heat)(0, 0) += given.heat;
}

template <int Dim>
double ParticleModel<Dim>::internal_energy(std::span<const double> y) const {
    double energy = 0.0;
    for (const auto& term : terms_) energy += term->energy(y);
    for (const auto& external : externals_)
        if (has_energy(*external))
            energy += external->energy(this->particles(), {this->layout(), y});
    return energy;
}

template <int Dim>
std::vector<double> ParticleModel<Dim>::density(std::span<const double> y) const {
    std::vector<double> rho = Model<Dim>::density(y);
    std::vector<bool> known(this->particles().size(), !rho.empty()), of_term(known.size(), false);
    rho.resize(known.size());
    for (const auto& term : terms_) {
        const std::size_t first = term->among().first();
        if (of_term[first]) continue;
        const auto found = term->density(y);
        for (std::size_t k = 0; k < found.size(); ++k) {
            rho[first + k] = found[k];
            known[first + k] = of_term[first + k] = true;
        }
    }
    if (std::find(known.begin(), known.end(), false) != known.end()) rho.clear();
    if (!rho.empty())
        for (const auto& external : externals_) external->add_density({this->layout(), y}, rho);
    return rho;
}

template <int Dim>
std::vector<Event> ParticleModel<Dim>::events() const {
    std::vector<Event> events;
    for (const auto& term : terms_)
        for (Event& event : term->events()) events.push_back(std::move(event));
    if (events.empty()) return events;
    const std::size_t n = this->particles().size();
    std::size_t held = 0;
    for (std::size_t i = 0; i < n; ++i)
        held += std::any_of(externals_.begin(), externals_.end(),
                            [i](const auto& external) { return external->holds(i); });
    if (held == n) return {};  // what does not move never meets
    if (held > 0)
        throw InputError(
            "closest-approach: a reflection would move particles that are held or driven; leave one "
            "of the two out");
    return events;
}

template <int Dim>
Promises ParticleModel<Dim>::promises() const {
    Promises weakest;
    weakest.angular_momentum = Promise::integrator_error;
    const auto weaken = [](Promise& promise, Promise of_term) {
        promise = std::max(promise, of_term);
    };
    for (const auto& term : terms_) {
        const Promises p = term->promises();
        weaken(weakest.mass, p.mass);
        weaken(weakest.momentum, p.momentum);
        weaken(weakest.angular_momentum, p.angular_momentum);
        weaken(weakest.energy, p.energy);
    }
    return this->in_box(weakest);
}

template <int Dim>
std::string ParticleModel<Dim>::describe() const {
    std::string words;
    for (const auto& term : terms_) words += (words.empty() ? "" : "; ") + term->describe();
    for (const auto& external : externals_)
        words += (words.empty() ? "" : "; ") + external->describe();
    if (this->box().walled()) words += (words.empty() ? "" : "; ") + this->box().describe_walls();
    return words;
}

template <int Dim>
std::string ParticleModel<Dim>::inseparable() const {
    for (const auto& external : externals_)
        if (auto why = external->inseparable(); !why.empty()) return why;
    return Model<Dim>::inseparable();
}

template <int Dim>
double ParticleModel<Dim>::fastest_damping() const {
    double damping = 0.0;
    for (const auto& term : terms_) damping += term->fastest_damping();
    for (const auto& external : externals_) damping += external->damping();
    return damping;
}

/// Potentials of externals are no forces between neighbours.
template <int Dim>
double ParticleModel<Dim>::neighbour_forces(std::span<const double> y) const {
    double sum = 0.0;
    for (const auto& term : terms_) sum += term->neighbour_forces(y);
    return sum;
}

template <int Dim>
bool ParticleModel<Dim>::smooth() const {
    return std::all_of(terms_.begin(), terms_.end(),
                       [](const auto& term) { return term->smooth(); });
}

template <int Dim>
std::size_t ParticleModel<Dim>::pairs() const {
    std::size_t of_all = 0, of_parts = 0;  // terms of the same particles have the same neighbours
    for (const auto& term : terms_)
        if (term->among().whole())
            of_all = std::max(of_all, term->pairs());
        else
            of_parts += term->pairs();
    return of_all + of_parts;
}

template <int Dim>
double ParticleModel<Dim>::reach() const {
    double reach = 0.0;
    for (const auto& term : terms_) reach = std::max(reach, term->reach());
    return reach;
}

template <int Dim>
std::size_t ParticleModel<Dim>::list_builds() const {
    std::size_t builds = 0;
    for (const auto& term : terms_) builds += term->list_builds();
    return builds;
}

template <int Dim>
std::vector<Remark> ParticleModel<Dim>::watch(double t, std::span<const double> y) {
    std::vector<Remark> remarks;
    for (const auto& term : terms_)
        for (Remark& remark : term->watch(t, y)) remarks.push_back(std::move(remark));
    return remarks;
}

template <int Dim>
void ParticleModel<Dim>::set_bodies(std::vector<std::int32_t> bodies) {
    Model<Dim>::set_bodies(std::move(bodies));
    for (const auto& term : terms_) term->bodies_changed();
}

template <int Dim>
void ParticleModel<Dim>::remember(Archive& archive) {
    Model<Dim>::remember(archive);
    if (this->box().walled()) archive(reflections_);
    for (const auto& term : terms_) term->remember(archive);
}

template <int Dim>
bool ParticleModel<Dim>::settle(double t, std::span<double> y) {
    const State<Dim> state(this->layout(), y);
    bool changed = false;
    for (const auto& term : terms_) changed = term->settle(t, term->among().of(state)) || changed;
    return (this->box().walled() && reflect(state)) || changed;
}

/// A particle beyond a mirror and its image change places: nothing that others see changes, whenever it is
/// done.
template <int Dim>
bool ParticleModel<Dim>::reflect(const State<Dim>& state) {
    const std::size_t before = reflections_;
    for (int a = 0; a < Dim; ++a)
        for (const bool upper : {false, true}) {
            const Wall<Dim>& wall = this->box().wall(a, upper);
            if (wall.open()) continue;
            for (Eigen::Index i = 0; i < state.position().cols(); ++i)
                if (upper ? state.position()(a, i) > wall.at : state.position()(a, i) < wall.at)
                    reflections_ += reflect(state, i, a, wall) ? 1 : 0;
        }
    return reflections_ != before;
}

template <int Dim>
bool ParticleModel<Dim>::reflect(const State<Dim>& state, Eigen::Index i, int axis,
                                 const Wall<Dim>& wall) const {
    const auto x = state.position().col(i), v = state.velocity().col(i);
    const double m = this->particles().mass[static_cast<std::size_t>(i)];
    state.field(Field::impulse)(axis, 0) -= 2.0 * m * v[axis];
    const auto book_turning = [&](double sign) {
        const auto L = moment<Dim>(x, v);
        for (int plane = 0; plane < Given::planes; ++plane)
            state.field(Field::angular_impulse)(plane, 0) += sign * m * L[plane];
    };
    book_turning(-1.0);
    state.position()(axis, i) = 2.0 * wall.at - x[axis];
    state.velocity()(axis, i) = -v[axis];
    book_turning(1.0);
    if constexpr (Dim > 1) {
        if (state.has(Field::stress))
            for (int b = 0; b < Dim; ++b)
                if (b != axis) state.stress()(symmetric_index(Dim, axis, b), i) *= -1.0;
    }
    return true;
}

template class ParticleModel<1>;
template class ParticleModel<2>;
template class ParticleModel<3>;

}  // namespace spam
