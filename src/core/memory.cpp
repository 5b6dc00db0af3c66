// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/memory.hpp>
#include <spam/core/parts.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

namespace spam {
namespace {

/// Where the numbers of each row begin, and where those of the last one end.
std::vector<std::size_t> starts_of(const std::vector<std::uint32_t>& count) {
    std::vector<std::size_t> start(count.size() + 1, 0);
    std::inclusive_scan(count.begin(), count.end(), start.begin() + 1, std::plus<>(),
                        std::size_t{0});
    return start;
}

/// Puts what `from` has of a row behind what `to` has.
void append_row(BondNumbers& to, const BondNumbers& from, std::size_t row,
                const std::vector<std::size_t>& start, std::size_t stride) {
    const auto add = [](auto& all, const auto& some, std::size_t begin, std::size_t end) {
        all.insert(all.end(), some.begin() + static_cast<std::ptrdiff_t>(begin),
                   some.begin() + static_cast<std::ptrdiff_t>(end));
    };
    to.count.push_back(from.count[row]);
    add(to.partners, from.partners, start[row], start[row + 1]);
    add(to.numbers, from.numbers, start[row] * stride, start[row + 1] * stride);
}

/// The rows of all parts of a run, in the order of their numbers; `own` are those of this part's.
BondNumbers rows_of_all(const BondNumbers& rows, const std::vector<std::uint32_t>& own,
                        std::size_t stride) {
    Parts& parts = Parts::here();
    const auto of_each = [&](const auto& values) { return parts.gather(std::span(values)); };
    const auto numbers = of_each(own), count = of_each(rows.count),
               partners = of_each(rows.partners);
    const auto values = of_each(rows.numbers);
    std::vector<BondNumbers> of_part;
    std::vector<std::vector<std::size_t>> start;
    std::vector<std::array<std::size_t, 3>> at;  // number, part and row
    for (std::size_t p = 0; p < parts.count(); ++p) {
        of_part.push_back({count[p], partners[p], values[p]});
        start.push_back(starts_of(count[p]));
        for (std::size_t k = 0; k < numbers[p].size(); ++k) at.push_back({numbers[p][k], p, k});
    }
    std::ranges::sort(at);
    BondNumbers all;
    for (const auto& [number, p, k] : at) append_row(all, of_part[p], k, start[p], stride);
    return all;
}

void ascending_once(std::vector<std::array<std::uint32_t, 2>>& pairs) {
    std::ranges::sort(pairs);
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

template <int Dim>
Vec<Dim> vector_of(const Point<Dim>& r) {
    return numbers_at<Vec<Dim>>(r.data());
}

}  // namespace

template <int Dim>
Change<Dim> Change<Dim>::among(std::size_t first, std::size_t count, std::size_t was,
                               std::size_t number) const {
    Change some;
    const auto begin = parts.begin() + static_cast<std::ptrdiff_t>(first);
    some.parts.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
    some.back.assign(back.begin() + static_cast<std::ptrdiff_t>(was),
                     back.begin() + static_cast<std::ptrdiff_t>(was + number));
    some.id = id.subspan(was, number);
    for (auto& made_of : some.parts)
        for (Part& part : made_of) {
            if (part.particle < was || part.particle >= was + number)
                throw InputError(fmt::format(
                    "population: particle {} goes to other laws than those it remembers; number "
                    "the particles of each law of the next model as they are now",
                    id[part.particle]));
            part.particle -= static_cast<std::uint32_t>(was);
        }
    return some;
}

template <int Dim>
void Change<Dim>::carry(Field field, const double* old, double* made,
                        std::size_t components) const {
    for (std::size_t k = 0; k < parts.size(); ++k)
        for (std::size_t c = 0; c < components; ++c) {
            const auto of = [&](const Part& part) { return old[part.particle * components + c]; };
            const Part& first = parts[k].front();
            double& value = made[k * components + c];
            value = 0.0;
            if (field.quantity() == Quantity::position)
                value = of(first) + first.offset[static_cast<Eigen::Index>(c)];
            else if (field.share() == Share::equal) {
                value = of(first);
                for (const Part& part : parts[k])
                    if (of(part) != value)
                        throw InputError(fmt::format(
                            "population: particles {} and {} differ in '{}' and cannot be one",
                            id[first.particle], id[part.particle], field.name()));
            } else
                for (const Part& part : parts[k])
                    value += (field.share() == Share::sum ? part.of : part.share) * of(part);
        }
}

template <int Dim>
void Memory<Dim>::begin(Field field, Holder holder) {
    fields_.emplace_back(field, holder);
    std::string name(field.name());
    archive_(name);
    if (name != field.name())
        throw InputError(
            fmt::format("'{}' was remembered where '{}' was expected", name, field.name()));
}

template <int Dim>
void Memory<Dim>::expect(Field field, bool fits) const {
    if (!fits)
        throw InputError(fmt::format("the '{}' that was remembered is not that of these particles",
                                     field.name()));
}

template <int Dim>
void Memory<Dim>::laws(std::string names) {
    const std::string own = names;
    archive_(names);
    if (names == own) return;
    throw InputError(
        carries() ? "population: the next model must be made of the same laws in the same order"
                  : "what was remembered is not of these laws");
}

template <int Dim>
void Memory<Dim>::among(std::size_t first, std::size_t count) {
    if (Parts& parts = Parts::here();
        !parts.alone()) {  // written and read is what holds for the whole run
        const double own =
            count > 0 ? parts.number(first) : std::numeric_limits<double>::infinity();
        own_.clear();
        for (std::size_t i = 0; i < count; ++i) own_.push_back(parts.number(first + i));
        first = static_cast<std::size_t>(-parts.most(-own));
        for (std::uint32_t& i : own_) i -= static_cast<std::uint32_t>(first);
        count = parts.total(count);
    }
    std::size_t was = first;
    was_ = count_ = count;
    archive_(was, was_);
    if (!carries()) {
        if (was != first || was_ != count)
            throw InputError("what was remembered is not of these particles");
        return;
    }
    change_ = whole_->among(first, count, was, was_);
}

template <int Dim>
void Memory<Dim>::particles(Field field, std::vector<double>& values) {
    begin(field, Holder::particle);
    Parts& parts = Parts::here();
    const std::size_t components = field.components<Dim>();
    std::vector<double> old;
    if (!reading()) old = parts.by_number(std::span<const double>(values), components, own_);
    archive_(old);
    if (!reading()) return;
    expect(field, old.size() == components * was_);
    if (!carries()) values = parts.own_of(std::span<const double>(old), components, own_);
    if (!carries() || field.role() == Role::derived) return;
    values.resize(components * count_);
    change_.carry(field, old.data(), values.data(), components);
}

template <int Dim>
void Memory<Dim>::particles(Field field, std::vector<std::int32_t>& labels) {
    begin(field, Holder::particle);
    Parts& own = Parts::here();
    std::vector<std::int32_t> old;
    if (!reading()) old = own.by_number(std::span<const std::int32_t>(labels), 1, own_);
    archive_(old);
    if (!reading()) return;
    expect(field, old.size() == was_);
    if (!carries()) labels = own.own_of(std::span<const std::int32_t>(old), 1, own_);
    if (!carries() || field.role() == Role::derived) return;
    labels.clear();
    for (const auto& parts : change_.parts) {
        const auto first = parts.front().particle;
        labels.push_back(old[first]);
        for (const auto& part : parts)
            if (old[part.particle] != old[first])
                throw InputError(
                    fmt::format("population: particles {} and {} differ in '{}' and cannot be one",
                                change_.id[first], change_.id[part.particle], field.name()));
    }
}

template <int Dim>
std::vector<std::vector<std::uint32_t>> Memory<Dim>::heirs() const {
    std::vector<std::vector<std::uint32_t>> heirs(was_);
    for (std::uint32_t k = 0; k < change_.parts.size(); ++k)
        for (const auto& part : change_.parts[k]) heirs[part.particle].push_back(k);
    return heirs;
}

template <int Dim>
void Memory<Dim>::bonds(std::span<const Field> fields, BondNumbers& bonds) {
    std::size_t stride = 0;
    for (const Field field : fields) {
        begin(field, Holder::bond);
        stride += field.components<Dim>();
    }
    const bool alone = Parts::here().alone();
    if (!reading() && !alone) bonds = rows_of_all(bonds, own_, stride);
    archive_(bonds.count, bonds.partners, bonds.numbers);
    if (!reading()) return;
    const std::size_t all = std::accumulate(bonds.count.begin(), bonds.count.end(), std::size_t{0});
    expect(fields.front(),
           bonds.count.size() == was_ && bonds.partners.size() == all &&
               bonds.numbers.size() == stride * all &&
               std::ranges::all_of(bonds.partners, [&](std::uint32_t j) { return j < was_; }));
    const std::vector<std::size_t> start = starts_of(bonds.count);
    if (!alone) {
        const BondNumbers whole = std::move(bonds);
        bonds = {};
        for (const std::uint32_t k : own_) append_row(bonds, whole, k, start, stride);
    }
    if (!carries()) return;

    const auto heirs = this->heirs();
    BondNumbers made;
    struct Sum {
        std::uint32_t partner;
        double weight;
        std::vector<double> numbers;
    };
    for (std::uint32_t k = 0; k < change_.parts.size(); ++k) {
        std::vector<Sum> row;                     // in the order in which the old row had them
        std::map<std::uint32_t, std::size_t> at;  // of a partner
        for (const auto& own : change_.parts[k])
            for (std::size_t n = start[own.particle]; n < start[own.particle + 1]; ++n) {
                const std::uint32_t b = bonds.partners[n];
                if (b == own.particle) continue;  // a vacancy
                for (const std::uint32_t j : heirs[b]) {
                    if (j == k) continue;
                    const auto& theirs =
                        *std::ranges::find(change_.parts[j], b, &Change<Dim>::Part::particle);
                    const double weight = own.share * theirs.share;
                    const auto [found, is_new] = at.try_emplace(j, row.size());
                    if (is_new) row.push_back({j, 0.0, std::vector<double>(stride, 0.0)});
                    Sum& sum = row[found->second];
                    sum.weight += weight;
                    const Vec<Dim> way =
                        change_.back[own.particle] * vector_of<Dim>(theirs.offset - own.offset);
                    std::size_t c = 0;
                    for (const Field field : fields)
                        for (std::size_t a = 0; a < field.components<Dim>(); ++a, ++c)
                            sum.numbers[c] += weight * (bonds.numbers[n * stride + c] +
                                                        (field.quantity() == Quantity::position
                                                             ? way[static_cast<int>(a)]
                                                             : 0.0));
                }
            }
        made.count.push_back(static_cast<std::uint32_t>(row.size()));
        for (const Sum& sum : row) {
            made.partners.push_back(sum.partner);
            for (const double number : sum.numbers) made.numbers.push_back(number / sum.weight);
        }
    }
    bonds = std::move(made);
}

template <int Dim>
void Memory<Dim>::pairs(Field field, std::vector<std::array<std::uint32_t, 2>>& pairs) {
    begin(field, Holder::bond);
    if (Parts& parts = Parts::here(); !reading() && !parts.alone()) {
        const auto of_all = parts.gather(std::span<const std::array<std::uint32_t, 2>>(pairs));
        pairs.clear();
        for (const auto& some : of_all) pairs.insert(pairs.end(), some.begin(), some.end());
        ascending_once(pairs);
    }
    archive_(pairs);
    if (!reading()) return;
    expect(field, std::ranges::all_of(
                      pairs, [&](const auto& pair) { return pair[0] < was_ && pair[1] < was_; }));
    if (!carries()) return;
    const auto heirs = this->heirs();
    std::vector<std::array<std::uint32_t, 2>> made;
    for (const auto& [a, b] : pairs)
        for (const std::uint32_t k : heirs[a])
            for (const std::uint32_t j : heirs[b])
                if (k != j) made.push_back({std::min(k, j), std::max(k, j)});
    ascending_once(made);
    pairs = std::move(made);
}

SPAM_COMPILED(template struct Change);
SPAM_COMPILED(template class Memory);

}  // namespace spam
