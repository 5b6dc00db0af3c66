// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk_appended.hpp"
#include <spam/io/snapshot.hpp>
#include <spam/rhs/elements.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace spam {
namespace {

std::string snapshot_name(std::size_t number) { return fmt::format("snapshot_{:04}.vtp", number); }

/// Component c of a plane (linear) vector shown in space.
template <class View>
double in_space(const View& field, std::size_t i, int c) {
    return c < field.rows() ? field(c, static_cast<Eigen::Index>(i)) : 0.0;
}

/// A symmetric tensor of the plane (line), row by row in space.
template <class View>
double tensor_in_space(const View& field, std::size_t i, int c) {
    const int a = c / 3, b = c % 3;
    const int dim = field.rows() == 1 ? 1 : field.rows() == 3 ? 2 : 3;
    return a < dim && b < dim ? field(symmetric_index(dim, std::min(a, b), std::max(a, b)),
                                      static_cast<Eigen::Index>(i))
                              : 0.0;
}

/// Particles that are shown as points: with elements those that no element has as its corner.
template <int Dim>
std::vector<std::uint32_t> vertices(const Model<Dim>& model) {
    std::vector<bool> corner(model.particles().size(), false);
    for (const Quadrilateral& one : model.quadrilaterals())
        for (const std::uint32_t i : one) corner[i] = true;
    std::vector<std::uint32_t> alone;
    for (std::uint32_t i = 0; i < corner.size(); ++i)
        if (!corner[i]) alone.push_back(i);
    return alone;
}

/// What elements of fluids have besides what y holds, and with them all others.
bool add_fluid_arrays(VtkAppended& file, const Elements::Fields& all, std::size_t points,
                      const UnitNames& units) {
    const std::size_t n = all.density.size();
    if (n == 0) return false;
    const auto add = [&](Field field, int components, const auto& value) {
        file.reals(
            field.name(), components, points + n,
            [&](std::size_t k, int c) { return k < points ? 0.0 : value(k - points, c); },
            units.of(field.unit(), 2));
    };
    add(Field::density, 1, [&](std::size_t k, int) { return all.density[k]; });
    add(Field::stress, 9, [&](std::size_t k, int c) {
        return tensor_in_space(Eigen::Map<const Eigen::Vector3d>(all.stress[k].c.data()), 0, c);
    });
    add(Field::energy, 1, [&](std::size_t k, int) { return all.energy[k]; });
    return true;
}

/// Every field of the elements, by the names of the fields. VTK counts the points that are cells first.
template <int Dim>
void add_element_arrays(VtkAppended& file, const Model<Dim>& model, std::span<const double> y,
                        std::size_t points, const UnitNames& units) {
    const ConstState<Dim> state(model.layout(), y);
    const std::size_t cells = points + model.quadrilaterals().size();
    file.open("CellData");
    file.integers("element", cells, [&](std::size_t k, int) {
        return static_cast<std::int64_t>(k) - static_cast<std::int64_t>(points);
    });
    bool fluid = false;
    if constexpr (Dim == 2) fluid = add_fluid_arrays(file, fluid_elements(model, y), points, units);
    for (const auto& block : model.layout().blocks()) {
        if (block.holder != Holder::element) continue;
        if (fluid && (block.field == Field::stress || block.field == Field::energy)) continue;
        const auto field = state.elements().field(block.field);
        const Rank rank = block.field.rank();
        const int components = rank == Rank::symmetric ? 9 : rank == Rank::vector ? 3 : 1;
        const auto value = [&](std::size_t k, int c) {
            return k < points                ? 0.0
                   : rank == Rank::symmetric ? tensor_in_space(field, k - points, c)
                                             : in_space(field, k - points, c);
        };
        file.reals(block.field.name(), components, cells, value, units.of(block.field.unit(), Dim));
    }
    file.close("CellData");
}

template <int Dim>
void add_arrays(VtkAppended& file, const Model<Dim>& model, std::span<const double> y,
                std::span<const ParticleNumbers> more, const Points<Dim>& x,
                const std::vector<double>& density, const UnitNames& units) {
    const ConstState<Dim> state(model.layout(), y);
    const auto& particles = model.particles();
    const std::size_t n = particles.size();
    const auto v = state.velocity();
    file.open("PointData");
    file.integers("id", n, [&](std::size_t i, int) { return particles.id[i]; });
    file.integers("body", n, [&](std::size_t i, int) { return particles.body[i]; });
    const auto unit = [&](Field field) { return units.of(field.unit(), Dim); };
    file.reals(
        "mass", 1, n, [&](std::size_t i, int) { return particles.mass[i]; }, units.of("m", Dim));
    file.reals(
        "particle_spacing", 1, n, [&](std::size_t, int) { return particles.spacing; },
        units.of("l", Dim));
    file.reals(
        "velocity", 3, n, [&](std::size_t i, int c) { return in_space(v, i, c); },
        unit(Field::velocity));
    if (!density.empty())
        file.reals(
            "density", 1, n, [&](std::size_t i, int) { return density[i]; }, unit(Field::density));
    if (state.has(Field::stress))
        file.reals(
            "stress", 9, n,
            [stress = state.stress()](std::size_t i, int c) {
                return tensor_in_space(stress, i, c);
            },
            unit(Field::stress));
    if (state.has(Field::energy))
        file.reals(
            "energy", 1, n,
            [e = state.energy()](std::size_t i, int) { return e(0, static_cast<Eigen::Index>(i)); },
            unit(Field::energy));
    for (const ParticleNumbers& one : more)
        file.reals(
            one.name, 1, n, [&](std::size_t i, int) { return one.values[i]; }, "");
    file.close("PointData");
    const std::vector<std::uint32_t> alone = vertices(model);
    if (!model.quadrilaterals().empty()) add_element_arrays(file, model, y, alone.size(), units);
    file.open("Points");
    file.reals(
        "Points", 3, n, [&](std::size_t i, int c) { return in_space(x, i, c); },
        units.of("l", Dim));
    file.close("Points");
    file.open("Verts");
    file.integers("connectivity", alone.size(), [&](std::size_t k, int) { return alone[k]; });
    file.integers("offsets", alone.size(), [](std::size_t k, int) { return k + 1; });
    file.close("Verts");
    const auto elements = model.quadrilaterals();
    if (elements.empty()) return;
    file.open("Polys");
    file.integers("connectivity", 4 * elements.size(),
                  [&](std::size_t k, int) { return elements[k / 4][k % 4]; });
    file.integers("offsets", elements.size(), [](std::size_t k, int) { return 4 * (k + 1); });
    file.close("Polys");
}

template <int Dim>
void write_snapshot(std::ostream& out, const Model<Dim>& model, double t, std::span<const double> y,
                    std::span<const ParticleNumbers> more, const UnitNames& units) {
    const auto density = model.density(y);
    const Points<Dim> x = model.box().wrapped(ConstState<Dim>(model.layout(), y).position());
    VtkAppended::write(
        out, "PolyData", "",
        VtkAppended::field_data<Dim>(t, model.box(), x.rowwise().minCoeff(), x.rowwise().maxCoeff(),
                                     units.declared() ? units.describe() : ""),
        fmt::format("NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"0\" "
                    "NumberOfStrips=\"0\" NumberOfPolys=\"{}\"",
                    model.particles().size(), vertices(model).size(),
                    model.quadrilaterals().size()),
        [&](VtkAppended& file) { add_arrays(file, model, y, more, x, density, units); });
}

}  // namespace

