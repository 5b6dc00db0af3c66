// SPDX-License-Identifier: GPL-3.0-or-later
// What externals and walls give to the particles of a model, and to its accounts.
#include <spam/core/exact_sum.hpp>
#include <spam/core/parts.hpp>
#include <spam/neighbors/neighbourhood.hpp>
#include <spam/rhs/particle_model.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace spam {
namespace {

template <int Dim>
[[gnu::always_inline]] inline auto moment(const Point<Dim>& r, const Point<Dim>& f) {
    Eigen::Matrix<double, Dim*(Dim - 1) / 2, 1> m;
    if constexpr (Dim == 2) m[0] = r.x() * f.y() - r.y() * f.x();
    if constexpr (Dim == 3) m = r.cross(f);
    return m;
}

}  // namespace

template <int Dim>
void ParticleModel<Dim>::add_accounts() {
    for (const Field field : {Field::work, Field::heat, Field::impulse, Field::angular_impulse})
        this->layout().add(field);
}

/// What the external gives is the difference that it makes to the rates the particles had before it. Many act on few
/// particles: blocks whose rates have the same bits as before add nothing.
template <int Dim>
void ParticleModel<Dim>::apply(External<Dim>& external, const typename External<Dim>::Now& now) {
    const bool has_energy = now.rate.has(Field::energy);
    const auto x = now.state.position(), v = now.state.velocity();
    const auto moves = now.rate.position(), falls = now.rate.velocity();
    const auto give = [&](std::size_t begin, std::size_t size, auto& rows) {
        const auto first = static_cast<Eigen::Index>(begin),
                   count = static_cast<Eigen::Index>(size);
        Eigen::Matrix<double, Dim, ExactSum::block> x_dot, v_dot;
        Eigen::Matrix<double, 1, ExactSum::block> e_dot;
        x_dot.leftCols(count) = moves.middleCols(first, count);
        v_dot.leftCols(count) = falls.middleCols(first, count);
        if (has_energy) e_dot.leftCols(count) = now.rate.energy().middleCols(first, count);
        external.add(now, first, first + count);
        const auto same = [&](const auto& before, const auto& after) {
            return std::memcmp(before.data(), after.data(),
                               sizeof(double) * static_cast<std::size_t>(after.size())) == 0;
        };
        if (same(v_dot, falls.middleCols(first, count)) &&
            same(x_dot, moves.middleCols(first, count)) &&
            (!has_energy || same(e_dot, now.rate.energy().middleCols(first, count))))
            return false;
        const double* const m = &now.particles.mass[begin];
        for (std::size_t k = 0; k < size; ++k) {
            const auto at = static_cast<Eigen::Index>(k), i = first + at;
            const Point<Dim> force = m[k] * (falls.col(i) - v_dot.col(at));
            const Eigen::Matrix<double, Given::planes, 1> torque =
                moment<Dim>(x.col(i), force) +
                m[k] * moment<Dim>(moves.col(i) - x_dot.col(at), v.col(i));
            for (int a = 0; a < Dim; ++a) rows[static_cast<std::size_t>(a)][k] = force[a];
            for (Eigen::Index q = 0; q < torque.size(); ++q)
                rows[static_cast<std::size_t>(Dim + q)][k] = torque[q];
            rows[Given::count - 2][k] = force.dot(v.col(i));
            rows[Given::count - 1][k] = 0.0;
        }
        if (has_energy)
            for (std::size_t k = 0; k < size; ++k) {
                const auto at = static_cast<Eigen::Index>(k);
                rows[Given::count - 1][k] =
                    m[k] * (now.rate.energy()(0, first + at) - e_dot(0, at));
            }
        return true;
    };
    book(external, {exact_sums_of_blocks<Given::count>(now.particles.size(), give)}, now.rate);
}

/// Of momentum and energy what particles do to each other cancels in the sums over all of them: what is left came
/// through the walls. Of the energy that passes them a moving wall's force times its velocity is work, the rest heat.
/// Torques do not cancel where forces act across r_ij: of them only those by images are the walls' (book_wall).
template <int Dim>
void ParticleModel<Dim>::book_walls(const typename External<Dim>::Now& now) {
    const auto v = now.state.velocity();
    const auto v_dot = now.rate.velocity();
    const bool energy = this->box().passes_energy() && now.rate.has(Field::energy);
    Given sum = Given::to_all(now.particles.size(), [&](std::size_t k) {
        const auto i = static_cast<Eigen::Index>(k);
        const double m = now.particles.mass[k];
        const Point<Dim> force = m * v_dot.col(i);
        Given given;
        given.force() = force;
        if (energy) given.power() = force.dot(v.col(i)) + m * now.rate.energy()(0, i);
        return given;
    });
    now.rate.field(Field::impulse) += sum.force();
    double work = 0.0;
    for_each_wall([&](int a, bool upper, const Wall<Dim>& wall) {
        if (!wall.has_images()) return;
        book_wall(now, a, upper, wall);
        work += now.rate.field(Field::wall_work(a, upper))(0, 0);
    });
    if (!energy) return;
    now.rate.field(Field::work)(0, 0) += work;
    now.rate.field(Field::heat)(0, 0) += sum.power() - work;
}

