// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk_appended.hpp"
#include <spam/io/snapshot.hpp>

#include <fmt/format.h>

namespace spam {
namespace {

std::string snapshot_name(std::size_t number) { return fmt::format("snapshot_{:04}.vtp", number); }

/// Component c of a plane (linear) vector shown in space.
template <class View>
double in_space(const View& field, std::size_t i, int c) {
    return c < field.rows() ? field(c, static_cast<Eigen::Index>(i)) : 0.0;
}

template <int Dim>
void add_arrays(VtkAppended& file, const Model<Dim>& model, std::span<const double> y,
                const Points<Dim>& x, const std::vector<double>& density) {
    const ConstState<Dim> state(model.layout(), y);
    const auto& particles = model.particles();
    const std::size_t n = particles.size();
    const auto v = state.velocity();
    file.open("PointData");
    file.integers("id", n, [&](std::size_t i, int) { return particles.id[i]; });
    file.integers("body", n, [&](std::size_t i, int) { return particles.body[i]; });
    file.reals("mass", 1, n, [&](std::size_t i, int) { return particles.mass[i]; });
    file.reals("particle_spacing", 1, n, [&](std::size_t, int) { return particles.spacing; });
    file.reals("velocity", 3, n, [&](std::size_t i, int c) { return in_space(v, i, c); });
    if (!density.empty())
        file.reals("density", 1, n, [&](std::size_t i, int) { return density[i]; });
    if (state.has(Field::stress)) {
        const auto stress = state.stress();
        file.reals("stress", 9, n, [&](std::size_t i, int c) {
            const int a = c / 3, b = c % 3;
            return a < Dim && b < Dim ? stress(symmetric_index(Dim, std::min(a, b), std::max(a, b)),
                                               static_cast<Eigen::Index>(i))
                                      : 0.0;
        });
    }
    if (state.has(Field::energy))
        file.reals("energy", 1, n, [e = state.energy()](std::size_t i, int) {
            return e(0, static_cast<Eigen::Index>(i));
        });
    file.close("PointData");
    file.open("Points");
    file.reals("Points", 3, n, [&](std::size_t i, int c) { return in_space(x, i, c); });
    file.close("Points");
    file.open("Verts");
    file.integers("connectivity", n, [](std::size_t i, int) { return i; });
    file.integers("offsets", n, [](std::size_t i, int) { return i + 1; });
    file.close("Verts");
}

template <int Dim>
void write_snapshot(std::ostream& out, const Model<Dim>& model, double t,
                    std::span<const double> y) {
    const auto density = model.density(y);
    const Points<Dim> x = model.box().wrapped(ConstState<Dim>(model.layout(), y).position());
    VtkAppended::write(
        out, "PolyData", "",
        VtkAppended::field_data<Dim>(t, model.box(), x.rowwise().minCoeff(),
                                     x.rowwise().maxCoeff()),
        fmt::format("NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\" NumberOfLines=\"0\" "
                    "NumberOfStrips=\"0\" NumberOfPolys=\"0\"",
                    model.particles().size()),
        [&](VtkAppended& file) { add_arrays(file, model, y, x, density); });
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
void SnapshotSeries<Dim>::add(double t, std::span<const double> y) {
    const std::string name = snapshot_name(files_.size());
    folder_.write(name, [&](std::ostream& out) { write_snapshot(out, model_, t, y); });
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

template class SnapshotSeries<1>;
template class SnapshotSeries<2>;
template class SnapshotSeries<3>;

}  // namespace spam
