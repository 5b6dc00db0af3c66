// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/parts.hpp>
#include <spam/rhs/particle_model.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace spam {

template <int Dim>
ParticleModel<Dim>::ParticleModel(Particles<Dim> particles, const Box<Dim>& box)
    : Model<Dim>(std::move(particles), box, {Field::position, Field::velocity}),
      walled_(box.walled()) {
    // Laws of parts are made of the bodies that those of the whole were made of, whatever has been found since.
    again_.push_back([body = this->particles().body](ParticleModel& part, auto numbers) {
        if (body.empty()) return;
        std::vector<std::int32_t> own;
        for (const std::uint32_t i : numbers) own.push_back(body[i]);
        part.set_bodies(std::move(own));
    });
    if (!walled_) return;
    refuse_beyond_walls();
    add_accounts();
    for_each_wall([&](int a, bool upper, const Wall<Dim>& wall) {
        this->layout().add(Field::wall_impulse(a, upper));
        this->layout().add(Field::wall_work(a, upper));
        if (wall.passes_energy()) this->layout().add(Field::wall_heat(a, upper));
    });
}

template <int Dim>
void ParticleModel<Dim>::take(std::unique_ptr<Term<Dim>> term) {
    refuse_walls(*term);
    for (const auto& other : terms_) {
        if (!other->nature().elements.empty() && !term->nature().elements.empty())
            throw InputError(fmt::format(
                "model: '{}' and '{}' both have elements; make one term of them, with a list of materials",
                other->nature().description, term->nature().description));
        if (!other->among().overlaps(term->among())) continue;
        for (const auto& [law, mesh] :
             {std::pair{term.get(), other.get()}, {other.get(), term.get()}})
            if (law->nature().sums_density && mesh->nature().fluid_corners)
                throw InputError(fmt::format(
                    "model: '{}' sums densities over particles, and corners of elements that hold a fluid have none; "
                    "leave it out, let it act among other particles, or use a fluid of smooth particles",
                    law->nature().description));
        for (const Field field : term->nature().fields)
            for (const Field taken : other->nature().fields)
                if (field == taken)
                    throw InputError(fmt::format(
                        "model: '{}' and '{}' both integrate the {} of a particle; leave "
                        "one of the two out",
                        other->nature().description, term->nature().description, field.name()));
        const Term<Dim>& averaged = term->nature().moves_with_velocity ? *other : *term;
        const Term<Dim>& fixed = term->nature().moves_with_velocity ? *term : *other;
        if (!averaged.nature().moves_with_velocity && fixed.nature().potential)
            throw InputError(fmt::format(
                "transport: particles that move with an averaged velocity gain energy without limit "
                "from a potential of their positions ({}), whose forces push what the average does "
                "not move; use --transport plain, or leave the potential out",
                fixed.nature().description));
    }
    for (const Field field : term->nature().fields) this->layout().add(field);
    if (!term->nature().elements.empty())
        this->layout().set_elements(term->nature().elements.size());
    for (const Field field : term->nature().element_fields)
        this->layout().add(field, Holder::element);
    whole_ = whole_ && term->among().whole();
    terms_.push_back(std::move(term));
    if (terms_.size() > 1 || !whole_) more_.resize(Dim * this->particles().size());
}

template <int Dim>
void ParticleModel<Dim>::add(std::shared_ptr<External<Dim>> external) {
    if (const std::size_t known = external->particles();
        known != 0 && Parts::here().numbers().empty() && known != this->particles().size())
        throw InputError(
            fmt::format("external: {} was made for {} particles, and the model has {}; give one "
                        "value for each particle",
                        external->describe(), known, this->particles().size()));
    take(std::move(external));
}

