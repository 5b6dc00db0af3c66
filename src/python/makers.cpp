// SPDX-License-Identifier: GPL-3.0-or-later
// Room rhs: what makes models of particles of arrays and choices.
#include "bindings.hpp"
#include "held_model.hpp"
#include <spam/core/error.hpp>
#include <spam/material/polynomial_solid.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/rhs/artificial_viscosity.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/reflected_pairs.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

namespace spam::python {

using namespace py::literals;

namespace {

template <int Dim>
Box<Dim> box_of(const std::vector<double>& lengths) {
    if (lengths.empty()) return {};
    std::array<double, Dim> sides{};
    if (lengths.size() != Dim)
        throw InputError(fmt::format("box: has {} lengths, and the particles {} dimensions",
                                     lengths.size(), Dim));
    for (std::size_t a = 0; a < Dim; ++a) {
        if (!std::isfinite(lengths[a]) || lengths[a] < 0.0)
            throw InputError(
                fmt::format("box: {} is no length; use a period, or 0 for open space", lengths[a]));
        sides[a] = lengths[a];
    }
    return Box<Dim>(sides);
}

/// What all models are made from.
struct Common {
    py::object x, mass;
    double spacing;
    std::vector<double> box;
    std::vector<ExternalChoice> externals;
    std::vector<std::int32_t>
        which;  ///< of several materials, by particle as given; empty: all the first
};

template <int Dim>
Particles<Dim> particles_of(const Common& common, const Box<Dim>& box) {
    const Points<Dim> x = points_of<Dim>(common.x, "x");
    if (!std::isfinite(common.spacing) || common.spacing <= 0.0)
        throw InputError(
            fmt::format("spacing: {} is not allowed; use a positive number", common.spacing));
    const Doubles mass = doubles_of(common.mass, "mass");
    if (mass.ndim() != 0) expect_shape(mass, {x.cols()}, "mass");
    for (py::ssize_t i = 0; i < mass.size(); ++i)
        if (!(mass.data()[i] > 0.0))
            throw InputError(
                fmt::format("mass: {} is not allowed; use positive numbers", mass.data()[i]));
    auto particles = make_particles<Dim>(x, mass.data()[0], common.spacing, box);
    if (mass.ndim() != 0)
        for (std::size_t i = 0; i < particles.size(); ++i)
            particles.mass[i] = mass.data()[particles.id[i]];
    if (!common.which.empty() && common.which.size() != particles.size())
        throw InputError(fmt::format("which: has {} numbers, and there are {} particles",
                                     common.which.size(), particles.size()));
    for (std::size_t i = 0; i < particles.size() && !common.which.empty(); ++i)
        particles.material.push_back(common.which[static_cast<std::size_t>(particles.id[i])]);
    return particles;
}

template <int Dim>
using Held = std::shared_ptr<HeldModel<Dim>>;

/// Adds externals, and starts a solid free of stress.
template <int Dim>
Held<Dim> held_solid(std::shared_ptr<ParticleModel<Dim>> model, const Common& common,
                     SharedPending pending, double density, double modulus) {
    for (const auto& one : common.externals) model->add(external_of<Dim>(one, pending));
    auto start = [&model = *model, density, modulus](const Points<Dim>& velocity, double) {
        Eigen::Index i = 0;  // asked for particle by particle, in order
        return initial_state<Dim>(model, density, modulus,
                                  [&](const Point<Dim>&) { return Point<Dim>(velocity.col(i++)); });
    };
    return std::make_shared<HeldModel<Dim>>(std::move(model), std::move(start), std::move(pending));
}

double checked_density(double density) {
    if (!std::isfinite(density) || density <= 0.0)
        throw InputError(fmt::format("density: {} is not allowed; use a positive number", density));
    return density;
}

using Matter = std::variant<Solid, Fluid>;

/// All of one kind, or throws InputError.
template <class Kind>
std::vector<Kind> all_of(const std::vector<Matter>& matter) {
    std::vector<Kind> all;
    for (const Matter& one : matter) {
        const auto* const of_kind = std::get_if<Kind>(&one);
        if (of_kind == nullptr)
            throw InputError(
                "material: solids and fluids are not in one list; give a list of either");
        all.push_back(*of_kind);
    }
    return all;
}

struct MakeSmooth {
    Common common;
    std::vector<Matter> matter;
    Scheme scheme;
    double density;

    template <int Dim>
    Held<Dim> make(Particles<Dim> particles) const {
        const auto pending = std::make_shared<Pending>();
        auto model =
            std::make_shared<ParticleModel<Dim>>(std::move(particles), box_of<Dim>(common.box));
        if (matter.empty()) throw InputError("material: none is given; give one at least");
        if (std::holds_alternative<Fluid>(matter.front())) {
            auto& law =
                model->template add_term<SmoothParticles<Dim>>(all_of<Fluid>(matter), scheme);
            for (const auto& one : common.externals) model->add(external_of<Dim>(one, pending));
            auto start = [&model = *model, &law](const Points<Dim>& velocity, double T) {
                return law.start(model.particles().reference_position, velocity, T);
            };
            return std::make_shared<HeldModel<Dim>>(model, start, pending);
        }
        std::vector<Material<Dim>> solids;
        double modulus = 0.0;
        for (const Solid& solid : all_of<Solid>(matter)) {
            solids.push_back(material_of<Dim>(solid, pending));
            modulus = std::max(modulus, modulus_of(solid));
        }
        model->template add_term<SmoothParticles<Dim>>(std::move(solids), scheme);
        return held_solid<Dim>(std::move(model), common, pending, checked_density(density),
                               modulus);
    }
};

/// Solids that remember, springs, and molecules.
struct MakeRemembering {
    Common common;
    std::string kind;
    std::vector<ElasticSolid> elastic;
    HarmonicSpring spring;
    double density, range, penalty;
    Kernel kernel;
    double viscosity, closest_approach;