template <int Dim>
void SnapshotSeries<Dim>::resume(const std::vector<double>& times) {
    files_.clear();
    for (const double t : times) files_.emplace_back(t, snapshot_name(files_.size()));
    if (!files_.empty()) write_file_series(folder_, "snapshots", files_);  // none may follow
    std::error_code ignored;
    for (std::size_t k = times.size();
         std::filesystem::remove(folder_ / snapshot_name(k), ignored);)
        ++k;
}

template <int Dim>
std::vector<std::string> SnapshotSeries<Dim>::names() const {
    std::vector<std::string> names;
    for (const auto& [t, name] : files_) names.push_back(name);
    return names;
}

template <int Dim>
void SnapshotSeries<Dim>::add(double t, std::span<const double> y,
                              std::span<const ParticleNumbers> more) {
    const std::string name = snapshot_name(files_.size());
    folder_.write(name,
                  [&](std::ostream& out) { write_snapshot(out, *model_, t, y, more, units_); });
    files_.emplace_back(t, name);
    write_file_series(folder_, "snapshots", files_);
}

void write_file_series(const RunFolder& folder, std::string_view name,
                       const std::vector<std::pair<double, std::string>>& files) {
    std::string list =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n  <Collection>\n";
    for (const auto& [time, file] : files)
        list +=
            fmt::format("    <DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>\n", time, file);
    folder.write(fmt::format("{}.pvd", name), list + "  </Collection>\n</VTKFile>\n");
}

SPAM_COMPILED(template class SnapshotSeries);

}  // namespace spam
