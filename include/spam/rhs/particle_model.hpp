// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/exact_sum.hpp>
#include <spam/core/parts.hpp>
#include <spam/external/external.hpp>
#include <spam/rhs/term.hpp>

#include <functional>
#include <memory>
#include <type_traits>

namespace spam {

/// Particles that act on each other by terms (term.hpp) and on which externals act (external.hpp). Every
/// term goes with every other and with every external, unless physics forbids it: friction, gravity, a
/// clamp or a core are written once.
template <int Dim>
class ParticleModel : public Model<Dim> {
  public:
    /// Laws between particles, in the order in which they were added.
    using Terms = std::vector<std::unique_ptr<Term<Dim>>>;
    /// Laws from outside, likewise.
    using Externals = std::vector<std::shared_ptr<External<Dim>>>;

    /// Without a term nothing moves but by externals. Walls of the box (neighbors/wall.hpp) act by images of
    /// particles in every term, rigid ones by reflections; what they give is booked in the accounts, as a whole
    /// and wall by wall: y then has these. Throws InputError where the reference position of a particle is
    /// beyond one.
    explicit ParticleModel(Particles<Dim> particles, const Box<Dim>& box = {});

    /// One more term, Law(*this, arguments...). y grows by its fields: add terms and externals before a
    /// state is made. Throws InputError where it does not go with those that are there: two that find the
    /// rate of the same field of y, a potential of positions beside particles that move with an averaged
    /// velocity, or what a wall of the box means nothing to (Term::Nature).
    template <class Law, class... Arguments>
    Law& add_term(Arguments&&... arguments) {
        return add_term_among<Law>(0, this->particles().size(),
                                   std::forward<Arguments>(arguments)...);
    }
    /// The same among the particles stored as first, ..., first + count - 1 alone: populations that do
    /// not meet, or meet by a further term, in one y. Terms of different particles may find the same
    /// fields; those of particles that no term integrates stay as they are.
    template <class Law, class... Arguments>
    Law& add_term_among(std::size_t first, std::size_t count, Arguments&&... arguments) {
        if constexpr ((std::is_copy_constructible_v<std::decay_t<Arguments>> && ...))
            again_.push_back([first, count, ... kept = std::decay_t<Arguments>(arguments)](
                                 ParticleModel& part, std::span<const std::uint32_t> numbers) {
                const Own own(numbers, first, count);
                part.make_term<Law>(own.first, own.among.size(), of_part(kept, own.among)...);
            });
        else
            again_.push_back([](ParticleModel&, auto) { refuse_parts(); });
        return make_term<Law>(first, count, std::forward<Arguments>(arguments)...);
    }
    /// A model of the particles of these numbers alone, of the same laws: that of one part of a run, whose parts
    /// make it together (core/parts.hpp; numbers are those of Parts::here()). Externals are shared. Throws
    /// InputError where a law cannot be parted.
    std::unique_ptr<ParticleModel> part(std::span<const std::uint32_t> numbers) const;
    /// Whether x_dot = v, by every term.
    bool moves_with_velocity() const;
    /// In the order in which they are called.
    const Terms& terms() const { return terms_; }
    /// The first term that is a Law; null where there is none.
    template <class Law>
    const Law* term() const {
        for (const auto& term : terms_)
            if (const auto* law = dynamic_cast<const Law*>(term.get())) return law;
        return nullptr;
    }

    /// Adds an external behind those there are. y grows by the accounts (external.hpp). Throws InputError where it
    /// was made for another number of particles.
    void add(std::shared_ptr<External<Dim>> external);
    /// In the order in which they are applied.
    const Externals& externals() const { return externals_; }

    /// Those of the terms in their order, added up, then externals in theirs; see Model::rates.
    void rates(double t, std::span<const double> y, std::span<double> y_dot) final;
    /// With the potentials of externals.
    double internal_energy(std::span<const double> y) const final;
    /// Of the term that has elements; empty where none has.
    std::span<const Quadrilateral> quadrilaterals() const final;
    /// Of the first term that has its own, else what is in y; empty unless those of all are known.
    std::vector<double> density(std::span<const double> y) const final;
    /// Throws InputError where some particles are held and others are reflected: a reflection would move
    /// what is held.
    std::vector<Event> events() const final;
    /// The weakest of the terms' promises; what externals give is in the accounts.
    Promises promises() const final;
    /// Terms and externals in one line.
    std::string describe() const final;
    /// Why leapfrog cannot advance it (Model::inseparable), externals asked as well.
    std::string inseparable() const final;
    /// The sum of those of terms and externals, 1/time.
    double fastest_damping(std::span<const double> y) const final;
    /// The sum of those of the terms, mass length/time^2.
    double neighbour_forces(std::span<const double> y) const final;
    /// Whether the rates of every term are continuous.
    bool smooth() const final;
    /// In the latest right-hand side; terms among all particles have the same pairs, those among some add up.
    std::size_t pairs() const final;
    /// The largest of the terms, in units of length.
    double reach() const final;
    /// Remarks of all terms on an accepted state.
    std::vector<Remark> watch(double t, std::span<const double> y) final;
    /// N numbers; terms are told.
    void set_bodies(std::vector<std::int32_t> bodies) final;
    using Model<Dim>::remember;
    /// Bodies, and what every term remembers.
    void remember(Memory<Dim>& memory) final;
    /// Of each particle that of the last term that knows one, 1 where none does; empty where none knows any.
    std::vector<Mat<Dim>> deformation_gradients(std::span<const double> y) const final;
    void take_over(const Model<Dim>& before, std::span<const double> was, const Change<Dim>& change,
                   std::span<double> y) final;
    /// Whether a term settles, or the box has walls.
    bool settles() const final;
    /// Whether all terms that settle do so seldom, and the box has no walls.
    bool settles_seldom() const final;
    /// Of the terms; then particles that have crossed a wall are reflected. Of walls with images r -> -r,
    /// v_n -> -v_n, where externals have potentials with the velocity that keeps the energy; of rigid ones
    /// v_n -> -v_n where that leads outwards, and so of mirrors where a law has neighbours for good.
    bool settle(double t, std::span<double> y) final;
    /// How many have been, so far.
    std::size_t reflections() const { return reflections_; }

