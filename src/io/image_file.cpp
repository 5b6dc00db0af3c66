// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk_appended.hpp"
#include <spam/core/error.hpp>
#include <spam/io/image_file.hpp>

namespace spam {
namespace {

/// One word for each direction of space; those that the grid has not get `beyond`.
template <int Dim, class Word>
std::string for_directions(const Word& word, const std::string& beyond) {
    std::string words;
    for (int a = 0; a < 3; ++a) words += (a > 0 ? " " : "") + (a < Dim ? word(a) : beyond);
    return words;
}

}  // namespace

template <int Dim>
void write_image(const RunFolder& folder, std::string_view name, double t, const Box<Dim>& box,
                 const FieldGrid<Dim>& grid, const std::vector<ImageField>& fields) {
    const std::size_t n = grid.size();
    for (const ImageField& field : fields)
        if (static_cast<std::size_t>(field.values.cols()) != n)
            throw InputError(
                fmt::format("image: field '{}' has {} columns for {} nodes; give one a node",
                            field.name, field.values.cols(), n));
    const auto arrays = [&](VtkAppended& file) {
        file.open("PointData");
        for (const ImageField& field : fields) {
            const auto rows = static_cast<int>(field.values.rows());
            const bool vector = Dim > 1 && rows == Dim;
            file.reals(field.name, vector ? 3 : rows, n, [&](std::size_t i, int c) {
                return c < rows ? field.values(c, static_cast<Eigen::Index>(i)) : 0.0;
            });
        }
        file.close("PointData");
    };
    Point<Dim> high = grid.origin;
    for (int a = 0; a < Dim; ++a)
        high[a] += grid.spacing[a] * (grid.nodes[static_cast<std::size_t>(a)] - 1);
    const std::string about = VtkAppended::field_data<Dim>(t, box, grid.origin, high);
    const std::string extent = for_directions<Dim>(
        [&](int a) { return fmt::format("0 {}", grid.nodes[static_cast<std::size_t>(a)] - 1); },
        "0 0");
    const auto number = [](double x) { return fmt::format("{:.17g}", x); };
    const std::string attributes =
        fmt::format(" WholeExtent=\"{}\" Origin=\"{}\" Spacing=\"{}\"", extent,
                    for_directions<Dim>([&](int a) { return number(grid.origin(a)); }, "0"),
                    for_directions<Dim>([&](int a) { return number(grid.spacing(a)); }, "1"));
    folder.write(fmt::format("{}.vti", name), [&](std::ostream& out) {
        VtkAppended::write(out, "ImageData", attributes, about,
                           fmt::format("Extent=\"{}\"", extent), arrays);
    });
}

#define SPAM_INSTANTIATE(D)                                                              \
    template void write_image(const RunFolder&, std::string_view, double, const Box<D>&, \
                              const FieldGrid<D>&, const std::vector<ImageField>&);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