/// What the images behind one wall give.
template <int Dim>
void ParticleModel<Dim>::book_wall(const typename External<Dim>::Now& now, int a, bool upper,
                                   const Wall<Dim>& wall) const {
    const auto x = now.state.position(), v = now.state.velocity();
    const bool energy = wall.passes_energy() && now.rate.has(Field::energy);
    Given sum;
    const auto give = [&](std::size_t first, const BehindWall<Dim>& rates) {
        Given given = Given::to_all(rates.particle.size(), [&](std::size_t k) {
            const std::size_t number = first + rates.particle[k];
            const auto i = static_cast<Eigen::Index>(number);
            const double m = now.particles.mass[number];
            const Point<Dim> one =
                m * Eigen::Map<const Point<Dim>>(&rates.v_dot[Dim * rates.place[k]]);
            Given to;
            to.force() = one;
            to.torque() = moment<Dim>(x.col(i), one);
            if (energy) to.power() = one.dot(v.col(i)) + m * rates.e_dot[rates.place[k]];
            return to;
        });
        sum.force() += given.force();
        sum.torque() += given.torque();
        sum.power() += given.power();
    };
    for (const auto& term : terms_)
        for (const auto* near : term->neighbourhoods())
            if (const auto* rates = near->behind(a, upper)) give(term->among().first(), *rates);
    now.rate.field(Field::wall_impulse(a, upper)) += sum.force();
    if constexpr (Dim > 1) now.rate.field(Field::angular_impulse) += sum.torque();
    if (!energy) return;
    const double work = sum.force().dot(wall.velocity);
    now.rate.field(Field::wall_work(a, upper))(0, 0) += work;
    now.rate.field(Field::wall_heat(a, upper))(0, 0) += sum.power() - work;
}

template <int Dim>
void ParticleModel<Dim>::book(const External<Dim>& external, Given given,
                              const State<Dim>& rate) const {
    rate.field(Field::impulse) += given.force();
    if constexpr (Dim > 1) rate.field(Field::angular_impulse) += given.torque();
    if (!has_energy(external))
        rate.field(external.thermal() ? Field::heat : Field::work)(0, 0) += given.power();
    rate.field(Field::heat)(0, 0) += given.heat();
}

/// What all particles have gained in an event while some are held came from what holds these.
template <int Dim>
void ParticleModel<Dim>::book_change(const Points<Dim>& velocity_before,
                                     const State<Dim>& state) const {
    const auto x = state.position(), v = state.velocity();
    Given sum = Given::to_all(this->particles().size(), [&](std::size_t k) {
        const auto i = static_cast<Eigen::Index>(k);
        Given given;
        given.force() = this->particles().mass[k] * (v.col(i) - velocity_before.col(i));
        given.torque() = moment<Dim>(x.col(i), given.force());
        given.power() = 0.5 * given.force().dot(v.col(i) + velocity_before.col(i));
        return given;
    });
    state.field(Field::impulse) += sum.force();
    if constexpr (Dim > 1) state.field(Field::angular_impulse) += sum.torque();
    state.field(Field::work)(0, 0) += sum.power();
}

template <int Dim>
bool ParticleModel<Dim>::settle(double t, std::span<double> y) {
    const State<Dim> state(this->layout(), y);
    bool changed = false;
    for (const auto& term : terms_) {
        const Parts::Among numbers(Parts::here(), term->among().first());
        changed = term->settle(t, term->among().of(state)) || changed;
    }
    return Parts::here().any((walled_ && reflect(state)) || changed);
}

template <int Dim>
bool ParticleModel<Dim>::reflect(const State<Dim>& state) {
    const std::size_t before = reflections_;
    // A particle whose motion is prescribed altogether passes.
    const auto held = [&](Eigen::Index i) {
        const std::size_t number = Parts::here().number(static_cast<std::size_t>(i));
        return std::ranges::any_of(externals_, [&](const auto& external) {
            return external->prescribed_axes(number) == Dim;
        });
    };
    for_each_wall([&](int a, bool upper, const Wall<Dim>& wall) {
        const auto x = state.position(), v = state.velocity();
        const bool folds = wall.has_images() && !neighbours_for_good();
        std::vector<Given> turned;
        for (Eigen::Index i = 0; i < x.cols(); ++i) {
            if (!(upper ? x(a, i) > wall.at : x(a, i) < wall.at) || held(i)) continue;
            if (folds)
                turned.push_back(fold_back(state, i, a, upper));
            else if (upper ? v(a, i) > 0.0 : v(a, i) < 0.0)
                turned.push_back(turn_back(state, i, a));
        }
        const std::size_t turns = Parts::here().total(turned.size());
        if (turns == 0) return;
        reflections_ += turns;
        Given sum = Given::to_all(turned.size(), [&](std::size_t k) { return turned[k]; });
        for (const Field impulse : {Field::impulse, Field::wall_impulse(a, upper)})
            state.field(impulse)(a, 0) += sum.force()[a];
        if constexpr (Dim > 1) state.field(Field::angular_impulse) += sum.torque();
        for (const Field work : {Field::work, Field::wall_work(a, upper)})
            if (sum.power() != 0.0) state.field(work)(0, 0) += sum.power();
    });
    return reflections_ != before;
}

