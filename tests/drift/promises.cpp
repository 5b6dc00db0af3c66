// SPDX-License-Identifier: GPL-3.0-or-later
// Promises are measured against what rounding can do: kept where particles hardly move among large
// forces that cancel, and not kept by a law that loses a billionth of these forces.
#include "support/plane_and_space.hpp"
#include <spam/analysis/periodic_solid.hpp>
#include <spam/core/parallel.hpp>
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
using namespace spam::test;

namespace {

enum class Loss { none, momentum, energy };

/// A law that loses a part of what neighbours do to each other, as force or as power.
template <int Dim>
class LossyModel final : public Model<Dim> {
  public:
    LossyModel(std::shared_ptr<Model<Dim>> model, Loss loss, double part)
        : Model<Dim>(model->particles(), model->box(), fields_of(*model)),
          model_(std::move(model)),
          loss_(loss),
          part_(part) {}

    void rates(double t, std::span<const double> y, std::span<double> y_dot) override {
        model_->rates(t, y, y_dot);
        const double n = static_cast<double>(this->particles().size());
        const double force = part_ * model_->neighbour_forces(y) / n;
        const State<Dim> rate(this->layout(), y_dot);
        const auto v = ConstState<Dim>(this->layout(), y).velocity();
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
    static std::vector<Field> fields_of(const Model<Dim>& model) {
        std::vector<Field> fields;
        for (const auto& block : model.layout().blocks()) fields.push_back(block.field);
        return fields;
    }
    std::shared_ptr<Model<Dim>> model_;
    Loss loss_;
    double part_;
};

template <int Dim>
struct Begun {
    std::shared_ptr<Model<Dim>> model;
    std::vector<double> y0;
};

template <int Dim>
constexpr int cells = Dim == 2 ? 10 : 5;
template <int Dim, class T>
std::array<T, Dim> along_each(T length) {
    std::array<T, Dim> lengths;
    lengths.fill(length);
    return lengths;
}
template <int Dim>
const Box<Dim> box(along_each<Dim, double>(cells<Dim>));

template <int Dim>
Particles<Dim> lattice() {
    return make_particles<Dim>(square_lattice<Dim>(along_each<Dim>(cells<Dim>)), 1.0, 1.0,
                               box<Dim>);
}

/// Waves of this speed in all directions, without momentum.
template <int Dim>
Point<Dim> wave(const Point<Dim>& x, double speed) {
    const double k = 2.0 * 3.14159265358979323846 / cells<Dim>;
    Point<Dim> v;
    for (int a = 0; a < Dim; ++a) v[a] = speed * std::sin((a + 1) * k * x[a]);
    return v;
}

template <int Dim>
Begun<Dim> stretched_solid(double speed) {
    SolidLattice<Dim> solid;
    const auto springs = ElasticSolid::triangular_lattice();
    if constexpr (Dim == 2)
        solid = triangular_solid(10, 10, springs, Scheme{}, std::sqrt(4.0 / 3.0), 0.02);
    else
        solid = cubic_solid(CubicLattice::fcc, {3, 3, 3}, springs, Scheme{.range = 2.0}, 0.02);
    const State<Dim> state(solid.model->layout(), solid.y0);
    state.velocity()(1, 37) = speed;
    return {std::move(solid.model), std::move(solid.y0)};
}

template <int Dim, class Law>
Begun<Dim> fluid(const Law& law, double speed) {
    auto model = std::make_unique<FluidModel<Dim>>(lattice<Dim>(), Fluid{law},
                                                   Scheme{.density = Density::summed}, box<Dim>);
    const Points<Dim> x = model->particles().reference_position;
    Points<Dim> v = x;
    for (Eigen::Index i = 0; i < x.cols(); ++i) v.col(i) = wave<Dim>(x.col(i), speed);
    auto y0 = model->state(x, v);
    return {std::move(model), std::move(y0)};
}

template <int Dim>
Begun<Dim> molecules(std::shared_ptr<Model<Dim>> model, double speed) {
    auto y0 = initial_state<Dim>(*model, 1.0, 1.0,
                                 [speed](const Point<Dim>& x) { return wave<Dim>(x, speed); });
    return {std::move(model), std::move(y0)};
}

template <int Dim>
Begun<Dim> begin(const std::string& what, double speed) {
    if (what == "solid") return stretched_solid<Dim>(speed);
    if (what == "Lucy gas") return fluid<Dim>(LucyGas{}, speed);
    if (what == "fluid of embedded atoms") return fluid<Dim>(EmbeddedAtom{}, speed);
    if (what == "pair potential")
        return molecules<Dim>(
            std::make_unique<PairPotentialModel<Dim>>(lattice<Dim>(), 3.0, box<Dim>), speed);
    if (what == "springs")  // shorter than the lattice
        return molecules<Dim>(
            std::make_unique<BondedModel<Dim>>(lattice<Dim>(), HarmonicSpring{1.0, 0.9}, box<Dim>),
            speed);
    return molecules<Dim>(
        std::make_unique<DensityPotentialModel<Dim>>(
            lattice<Dim>(), DensityPotentials{.state = EmbeddedAtom{}, .range = 3.0}, box<Dim>),
        speed);
}

const std::vector<std::string> all{"solid",          "Lucy gas", "fluid of embedded atoms",
                                   "pair potential", "springs",  "embedded atoms"};

template <int Dim>
Drift drift_of(const std::string& what, double speed, Loss loss, const std::string& invariant) {
    set_threads(1);
    Begun<Dim> begun = begin<Dim>(what, speed);
    LossyModel<Dim> model(std::move(begun.model), loss, 1e-9);
    Plan<Dim> plan;
    plan.t_end = 20.0;
    plan.output_every = plan.snapshot_every = 0.5;
    const auto run =
        run_in_memory<Dim>({kept_elsewhere<Dim>(model), std::move(begun.y0), std::move(plan)},
                           {.method = "rk4", .dt = 0.1});
    BOOST_REQUIRE(run.complete);
    for (const Drift& drift : run.drifts)
        if (drift.name == invariant) {
            BOOST_TEST_MESSAGE(Dim << "D " << what << ", speed " << speed << ": " << invariant
                                   << " " << drift.change << " of " << drift.scale << ", limit "
                                   << drift.limit);
            return drift;
        }
    throw std::out_of_range(invariant);
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(kept_where_particles_hardly_move, In, PlaneAndSpace) {
    constexpr int Dim = In::value;
    for (const auto& what : all)
        for (const double speed : {1e-10, 1e-2}) {
            BOOST_TEST(drift_of<Dim>(what, speed, Loss::none, "momentum").kept(), what);
            BOOST_TEST(drift_of<Dim>(what, speed, Loss::none, "energy").kept(), what);
        }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_billionth_of_the_forces_is_missed, In, PlaneAndSpace) {
    constexpr int Dim = In::value;
    for (const auto& what : all)
        for (const double speed : {1e-10, 1e-2})
            BOOST_TEST(!drift_of<Dim>(what, speed, Loss::momentum, "momentum").kept(), what);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_billionth_of_their_work_is_missed, In, PlaneAndSpace) {
    constexpr int Dim = In::value;
    BOOST_TEST(!drift_of<Dim>("solid", 1e-10, Loss::energy, "energy").kept());
}