template <int Dim>
bool ParticleModel<Dim>::moves_with_velocity() const {
    return std::ranges::all_of(terms_,
                               [](const auto& term) { return term->nature().moves_with_velocity; });
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
        std::ranges::fill(y_dot, 0.0);
        rate.position() = state.velocity();
        moved = true;
    }
    for (const auto& term : terms_) {
        const Selection<Dim>& among = term->among();
        const bool in_place = whole_ && term == terms_.front();
        double* const found = in_place ? v_dot : more_.data() + Dim * among.first();
        const Parts::Among numbers(Parts::here(), among.first());
        if (auto reason = term->rates({t, among.of(state), among.of(rate), found});
            !reason.empty()) {
            this->fail(y_dot, std::move(reason));
            return false;
        }
        if (!in_place) {
            double* const sum = v_dot + Dim * among.first();
            parallel_for(Dim * among.count(), [=](std::size_t k) { sum[k] += found[k]; });
        }
        moved = moved || term->nature().moves;
    }
    if (!moved) rate.position() = state.velocity();
    return true;
}

/// Where a state has no meaning in some part, the others are told at whatever they exchange next, at the end at the
/// latest: no law needs to take care that it makes as many exchanges as elsewhere. Steps of a fixed length agree at
/// their end (FixedSteps), and tell the others themselves.
template <int Dim>
void ParticleModel<Dim>::rates(double t, std::span<const double> y, std::span<double> y_dot) {
    this->failure_.clear();
    if (Parts::here().agrees_later()) return find_rates(t, y, y_dot);
    try {
        find_rates(t, y, y_dot);
        if (!this->failure_.empty()) return Parts::here().give_up(this->failure_);
        Parts::here().agree();
    } catch (const PartGaveUp& other) {
        this->fail(y_dot, other.what());
    }
}

