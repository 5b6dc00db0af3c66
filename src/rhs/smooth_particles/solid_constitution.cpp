// SPDX-License-Identifier: GPL-3.0-or-later
#include "constitution.hpp"
#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/core/parallel.hpp>

#include <algorithm>

namespace spam {
namespace {

/// Stress is part of y. Its rates are found for the velocity gradients of a block as soon as they are known.
template <int Dim>
class SolidConstitution final : public Constitution<Dim> {
  public:
    using typename Constitution<Dim>::Now;

    SolidConstitution(const Particles<Dim>& particles, std::vector<Material<Dim>> materials)
        : Constitution<Dim>(particles),
          materials_(std::move(materials)) {
        if (materials_.empty()) throw InputError("material: none is given; give one at least");
        if (std::ranges::any_of(materials_,
                                [](const auto& material) { return material.returns(); }))
            returned_.resize(symmetric_size(Dim) * particles.size());
    }

    std::size_t materials() const override { return materials_.size(); }
    void take(const Scheme& scheme) override {
        if (scheme.transport == Transport::shifting)
            throw InputError(
                "transport: shifting would leave the stress of a solid, which remembers where its "
                "particle has been, at wrong places; use --transport plain, average or monaghan");
        if (scheme.work == Work::own)
            throw InputError(
                "work: own is for fluids, whose pressure falls with their energy; the stress of a "
                "solid is its own and does work whatever its energy; use --work mean");
    }
    Matter matter(const Scheme&) const override { return Matter::solid; }
    bool central(const Scheme&) const override { return false; }
    bool smooth() const override { return returned_.empty(); }

    std::vector<Field> fields() const override {
        std::vector<Field> fields{Field::stress, Field::energy};
        for (const auto& material : materials_)
            for (const Field field : material.history())
                if (std::ranges::find(fields, field) == fields.end()) fields.push_back(field);
        return fields;
    }
    std::string describe() const override {
        std::string words = "smooth particles, ";
        for (const auto& material : materials_)
            words += (&material == materials_.data() ? "" : " | ") + material.describe();
        return words;
    }
    const double* stress(const ConstState<Dim>& state) const override {
        return state.stress().data();
    }
    const double* returned_stress(const Now& now) override {
        if (returned_.empty()) return stress(now.state);
        parallel_blocks(this->particles_.size(), [&](std::size_t begin, std::size_t number) {
            for_each_material(this->particles_.material, begin, number,
                              [&](std::size_t m, std::size_t first, std::size_t count) {
                                  materials_[m].return_stress(now.t, first, count, now.state,
                                                              returned_.data());
                              });
        });
        return returned_.data();
    }

    void close_forces(const Now& now, SweepOutput<Dim>& out) override {
        now_.emplace(now);
        if (materials_.size() > 1)  // what one finds the rates of, another may know nothing of
            for (const Field field : fields())
                if (field != Field::stress && field != Field::energy)
                    now.rate.field(field).setZero();
        out.context = this;
        out.close = [](const void* context, const SweptBlock& block) {
            static_cast<const SolidConstitution*>(context)->close(block);
        };
    }

    /// The fastest of all, so that viscosity is not underestimated; none where one has none.
    std::optional<double> sound_speed(double density) const override {
        std::optional<double> fastest;
        for (const auto& material : materials_) {
            const auto c = material.sound_speed(density);
            if (!c) return {};
            fastest = std::max(fastest.value_or(0.0), *c);
        }
        return fastest;
    }

    double stress_forces(const ConstState<Dim>& state, std::span<const double> rho) const override {
        return exact_sum(rho.size(), [&](std::size_t i) {
            return this->particles_.mass[i] / rho[i] *
                   state.stress().col(static_cast<Eigen::Index>(i)).norm();
        });
    }

    bool settle(double t, const State<Dim>& state) override {
        const std::size_t n = this->particles_.size();
        return parallel_count((n + settled_at_once - 1) / settled_at_once,
                              [&](std::size_t block) {
                                  const std::size_t begin = block * settled_at_once;
                                  std::size_t changed = 0;
                                  for_each_material(
                                      this->particles_.material, begin,
                                      std::min(settled_at_once, n - begin),
                                      [&](std::size_t m, std::size_t first, std::size_t count) {
                                          if (materials_[m].settle(t, first, count, state))
                                              ++changed;
                                      });
                                  return changed;
                              },
                              settled_at_once) > 0;
    }

  private:
    static constexpr std::size_t settled_at_once = 512;

    void close(const SweptBlock& block) const {
        const Mat<Dim>* const grad_v = block.sums<Mat<Dim>>(0);
        const auto& material = this->particles_.material;
        const auto run = [&](std::size_t m, std::size_t first, std::size_t count) {
            materials_[m].stress_rates({block.particle + first, count}, {grad_v + first, count},
                                       returned_.empty() ? stress(now_->state) : returned_.data(),
                                       now_->state, now_->rate);
        };
        if (material.empty()) return run(0, 0, block.count);
        // Runs of equal material among the particles of the block, which are neighbours.
        for (std::size_t first = 0; first < block.count;) {
            const auto m = material[block.particle[first]];
            std::size_t next = first + 1;
            while (next < block.count && material[block.particle[next]] == m) ++next;
            run(static_cast<std::size_t>(m), first, next - first);
            first = next;
        }
    }

    std::vector<Material<Dim>> materials_;
    std::optional<Now> now_;        ///< of the right-hand side at work
    std::vector<double> returned_;  ///< its stresses, where one of the materials returns them
};

}  // namespace

template <int Dim>
std::unique_ptr<Constitution<Dim>> solid_constitution(const Particles<Dim>& particles,
                                                      std::vector<Material<Dim>> solids) {
    return std::make_unique<SolidConstitution<Dim>>(particles, std::move(solids));
}

#define SPAM_INSTANTIATE(D)                                                           \
    template std::unique_ptr<Constitution<D>> solid_constitution(const Particles<D>&, \
                                                                 std::vector<Material<D>>);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