    /// Neighbour lists built so far, of all terms.
    std::size_t list_builds() const;

  private:
    /// What one external, or a wall, gives to a particle or to all of them, per time.
    struct Given {
        static constexpr std::size_t planes = Dim * (Dim - 1) / 2, count = Dim + planes + 2;
        std::array<double, count> numbers{};
        auto force() { return Eigen::Map<Point<Dim>>(numbers.data()); }
        auto torque() { return Eigen::Map<Eigen::Matrix<double, planes, 1>>(&numbers[Dim]); }
        double& power() { return numbers[Dim + planes]; }
        double& heat() { return numbers[Dim + planes + 1]; }
        /// Of 0, ..., n - 1, given(i) to each.
        template <class GivenTo>
        static Given to_all(std::size_t n, const GivenTo& given) {
            return {exact_sums(n, [&](std::size_t i) { return given(i).numbers; })};
        }
    };

    /// f(a, upper, wall): of every side that is a wall.
    template <class F>
    void for_each_wall(const F& f) const {
        for (int a = 0; a < Dim; ++a)
            for (const bool upper : {false, true})
                if (const Wall<Dim>& wall = this->box().wall(a, upper); !wall.open())
                    f(a, upper, wall);
    }
    void pay_for_potentials(const ParticleModel& before, std::span<const double> was,
                            const Change<Dim>& change, std::span<double> y) const;
    void refuse_beyond_walls() const;
    void refuse_walls(const Term<Dim>& term) const;
    void take(std::unique_ptr<Term<Dim>> term);
    template <class Law, class... Arguments>
    Law& make_term(std::size_t first, std::size_t count, Arguments&&... arguments) {
        const Parts::Among numbers(Parts::here(), first);
        auto term =
            std::make_unique<Law>(among(first, count), std::forward<Arguments>(arguments)...);
        Law& law = *term;
        take(std::move(term));
        return law;
    }
    Selection<Dim> among(std::size_t first, std::size_t count) {
        return count == this->particles().size() ? Selection<Dim>(*this)
                                                 : Selection<Dim>(*this, first, count);
    }
    /// Those of a part's particles that are first, ..., first + count - 1 of the whole: the first of them in the
    /// part, and their numbers from `first` on.
    struct Own {
        Own(std::span<const std::uint32_t> numbers, std::size_t first, std::size_t count);
        std::size_t first;
        std::vector<std::uint32_t> among;
    };
    [[noreturn]] static void refuse_parts();
    /// What a law is made of, for a part of the particles: what holds numbers by particle says what becomes of them.
    template <class Argument>
    static Argument of_part(const Argument& whole, std::span<const std::uint32_t> numbers) {
        if constexpr (requires { whole.of_part(numbers); })
            return whole.of_part(numbers);
        else
            return whole;
    }
    /// Again what has been added, to a model of a part of the particles.
    using Again = std::function<void(ParticleModel& part, std::span<const std::uint32_t> numbers)>;
    void find_rates(double t, std::span<const double> y, std::span<double> y_dot);
    bool term_rates(double t, std::span<const double> y, std::span<double> y_dot);
    void apply(External<Dim>& external, const typename External<Dim>::Now& now);
    void book(const External<Dim>& external, Given given, const State<Dim>& rate) const;
    void take(std::shared_ptr<External<Dim>> external);
    void add_accounts();
    void book_change(const Points<Dim>& velocity_before, const State<Dim>& state) const;
    void book_walls(const typename External<Dim>::Now& now);
    void book_wall(const typename External<Dim>::Now& now, int a, bool upper,
                   const Wall<Dim>& wall) const;
    bool reflect(const State<Dim>& state);
    bool neighbours_for_good() const;
    Given turn_back(const State<Dim>& state, Eigen::Index i, int a) const;
    double gained(std::size_t i, const Point<Dim>& from, const Point<Dim>& to) const;
    Given fold_back(const State<Dim>& state, Eigen::Index i, int a, bool upper) const;

    /// Where x_dot is not v a potential changes at another rate than its forces do work: the work is booked
    /// instead.
    bool has_energy(const External<Dim>& external) const {
        return external.potential() && moves_with_velocity();
    }

    Terms terms_;
    Externals externals_;
    std::vector<Again> again_;  ///< in the order in which it was added
    bool walled_;               ///< the box has walls
    bool whole_ = true;         ///< every term acts among all particles
    std::vector<double> more_;  ///< v_dot of a term that is not the first, or of a part
    std::size_t reflections_ = 0;
};

SPAM_COMPILED(extern template class ParticleModel);

/// Particles of one law and nothing else, made of what the law is made of.
template <int Dim, class Law, class... What>
class ModelOf final : public ParticleModel<Dim> {
  public:
    /// Throws InputError as Law does.
    ModelOf(Particles<Dim> particles, const What&... what, const Box<Dim>& box = {})
        : ParticleModel<Dim>(std::move(particles), box),
          law(this->template add_term<Law>(what...)) {}

    /// The choices it was made with, of a law that has some.
    const auto& scheme() const { return law.scheme(); }

    Law& law;
};

}  // namespace spam