template <int Dim>
void ParticleModel<Dim>::find_rates(double t, std::span<const double> y, std::span<double> y_dot) {
    if (!term_rates(t, y, y_dot)) return;
    const State<Dim> rate(this->layout(), y_dot);
    for (const auto& b : this->layout().blocks())
        if (b.field.role() != Role::integrated)
            std::fill_n(y_dot.begin() + static_cast<std::ptrdiff_t>(b.offset), b.size, 0.0);
    const typename External<Dim>::Now now{
        t, this->particles(), {this->layout(), y}, rate, Parts::here().numbers()};
    if (this->box().has_images()) book_walls(now);
    for (const auto& external : externals_) {
        external->prepare(now);
        apply(*external, now);
    }
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
std::span<const Quadrilateral> ParticleModel<Dim>::quadrilaterals() const {
    for (const auto& term : terms_)
        if (!term->nature().elements.empty()) return term->nature().elements;
    return {};
}

template <int Dim>
std::vector<double> ParticleModel<Dim>::density(std::span<const double> y) const {
    std::vector<double> rho = Model<Dim>::density(y);
    std::vector<bool> known(this->particles().size(), !rho.empty()), of_term(known.size(), false);
    rho.resize(known.size());
    for (const auto& term : terms_) {
        const std::size_t first = term->among().first();
        const auto found =
            term->density(y);  // a call of all parts, also of one without its particles
        if (found.empty() || of_term[first]) continue;
        for (std::size_t k = 0; k < found.size(); ++k) {
            rho[first + k] = found[k];
            known[first + k] = of_term[first + k] = true;
        }
    }
    if (std::ranges::find(known, false) != known.end()) rho.clear();
    if (!rho.empty())
        for (const auto& external : externals_) external->add_density({this->layout(), y}, rho);
    return rho;
}

template <int Dim>
std::vector<Event> ParticleModel<Dim>::events() const {
    std::vector<bool> held(this->particles().size());
    bool guided = false;
    for (std::size_t i = 0; i < held.size(); ++i)
        for (const auto& external : externals_) {
            const int axes = external->prescribed_axes(Parts::here().number(i));
            held[i] = held[i] || axes == Dim;
            guided = guided || (axes > 0 && axes < Dim);
        }
    std::vector<Event> events;
    for (const auto& term : terms_)
        if (term->nature().events)
            for (Event& event : term->nature().events(held)) events.push_back(std::move(event));
    Parts& parts = Parts::here();
    // What does not move never meets.
    if (events.empty() || !parts.any(std::ranges::find(held, false) != held.end())) return {};
    if (parts.any(guided))
        throw InputError(
            "closest-approach: a reflection would change the velocity that is prescribed along one "
            "axis; hold those particles altogether, or leave the closest approach out");
    if (!parts.any(std::ranges::find(held, true) != held.end())) return events;
    for (Event& event : events)
        event.apply = [this, apply = std::move(event.apply)](double t, std::span<double> y) {
            const State<Dim> state(this->layout(), y);
            const Points<Dim> before = state.velocity();
            const std::size_t changes = apply(t, y);
            book_change(before, state);
            return changes;
        };
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
        const Promises p = term->nature().promises;
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
    for (const auto& term : terms_)
        words += (words.empty() ? "" : "; ") + term->nature().description;
    for (const auto& external : externals_)
        words += (words.empty() ? "" : "; ") + external->describe();
    if (walled_) words += (words.empty() ? "" : "; ") + this->box().describe_walls();
    return words;
}

template <int Dim>
std::string ParticleModel<Dim>::inseparable() const {
    for (const auto& external : externals_)
        if (auto why = external->inseparable(); !why.empty()) return why;
    return Model<Dim>::inseparable();
}

template <int Dim>
bool ParticleModel<Dim>::settles() const {
    return walled_ || Model<Dim>::settles() ||
           std::ranges::any_of(terms_, [](const auto& term) { return term->nature().settles; });
}

template <int Dim>
bool ParticleModel<Dim>::settles_seldom() const {
    return !walled_ && !Model<Dim>::settles() && std::ranges::all_of(terms_, [](const auto& term) {
        return !term->nature().settles || term->nature().settles_seldom;
    });
}

template <int Dim>
double ParticleModel<Dim>::fastest_damping(std::span<const double> y) const {
    double damping = 0.0;
    for (const auto& term : terms_) damping += term->fastest_damping(y);
    for (const auto& external : externals_) damping += external->damping();
    return damping;
}

/// Potentials of externals are no forces between neighbours.
template <int Dim>
double ParticleModel<Dim>::neighbour_forces(std::span<const double> y) const {
    double forces = 0.0;
    for (const auto& term : terms_) forces += term->neighbour_forces(y);
    return forces;
}

template <int Dim>
bool ParticleModel<Dim>::smooth() const {
    return std::ranges::all_of(terms_, [](const auto& term) { return term->nature().smooth; });
}

template <int Dim>
std::size_t ParticleModel<Dim>::pairs() const {
    std::size_t of_all = 0, of_parts = 0;  // terms of the same particles have the same neighbours
    for (const auto& term : terms_)
        if (term->among().whole())
            of_all = std::max(of_all, term->counts().pairs);
        else
            of_parts += term->counts().pairs;
    return of_all + of_parts;
}

template <int Dim>
double ParticleModel<Dim>::reach() const {
    double reach = 0.0;
    for (const auto& term : terms_) reach = std::max(reach, term->nature().reach);
    return reach;
}

template <int Dim>
std::size_t ParticleModel<Dim>::list_builds() const {
    std::size_t builds = 0;
    for (const auto& term : terms_) builds += term->counts().list_builds;
    return builds;
}

template <int Dim>
std::vector<Remark> ParticleModel<Dim>::watch(double t, std::span<const double> y) {
    std::vector<Remark> remarks;
    for (const auto& term : terms_) {
        const Parts::Among numbers(Parts::here(), term->among().first());
        for (Remark& remark : term->watch(t, y)) remarks.push_back(std::move(remark));
    }
    return remarks;
}

template <int Dim>
void ParticleModel<Dim>::set_bodies(std::vector<std::int32_t> bodies) {
    Model<Dim>::set_bodies(std::move(bodies));
    for (const auto& term : terms_) term->bodies_changed();
}

SPAM_COMPILED(template class ParticleModel);

}  // namespace spam