/// At the place where it is, so that no distance changes, and no energy that depends on distances. Returns the impulse
/// and its moment.
template <int Dim>
auto ParticleModel<Dim>::turn_back(const State<Dim>& state, Eigen::Index i, int a) const -> Given {
    const double m = this->particles().mass[static_cast<std::size_t>(i)];
    Given given;
    given.force()[a] = -2.0 * m * state.velocity()(a, i);
    state.velocity()(a, i) *= -1.0;
    given.torque() = moment<Dim>(state.position().col(i), given.force());
    return given;
}

/// What a particle gains in the potentials of externals when it is moved.
template <int Dim>
double ParticleModel<Dim>::gained(std::size_t i, const Point<Dim>& from,
                                  const Point<Dim>& to) const {
    double energy = 0.0;
    for (const auto& external : externals_)
        if (has_energy(*external))
            energy += external->energy_at(this->particles(), i, to) -
                      external->energy_at(this->particles(), i, from);
    return energy;
}

/// A particle and its image would change places, with their neighbours for good or without.
template <int Dim>
bool ParticleModel<Dim>::neighbours_for_good() const {
    for (const auto& term : terms_)
        for (const auto* near : term->neighbourhoods())
            if (near->for_good()) return true;
    return false;
}

/// A particle beyond a mirror and its image change places: nothing that others see changes, whenever it is
/// done. r -> -r, v_n -> -v_n, but for what the change of place means in potentials of externals: gravity has
/// pulled the particle on behind the wall, and would have slowed it down before it. What is more than its
/// motion can give is the wall's work. Returns that, the impulse and its moment.
template <int Dim>
auto ParticleModel<Dim>::fold_back(const State<Dim>& state, Eigen::Index i, int axis,
                                   bool upper) const -> Given {
    const Wall<Dim>& wall = this->box().wall(axis, upper);
    const auto x = state.position().col(i), v = state.velocity().col(i);
    const double m = this->particles().mass[static_cast<std::size_t>(i)];
    Point<Dim> to = x;
    to[axis] = 2.0 * wall.at - x[axis];
    const double gain = gained(static_cast<std::size_t>(i), x, to);
    const double square = v[axis] * v[axis] - 2.0 * gain / m;
    const double turned =
        gain == 0.0 ? -v[axis] : -std::copysign(std::sqrt(std::max(square, 0.0)), v[axis]);
    Given given;
    if (square < 0.0) given.power() = -0.5 * m * square;
    given.force()[axis] = m * (turned - v[axis]);
    const Eigen::Matrix<double, Dim*(Dim - 1) / 2, 1> L = moment<Dim>(x, v);
    state.position()(axis, i) = to[axis];
    state.velocity()(axis, i) = turned;
    given.torque() = m * (moment<Dim>(x, v) - L);
    if constexpr (Dim > 1) {
        if (state.has(Field::stress))
            for (int b = 0; b < Dim; ++b)
                if (b != axis) state.stress()(symmetric_index(Dim, axis, b), i) *= -1.0;
    }
    return given;
}

#define SPAM_INSTANTIATE(D)                                                                       \
    template void ParticleModel<D>::add_accounts();                                               \
    template void ParticleModel<D>::apply(External<D>&, const External<D>::Now&);                 \
    template void ParticleModel<D>::book(const External<D>&, Given, const State<D>&) const;       \
    template void ParticleModel<D>::book_walls(const External<D>::Now&);                          \
    template void ParticleModel<D>::book_wall(const External<D>::Now&, int, bool, const Wall<D>&) \
        const;                                                                                    \
    template void ParticleModel<D>::book_change(const Points<D>&, const State<D>&) const;         \
    template bool ParticleModel<D>::settle(double, std::span<double>);                            \
    template bool ParticleModel<D>::reflect(const State<D>&);                                     \
    template bool ParticleModel<D>::neighbours_for_good() const;                                  \
    template ParticleModel<D>::Given ParticleModel<D>::turn_back(const State<D>&, Eigen::Index,   \
                                                                 int) const;                      \
    template ParticleModel<D>::Given ParticleModel<D>::fold_back(const State<D>&, Eigen::Index,   \
                                                                 int, bool) const;                \
    template double ParticleModel<D>::gained(std::size_t, const Point<D>&, const Point<D>&) const;
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
