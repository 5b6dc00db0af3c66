// SPDX-License-Identifier: GPL-3.0-or-later
// Room rhs: plane finite elements of solids and fluids.
#include "bindings.hpp"
#include "held_model.hpp"
#include <spam/core/error.hpp>
#include <spam/external/clamp.hpp>
#include <spam/rhs/elements.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/meshes.hpp>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>
#include <map>

namespace spam::python {

using namespace py::literals;

namespace {

/// What elements are made of, as Python says it.
struct MatterOfElements {
    std::variant<Solid, Fluid> law;
    double density, viscosity, stiffness, temperature;
};

Elements::Material material_of_elements(const MatterOfElements& one, const SharedPending& pending) {
    const HourglassControl control{one.viscosity, one.stiffness};
    if (const auto* const fluid = std::get_if<Fluid>(&one.law))
        return {*fluid, one.density, control, one.temperature};
    return {material_of<2>(std::get<Solid>(one.law), pending), one.density, control, 0.0};
}

/// Of numbers of nodes as given: 0 or 1 for each in the order of the library.
Group group_of(const std::vector<std::int64_t>& nodes, const Particles<2>& particles,
               const char* name) {
    std::vector<unsigned char> given(particles.size(), 0);
    for (const std::int64_t k : nodes) {
        if (k < 0 || static_cast<std::size_t>(k) >= given.size())
            throw InputError(fmt::format("{}: {} is none of the {} nodes", name, k, given.size()));
        given[static_cast<std::size_t>(k)] = 1;
    }
    Group group(particles.size());
    for (std::size_t i = 0; i < group.size(); ++i)
        group[i] = given[static_cast<std::size_t>(particles.id[i])];
    return group;
}

Mesh mesh_of(const py::object& x, const std::vector<std::array<std::int64_t, 4>>& corners) {
    Mesh mesh{points_of<2>(x, "x"), {}};
    for (const auto& one : corners) {
        Quadrilateral element{};
        for (std::size_t c = 0; c < 4; ++c) {
            if (one[c] < 0 || one[c] >= mesh.node.cols())
                throw InputError(
                    fmt::format("corners: {} is none of the {} nodes", one[c], mesh.node.cols()));
            element[c] = static_cast<std::uint32_t>(one[c]);
        }
        mesh.element.push_back(element);
    }
    return mesh;
}

/// Nodes with a quarter of the mass of each element at a corner of which they are.
MeshedBodies nodes_of(const Mesh& mesh, const std::vector<MatterOfElements>& materials,
                      const std::vector<std::int32_t>& which, double spacing) {
    if (!(spacing > 0.0) || !std::isfinite(spacing))
        throw InputError(fmt::format("spacing: {} is not allowed; use a positive number", spacing));
    for (const auto& one : materials)
        if (!(one.density > 0.0) || !std::isfinite(one.density))
            throw InputError(
                fmt::format("density: {} is not allowed; use a positive number", one.density));
    MeshedBodies bodies = make_nodes({mesh}, 1.0, spacing);
    std::fill(bodies.nodes.mass.begin(), bodies.nodes.mass.end(), 0.0);
    const auto& X = bodies.nodes.reference_position;
    for (std::size_t k = 0; k < bodies.element.size(); ++k) {
        const std::int32_t m = which.empty() ? 0 : which.at(k);
        if (m < 0 || static_cast<std::size_t>(m) >= materials.size())
            throw InputError(
                fmt::format("which: {} is none of the {} materials", m, materials.size()));
        const auto& q = bodies.element[k];
        const Point<2> across = X.col(q[2]) - X.col(q[0]), up = X.col(q[3]) - X.col(q[1]);
        const double area = 0.5 * (across.x() * up.y() - across.y() * up.x());
        for (const std::uint32_t i : q)
            bodies.nodes.mass[i] += 0.25 * materials[static_cast<std::size_t>(m)].density * area;
    }
    for (std::size_t i = 0; i < bodies.nodes.size(); ++i)
        if (!(bodies.nodes.mass[i] > 0.0))
            throw InputError(fmt::format(
                "x: node {} has no mass; give elements whose corners go round them counterclockwise, and no "
                "node without an element",
                bodies.nodes.id[i]));
    return bodies;
}

py::object make_elements(const py::object& x,
                         const std::vector<std::array<std::int64_t, 4>>& corners,
                         const std::vector<MatterOfElements>& matter,
                         const std::vector<std::int32_t>& which, double spacing,
                         const std::vector<ExternalChoice>& externals,
                         const std::vector<std::int64_t>& held_x,
                         const std::vector<std::int64_t>& held_y) {
    const auto pending = std::make_shared<Pending>();
    if (!which.empty() && which.size() != corners.size())
        throw InputError(fmt::format("which: has {} numbers, and there are {} elements",
                                     which.size(), corners.size()));
    MeshedBodies bodies = nodes_of(mesh_of(x, corners), matter, which, spacing);
    std::vector<Elements::Material> materials;
    for (const auto& one : matter) materials.push_back(material_of_elements(one, pending));
    auto model = std::make_shared<ParticleModel<2>>(std::move(bodies.nodes));
    const auto& elements =
        model->add_term<Elements>(std::move(bodies.element), std::move(materials), which);
    for (const auto& one : externals) model->add(external_of<2>(one, pending));
    for (const auto& [axis, nodes] : {std::pair{0, &held_x}, {1, &held_y}}) {
        if (nodes->empty()) continue;
        auto held = std::make_unique<Clamp<2>>(
            group_of(*nodes, model->particles(), axis == 0 ? "held_x" : "held_y"));
        held->only_along(axis);
        model->add(std::move(held));
    }
    const auto* const solid = std::get_if<Solid>(&matter.front().law);
    const double modulus = solid ? modulus_of(*solid) : 1.0, density = matter.front().density;
    auto start = [&model = *model, &elements, density, modulus](const Points<2>& velocity,
                                                                double T) {
        Eigen::Index i = 0;  // asked for particle by particle, in order
        auto y = initial_state<2>(model, density, modulus,
                                  [&](const Point<2>&) { return Point<2>(velocity.col(i++)); });
        elements.warm(y, T > 0.0 ? std::optional(T) : std::nullopt);
        return y;
    };
    return py::cast(
        std::make_shared<HeldModel<2>>(std::move(model), std::move(start), std::move(pending)));
}

py::dict fields_of_elements(HeldModel<2>& self, const py::object& given) {
    const std::vector<double> y = self.checked(given);
    const typename HeldModel<2>::Use use(self);
    const auto* const elements = self.model->term<Elements>();
    if (elements == nullptr)
        throw InputError("model: it has no elements; give one made by Elements()");
    const Elements::Fields all = elements->fields(y);
    Points<3> stress(3, static_cast<Eigen::Index>(all.stress.size()));
    for (std::size_t k = 0; k < all.stress.size(); ++k)
        stress.col(static_cast<Eigen::Index>(k)) =
            Eigen::Map<const Eigen::Vector3d>(all.stress[k].c.data());
    py::dict fields;
    fields["density"] = array_of(all.density);
    fields["energy"] = array_of(all.energy);
    fields["stress"] = array_of<3>(stress);
    return fields;
}

}  // namespace

void bind_elements(py::module_& module) {
    py::class_<MatterOfElements>(module, "MatterOfElements")
        .def(py::init<std::variant<Solid, Fluid>, double, double, double, double>());
    module.def("elements", &make_elements, "x"_a, "corners"_a, "materials"_a, "which"_a,
               "spacing"_a, "externals"_a, "held_x"_a, "held_y"_a);
    module.def("element_fields", &fields_of_elements, "model"_a, "y"_a);
    module.def(
        "rectangle_mesh",
        [](int columns, int rows, double spacing) {
            const Mesh mesh = rectangle_mesh(columns, rows, spacing);
            return std::pair(array_of<2>(mesh.node), mesh.element);
        },
        "columns"_a, "rows"_a, "spacing"_a);
}

}  // namespace spam::python
