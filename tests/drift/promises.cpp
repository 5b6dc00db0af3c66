// SPDX-License-Identifier: GPL-3.0-or-later
// Promises are measured against what rounding can do: kept where particles hardly move among large
// forces that cancel, and not kept by a law that loses a billionth of these forces.
#include <spam/analysis/periodic_solid.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/material/harmonic_spring.hpp>
#include <spam/material/lucy_gas.hpp>
#include <spam/problem/run_in_memory.hpp>
#include <spam/rhs/density_potentials.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace spam;

namespace {

enum class Loss { none, momentum, energy };

/// A law that loses a part of what neighbours do to each other, as force or as power.
class LossyModel final : public Model<2> {
  public:
    LossyModel(std::shared_ptr<Model<2>> model, Loss loss, double part)
        : Model<2>(model->particles(), model->box(), fields_of(*model)),
          model_(std::move(model)),
          loss_(loss),
          part_(part) {}

    void rates(double t, std::span<const double> y, std::span<double> y_dot) override {
        model_->rates(t, y, y_dot);
        const double n = static_cast<double>(particles().size());
        const double force = part_ * model_->neighbour_forces(y) / n;
        const State<2> rate(layout(), y_dot);
        const auto v = ConstState<2>(layout(), y).velocity();
        if (loss_ == Loss::momentum) rate.velocity().row(1).array() -= force;
        if (loss_ == Loss::energy) rate.energy() -= force * v.colwise().norm();
    }
    double internal_energy(std::span<const double> y) const override {
        return model_->internal_energy(y);
    }
    std::vector<double> density(std::span<const double> y) const override {
        return model_->density(y);
    }
    double neighbour_forces(std::span<const double> y) const override {
        return model_->neighbour_forces(y);
    }
    bool smooth() const override { return model_->smooth(); }
    Promises promises() const override { return model_->promises(); }
    std::string describe() const override { return model_->describe() + ", lossy"; }
    std::size_t pairs() const override { return model_->pairs(); }
    double reach() const override { return model_->reach(); }

  private:
    static std::vector<Field> fields_of(const Model<2>& model) {
        std::vector<Field> fields;
        for (const auto& block : model.layout().blocks()) fields.push_back(block.field);
        return fields;
    }
    std::shared_ptr<Model<2>> model_;
    Loss loss_;
    double part_;
};

struct Begun {
    std::shared_ptr<Model<2>> model;
    std::vector<double> y0;
};

constexpr int cells = 10;
const Box<2> box({10.0, 10.0});

Particles<2> lattice() {
    return make_particles<2>(square_lattice<2>({cells, cells}), 1.0, 1.0, box);
}

/// Waves of this speed in all directions, without momentum.
Point<2> wave(const Point<2>& x, double speed) {
    const double k = 2.0 * 3.14159265358979323846 / cells;
    return {speed * std::sin(k * x.x()), speed * std::sin(2.0 * k * x.y())};
}

Begun stretched_solid(double speed) {
    auto solid = triangular_solid(cells, cells, ElasticSolid::triangular_lattice(), Scheme{},
                                  std::sqrt(4.0 / 3.0), 0.02);
    const State<2> state(solid.model->layout(), solid.y0);
    state.velocity()(1, 37) = speed;
    return {std::move(solid.model), std::move(solid.y0)};
}

template <class Law>
Begun fluid(const Law& law, double speed) {
    auto model = std::make_unique<FluidModel<2>>(lattice(), Fluid{law},
                                                 Scheme{.density = Density::summed}, box);
    const Points<2> x = model->particles().reference_position;
    Points<2> v = x;
    for (Eigen::Index i = 0; i < x.cols(); ++i) v.col(i) = wave(x.col(i), speed);
    auto y0 = model->state(x, v);
    return {std::move(model), std::move(y0)};
}

Begun molecules(std::shared_ptr<Model<2>> model, double speed) {
    auto y0 =
        initial_state<2>(*model, 1.0, 1.0, [speed](const Point<2>& x) { return wave(x, speed); });
    return {std::move(model), std::move(y0)};
}

Begun begin(const std::string& what, double speed) {
    if (what == "solid") return stretched_solid(speed);
    if (what == "Lucy gas") return fluid(LucyGas{}, speed);
    if (what == "fluid of embedded atoms") return fluid(EmbeddedAtom{}, speed);
    if (what == "pair potential")
        return molecules(std::make_unique<PairPotentialModel<2>>(lattice(), 3.0, box), speed);
    if (what == "springs")  // shorter than the lattice
        return molecules(std::make_unique<BondedModel<2>>(lattice(), HarmonicSpring{1.0, 0.9}, box),
                         speed);
    return molecules(std::make_unique<DensityPotentialModel<2>>(
                         lattice(), DensityPotentials{.state = EmbeddedAtom{}, .range = 3.0}, box),
                     speed);
}

const std::vector<std::string> all{"solid",          "Lucy gas", "fluid of embedded atoms",
                                   "pair potential", "springs",  "embedded atoms"};

Drift drift_of(const std::string& what, double speed, Loss loss, const std::string& invariant) {
    Begun begun = begin(what, speed);
    LossyModel model(std::move(begun.model), loss, 1e-9);
    Plan<2> plan;
    plan.t_end = 20.0;
    plan.output_every = plan.snapshot_every = 0.5;
    const auto run =
        run_in_memory<2>({kept_elsewhere<2>(model), std::move(begun.y0), std::move(plan)},
                         {.method = "rk4", .dt = 0.1});
    BOOST_REQUIRE(run.complete);
    for (const Drift& drift : run.drifts)
        if (drift.name == invariant) {
            BOOST_TEST_MESSAGE(what << ", speed " << speed << ": " << invariant << " "
                                    << drift.change << " of " << drift.scale << ", limit "
                                    << drift.limit);
            return drift;
        }
    throw std::out_of_range(invariant);
}

}  // namespace

BOOST_AUTO_TEST_CASE(kept_where_particles_hardly_move) {
    for (const auto& what : all)
        for (const double speed : {1e-10, 1e-2}) {
            BOOST_TEST(drift_of(what, speed, Loss::none, "momentum").kept(), what);
            BOOST_TEST(drift_of(what, speed, Loss::none, "energy").kept(), what);
        }
}

BOOST_AUTO_TEST_CASE(a_billionth_of_the_forces_is_missed) {
    for (const auto& what : all)
        for (const double speed : {1e-10, 1e-2})
            BOOST_TEST(!drift_of(what, speed, Loss::momentum, "momentum").kept(), what);
}

BOOST_AUTO_TEST_CASE(a_billionth_of_their_work_is_missed) {
    BOOST_TEST(!drift_of("solid", 1e-10, Loss::energy, "energy").kept());
}
