// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/core_potential.hpp>
#include <spam/rhs/term.hpp>

#include <memory>

namespace spam {

template <int Dim>
struct Sweeps;
template <int Dim>
struct SweepInput;
template <int Dim>
class PackedParticles;
enum class ListUse;

/// A repulsive core between all particles, phi = e_c (1 - r^2/s^2)^4 inside s (physics/core_potential.hpp):
/// it keeps neighbours apart where stresses pull them together.
template <int Dim>
class Core final : public Term<Dim> {
  public:
    /// Throws InputError for an energy or a range that is not above 0, and for a periodic box not wider than
    /// twice the range.
    Core(Model<Dim>& model, const CorePotential& core);
    ~Core() override;

    using typename Term<Dim>::Now;
    std::string rates(const Now& now) override;
    double energy(std::span<const double> y) const override;
    std::string describe() const override;
    std::size_t pairs() const override;
    double reach() const override { return core_.s; }
    std::size_t list_builds() const override;
    void remember(Archive& archive) override;

  private:
    std::unique_ptr<PackedParticles<Dim>> packed_with(ListUse use) const;
    SweepInput<Dim> input(const PackedParticles<Dim>& packed) const;

    CorePotential core_;
    std::unique_ptr<const Sweeps<Dim>> sweeps_;
    std::unique_ptr<PackedParticles<Dim>> packed_;
};

extern template class Core<1>;
extern template class Core<2>;
extern template class Core<3>;

}  // namespace spam
