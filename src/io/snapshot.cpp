// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/io/snapshot.hpp>

#include <fmt/format.h>

#include <bit>
#include <cstring>

namespace spam {
namespace {

/// The XML head and the raw tail of a VTK file with appended data, built side by side.
class VtpFile {
  public:
    explicit VtpFile(std::size_t points) : points_(points) {}

    template <class Value, class Get>
    void array(std::string_view type, std::string_view name, int components, std::size_t tuples,
               const Get& get) {
        head_ += fmt::format(
            "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" "
            "format=\"appended\" offset=\"{}\"/>\n",
            type, name, components, tail_.size());
        const auto bytes = static_cast<std::uint64_t>(tuples) *
                           static_cast<std::uint64_t>(components) * sizeof(Value);
        append(bytes);
        for (std::size_t i = 0; i < tuples; ++i)
            for (int c = 0; c < components; ++c) append(static_cast<Value>(get(i, c)));
    }
    template <class Get>
    void reals(std::string_view name, int components, const Get& get) {
        array<double>("Float64", name, components, points_, get);
    }
    template <class Get>
    void integers(std::string_view name, std::size_t tuples, const Get& get) {
        array<std::int64_t>("Int64", name, 1, tuples, get);
    }
    void open(std::string_view tag) { head_ += fmt::format("      <{}>\n", tag); }
    void close(std::string_view tag) { head_ += fmt::format("      </{}>\n", tag); }

    std::string text() const {
        return fmt::format(
                   "<?xml version=\"1.0\"?>\n"
                   "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"{}\" "
                   "header_type=\"UInt64\">\n"
                   "  <PolyData>\n"
                   "    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"0\" "
                   "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
                   std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian",
                   points_, points_) +
               head_ + "    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n_" + tail_ +
               "\n  </AppendedData>\n</VTKFile>\n";
    }

  private:
    template <class Value>
    void append(Value value) {
        char bytes[sizeof(Value)];
        std::memcpy(bytes, &value, sizeof(Value));
        tail_.append(bytes, sizeof(Value));
    }
    std::size_t points_;
    std::string head_, tail_;
};

std::string snapshot_name(std::size_t number) { return fmt::format("snapshot_{:04}.vtp", number); }

/// Component c of a plane (linear) vector shown in space.
template <class View>
double in_space(const View& field, std::size_t i, int c) {
    return c < field.rows() ? field(c, static_cast<Eigen::Index>(i)) : 0.0;
}

template <int Dim>
std::string snapshot_text(const Model<Dim>& model, std::span<const double> y) {
    const ConstState<Dim> state(model.layout(), y);
    const auto& particles = model.particles();
    const std::size_t n = particles.size();
    const auto x = state.position();
    const auto v = state.velocity();
    VtpFile file(n);
    file.open("PointData");
    file.integers("id", n, [&](std::size_t i, int) { return particles.id[i]; });
    file.integers("body", n, [&](std::size_t i, int) { return particles.body[i]; });
    file.reals("mass", 1, [&](std::size_t i, int) { return particles.mass[i]; });
    file.reals("particle_spacing", 1, [&](std::size_t, int) { return particles.spacing; });
    file.reals("velocity", 3, [&](std::size_t i, int c) { return in_space(v, i, c); });
    const auto density = model.density(y);
    if (!density.empty()) file.reals("density", 1, [&](std::size_t i, int) { return density[i]; });
    if (state.has(Field::stress)) {
        const auto stress = state.stress();
        file.reals("stress", 9, [&](std::size_t i, int c) {
            const int a = c / 3, b = c % 3;
            return a < Dim && b < Dim ? stress(symmetric_index(Dim, std::min(a, b), std::max(a, b)),
                                               static_cast<Eigen::Index>(i))
                                      : 0.0;
        });
    }
    if (state.has(Field::energy))
        file.reals("energy", 1, [e = state.energy()](std::size_t i, int) {
            return e(0, static_cast<Eigen::Index>(i));
        });
    file.close("PointData");
    file.open("Points");
    file.reals("Points", 3, [&](std::size_t i, int c) { return in_space(x, i, c); });
    file.close("Points");
    file.open("Verts");
    file.integers("connectivity", n, [](std::size_t i, int) { return i; });
    file.integers("offsets", n, [](std::size_t i, int) { return i + 1; });
    file.close("Verts");
    return file.text();
}

}  // namespace

template <int Dim>
void SnapshotSeries<Dim>::resume(const std::vector<double>& times) {
    files_.clear();
    for (const double t : times) files_.emplace_back(t, snapshot_name(files_.size()));
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
    folder_.write(name, snapshot_text(model_, y));
    files_.emplace_back(t, name);
    std::string list =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n  <Collection>\n";
    for (const auto& [time, file] : files_)
        list +=
            fmt::format("    <DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>\n", time, file);
    folder_.write("snapshots.pvd", list + "  </Collection>\n</VTKFile>\n");
}

template class SnapshotSeries<1>;
template class SnapshotSeries<2>;
template class SnapshotSeries<3>;

}  // namespace spam
