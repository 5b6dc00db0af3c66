// SPDX-License-Identifier: GPL-3.0-or-later
// Room rhs: models of particles, one class for each number of dimensions.
#include "bindings.hpp"
#include "held_model.hpp"
#include <spam/core/error.hpp>
#include <spam/diagnostics/shape.hpp>
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

struct MakeSmooth {
    Common common;
    Matter matter;
    Scheme scheme;
    double density;

    template <int Dim>
    Held<Dim> make(Particles<Dim> particles) const {
        const auto pending = std::make_shared<Pending>();
        const Box<Dim> box = box_of<Dim>(common.box);
        if (const auto* fluid = std::get_if<Fluid>(&matter)) {
            auto model =
                std::make_shared<FluidModel<Dim>>(std::move(particles), *fluid, scheme, box);
            for (const auto& one : common.externals) model->add(external_of<Dim>(one, pending));
            auto start = [&model = *model](const Points<Dim>& velocity, double T) {
                return model.state(model.particles().reference_position, velocity, T);
            };
            return std::make_shared<HeldModel<Dim>>(model, start, pending);
        }
        const auto& solid = std::get<Solid>(matter);
        auto model = std::make_shared<SmoothParticleModel<Dim>>(
            std::move(particles), material_of<Dim>(solid, pending), scheme, box);
        return held_solid<Dim>(std::move(model), common, pending, checked_density(density),
                               modulus_of(solid));
    }
};

/// Solids that remember, springs, and molecules.
struct MakeRemembering {
    Common common;
    std::string kind;
    ElasticSolid elastic;
    HarmonicSpring spring;
    double density, range, penalty;
    Kernel kernel;
    double viscosity, closest_approach;

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
                std::move(particles), StVenantKirchhoff::like(elastic),
                TotalLagrangianScheme{density, range, penalty, kernel}, box);
        else if constexpr (Dim > 1)
            model = std::make_shared<MaterialVectorModel<Dim>>(
                std::move(particles), PolynomialSolid::like(elastic),
                MaterialVectorScheme{density, range, penalty}, box);
        else
            throw InputError(
                "x: material vectors have two or three dimensions; give (n, 2) or (n, 3)");
        if (!std::isfinite(viscosity) || viscosity < 0.0)
            throw InputError(fmt::format(
                "viscosity: {} is not allowed; use 0 for none, or a positive number", viscosity));
        if (viscosity > 0.0)
            model->template add_term<ArtificialViscosity<Dim>>(
                typename ArtificialViscosity<Dim>::Constants{viscosity, range, density,
                                                             elastic.sound_speed(density), kernel});
        if (closest_approach != 0.0)
            model->template add_term<ReflectedPairs<Dim>>(closest_approach);
        return held_solid<Dim>(std::move(model), common, std::move(pending), density, elastic.eta);
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

template <int Dim>
void bind(py::module_& module, const char* name) {
    using Model = HeldModel<Dim>;
    py::class_<Model, std::shared_ptr<Model>>(
        module, name, "A model of N particles; made by SmoothParticles(), Springs(), ...")
        .def(
            "start",
            [](Model& self, const py::object& v, double T) { return array_of(self.start(v, T)); },
            "velocity"_a = py::none(), "temperature"_a = 0.0,
            "y at the start (size,): positions as given, `velocity` (N, D) in the order given, no stress. Of a\n"
            "fluid with a temperature its energy.")
        .def(
            "rates", &Model::rates, "t"_a, "y"_a,
            "dy/dt (size,) at time t, as scipy.integrate.solve_ivp wants it; y as Simulation.y, whose particles are\n"
            "in the library's order: id[i] is the number of the i-th one among those given, and\n"
            "Simulation.by_id(field) is the way back. NaN, and `failure` says why, where a state has no physical\n"
            "meaning. Raises InputError for a wrong shape.")
        .def_property_readonly("failure", [](const Model& self) { return self.model->failure(); })
        .def_property_readonly("dimensions", [](const Model&) { return Dim; })
        .def_property_readonly(
            "size", [](const Model& self) { return self.model->layout().size(); }, "Entries of y.")
        .def("__len__", &Model::size)
        .def_property_readonly(
            "id",
            [](const Model& self) {
                const auto& id = self.model->particles().id;
                py::array_t<std::int64_t> array(static_cast<py::ssize_t>(id.size()));
                std::copy(id.begin(), id.end(), array.mutable_data());
                return array;
            },
            "Which of the particles given lies where (N,): fields of a state are in this order.")
        .def_property_readonly(
            "mass", [](const Model& self) { return array_of(self.model->particles().mass); },
            "Masses (N,) in the order of `id`.")
        .def_property_readonly(
            "reference_position",
            [](const Model& self) {
                return array_of<Dim>(self.model->particles().reference_position);
            },
            "(N, D) in the order of `id`.")
        .def_property_readonly(
            "fields",
            [](const Model& self) {
                py::dict fields;
                for (const auto& block : self.model->layout().blocks())
                    fields[py::str(block.name())] =
                        py::make_tuple(block.offset, block.size, block.components);
                return fields;
            },
            "Of y: name -> (first entry, entries, components).")
        .def(
            "density",
            [](Model& self, const py::object& y) {
                const std::vector<double> checked = self.checked(y);
                const typename Model::Use use(self);
                return array_of(self.model->density(checked));
            },
            "y"_a, "(N,); empty for a model without.")
        .def(
            "shape_error",
            [](const Model& self, const py::object& x) {
                const auto& p = self.model->particles();
                const Points<Dim> position = points_of<Dim>(x, "position");
                if (position.cols() != p.reference_position.cols())
                    throw InputError(
                        fmt::format("position: is of {} particles, and the model has {}",
                                    position.cols(), p.size()));
                return shape_error<Dim>(p.reference_position, position, p.spacing);
            },
            "position"_a,
            "Distance from the best-fitting rigid motion, root mean square in spacings.")
        .def(
            "closest_pair",
            [](const Model& self, const py::object& x) {
                const Points<Dim> position = points_of<Dim>(x, "position");
                return closest_pair<Dim>(position, self.model->particles().spacing,
                                         self.model->box());
            },
            "position"_a, "Distance of the closest two particles.")
        .def("__repr__", [](const Model& self) {
            return fmt::format("<{} particles in {} dimensions: {}>", self.size(), Dim,
                               self.model->describe());
        });
}

}  // namespace

void bind_models(py::module_& module) {
    bind<1>(module, "Model1");
    bind<2>(module, "Model2");
    bind<3>(module, "Model3");
    module.def(
        "smooth_particles",
        [](py::object x, const Matter& matter, const SchemeChoice& scheme, py::object mass,
           double density, double spacing, std::vector<double> box,
           std::vector<ExternalChoice> externals) {
            return by_dimensions(
                MakeSmooth{{x, mass, spacing, std::move(box), std::move(externals)},
                           matter,
                           scheme.of(spacing),
                           density});
        },
        "x"_a, "material"_a, "scheme"_a, "mass"_a, "density"_a, "spacing"_a, "box"_a,
        "externals"_a);
    module.def(
        "remembering",
        [](py::object x, const std::string& kind, const Solid& solid, double kappa,
           double rest_length, py::object mass, double density, double range, double penalty,
           const std::string& kernel, double viscosity, double closest_approach, double spacing,
           std::vector<double> box, std::vector<ExternalChoice> externals) {
            return by_dimensions(
                MakeRemembering{{x, mass, spacing, std::move(box), std::move(externals)},
                                kind,
                                elastic_of(solid, kind.c_str()),
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
        "externals"_a);
}

}  // namespace spam::python