    template <class Law, int Dim>
    HyperelasticMaterial<Dim> material() const {
        if (elastic.size() == 1) return Law::like(elastic.front());
        std::vector<HyperelasticMaterial<Dim>> laws;
        for (const ElasticSolid& one : elastic) laws.push_back(Law::like(one));
        return laws;
    }
    /// The largest of a quantity of the materials.
    template <class Quantity>
    double most(const Quantity& of) const {
        double most = 0.0;
        for (const ElasticSolid& one : elastic) most = std::max(most, of(one));
        return most;
    }

    template <int Dim>
    Held<Dim> make(Particles<Dim> particles) const {
        auto pending = std::make_shared<Pending>();
        const Box<Dim> box = box_of<Dim>(common.box);
        std::shared_ptr<ParticleModel<Dim>> model;
        if (kind == "springs")
            model = std::make_shared<BondedModel<Dim>>(std::move(particles), spring, box);
        else if (kind == "molecules") {
            model = std::make_shared<ParticleModel<Dim>>(std::move(particles), box);
            model->template add_term<Cohesion<Dim>>(
                CohesivePotential{spring.kappa, spring.rest_length});
        } else if (kind == "total_lagrangian")
            model = std::make_shared<TotalLagrangianModel<Dim>>(
                std::move(particles), material<StVenantKirchhoff, Dim>(),
                TotalLagrangianScheme{density, range, penalty, kernel}, box);
        else if constexpr (Dim > 1)
            model = std::make_shared<MaterialVectorModel<Dim>>(
                std::move(particles), material<PolynomialSolid, Dim>(),
                MaterialVectorScheme{density, range, penalty}, box);
        else
            throw InputError(
                "x: material vectors have two or three dimensions; give (n, 2) or (n, 3)");
        if (!std::isfinite(viscosity) || viscosity < 0.0)
            throw InputError(fmt::format(
                "viscosity: {} is not allowed; use 0 for none, or a positive number", viscosity));
        if (viscosity > 0.0)
            model->template add_term<ArtificialViscosity<Dim>>(
                typename ArtificialViscosity<Dim>::Constants{
                    viscosity, range, density,
                    most([&](const ElasticSolid& e) { return e.sound_speed(density); }), kernel});
        if (closest_approach != 0.0)
            model->template add_term<ReflectedPairs<Dim>>(closest_approach);
        return held_solid<Dim>(std::move(model), common, std::move(pending), density,
                               most([](const ElasticSolid& e) { return e.eta; }));
    }
};

/// What can make itself of other particles; it needs no arrays of Python then.
template <int Dim, class Make>
Held<Dim> held_again(const Make& make, Particles<Dim> particles) {
    auto held = make.template make<Dim>(std::move(particles));
    held->again = [make](Particles<Dim> others) {
        return held_again<Dim>(make, std::move(others));
    };
    return held;
}

template <int Dim, class Make>
py::object held_of(Make make) {
    auto particles = particles_of<Dim>(make.common, box_of<Dim>(make.common.box));
    make.common.x = make.common.mass = py::object();
    return py::cast(held_again<Dim>(make, std::move(particles)));
}

/// By the shape of the positions.
template <class Make>
py::object by_dimensions(const Make& make) {
    switch (dimensions_of(doubles_of(make.common.x, "x"), "x")) {
        case 1:
            return held_of<1>(make);
        case 2:
            return held_of<2>(make);
        default:
            return held_of<3>(make);
    }
}

}  // namespace

void bind_makers(py::module_& module) {
    module.def(
        "smooth_particles",
        [](py::object x, std::vector<Matter> matter, const SchemeChoice& scheme, py::object mass,
           double density, double spacing, std::vector<double> box,
           std::vector<ExternalChoice> externals, std::vector<std::int32_t> which) {
            return by_dimensions(MakeSmooth{
                {x, mass, spacing, std::move(box), std::move(externals), std::move(which)},
                std::move(matter),
                scheme.of(spacing),
                density});
        },
        "x"_a, "material"_a, "scheme"_a, "mass"_a, "density"_a, "spacing"_a, "box"_a, "externals"_a,
        "which"_a);
    module.def(
        "remembering",
        [](py::object x, const std::string& kind, const std::vector<Solid>& solids, double kappa,
           double rest_length, py::object mass, double density, double range, double penalty,
           const std::string& kernel, double viscosity, double closest_approach, double spacing,
           std::vector<double> box, std::vector<ExternalChoice> externals,
           std::vector<std::int32_t> which) {
            std::vector<ElasticSolid> elastic;
            for (const Solid& one : solids) elastic.push_back(elastic_of(one, kind.c_str()));
            return by_dimensions(MakeRemembering{
                {x, mass, spacing, std::move(box), std::move(externals), std::move(which)},
                kind,
                std::move(elastic),
                {kappa, rest_length},
                checked_density(density),
                range,
                penalty,
                value_of<Kernel>(kernel, all_kernels(), "kernel"),
                viscosity,
                closest_approach});
        },
        "x"_a, "kind"_a, "material"_a, "kappa"_a, "rest_length"_a, "mass"_a, "density"_a, "range"_a,
        "penalty"_a, "kernel"_a, "viscosity"_a, "closest_approach"_a, "spacing"_a, "box"_a,
        "externals"_a, "which"_a);
}

}  // namespace spam::python
