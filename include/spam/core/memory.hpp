// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/archive.hpp>
#include <spam/core/population.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace spam {

/// Which old particles each new one is made of, as what is remembered needs it.
template <int Dim>
struct Change {
    using Part = typename Population<Dim>::Part;

    /// By new particle; offsets are all the way from the place of the old particle to that of the new one.
    std::vector<std::vector<Part>> parts;
    std::vector<Mat<Dim>> back;        ///< F^-1 by old particle; 1 where the model knows none
    std::span<const std::int64_t> id;  ///< of the old ones, for messages

    /// Whether new particle k is an old one as it was.
    bool same(std::size_t k) const { return parts[k].size() == 1 && parts[k].front().of == 1.0; }
    /// Those of the new particles [first, first + count) alone, made of the old ones [was, was + number). Throws
    /// InputError where one of them has parts that are not among these.
    Change among(std::size_t first, std::size_t count, std::size_t was, std::size_t number) const;

    /// The values of a field of new particles, from those of the old ones; `components` of each.
    void carry(Field field, const double* old, double* made, std::size_t components) const;
};

/// Numbers of bonds, one particle's after those of another: partners, and the fields of each bond side by side.
struct BondNumbers {
    std::vector<std::uint32_t> count;  ///< by particle
    std::vector<std::uint32_t> partners;
    std::vector<double> numbers;
};

/// What a model must remember beyond y, field by field: the one description by which checkpoints are written
/// and read, and by which what is remembered passes to other particles (problem/remake.hpp). What takes part has a
/// member `remember(Memory<Dim>&)` that names what it keeps, in an order of its own:
///     memory.particles(heat_kind, heat);      memory.run(breaks_kind, breaks);
/// Names are kept with the numbers, so that what another law remembered is refused. Where particles have changed,
/// fields of Role::derived are read and left alone: their owner makes them anew.
///
/// In one of several parts of a run (core/parts.hpp) what is written is that of the whole run, by number, and what is
/// read is that of its own particles.
template <int Dim>
class Memory {
  public:
    /// Writes into the archive or reads from it, as it does.
    explicit Memory(Archive& archive) : archive_(archive) {}
    /// Reads what the old particles remembered, for the new ones. Both must outlive it.
    Memory(Archive& archive, const Change<Dim>& change) : archive_(archive), whole_(&change) {}

    bool reading() const { return archive_.reading(); }
    /// Whether for other particles than those that wrote.
    bool carries() const { return whole_ != nullptr; }
    /// What has been named so far, and what holds it.
    const std::vector<std::pair<Field, Holder>>& fields() const { return fields_; }

    /// What tells these laws from others. Throws InputError where others remembered.
    void laws(std::string names);
    /// From here on particles are numbered from `first` on, and there are `count` of them: those of a law.
    void among(std::size_t first, std::size_t count);
    /// How many there are in all parts of a run.
    std::size_t among_all() const { return was_; }
    /// Of the whole system: anything that an Archive takes.
    template <class... Values>
    void run(Field field, Values&... values) {
        begin(field, Holder::run);
        archive_(values...);
    }
    /// components x N numbers. Throws InputError where as many were not written.
    void particles(Field field, std::vector<double>& values);
    /// A label of each particle.
    void particles(Field field, std::vector<std::int32_t>& labels);
    /// Bonds with these fields, the vectors (of Quantity::position) from a particle to its partner in the material: in
    /// terms of F_a of particle a they become X + F_a^-1 (way of the partner - way of the particle), and misfits stay.
    /// A new bond has the mean of the old ones between the parts of both, by mass; none is left inside one particle.
    /// Partners are numbers in the whole run.
    void bonds(std::span<const Field> fields, BondNumbers& bonds);
    /// Pairs of particles k < j, ascending: those of the parts. Numbers are those in the whole run, and what is read
    /// are all pairs.
    void pairs(Field field, std::vector<std::array<std::uint32_t, 2>>& pairs);

  private:
    void begin(Field field, Holder holder);
    void expect(Field field, bool fits) const;
    /// The new particles that each old one goes into.
    std::vector<std::vector<std::uint32_t>> heirs() const;

    Archive& archive_;
    const Change<Dim>* whole_ = nullptr;
    Change<Dim> change_{};  ///< of the particles of a law
    std::size_t count_ = 0, was_ = 0;
    std::vector<std::uint32_t> own_{};  ///< numbers of the particles of this part
    std::vector<std::pair<Field, Holder>> fields_;
};

SPAM_COMPILED(extern template struct Change);
SPAM_COMPILED(extern template class Memory);

}  // namespace spam
