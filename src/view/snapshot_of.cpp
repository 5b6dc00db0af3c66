// SPDX-License-Identifier: GPL-3.0-or-later
#include "results.hpp"
#include "vtp_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace spam::view {
namespace {

std::vector<std::uint32_t> small_numbers(const VtpFile& file, const VtpFile::Array& array,
                                         std::size_t tuples) {
    const auto numbers = file.integers(array, tuples);
    std::vector<std::uint32_t> result;
    result.reserve(numbers.size());
    for (const std::int64_t number : numbers) {
        if (number < 0 || number > std::numeric_limits<std::uint32_t>::max())
            file.refuse(fmt::format("{} holds {}", array.name, number));
        result.push_back(static_cast<std::uint32_t>(number));
    }
    return result;
}

/// Component after component, tuples `order`.
FieldArray arranged(const VtpFile& file, const VtpFile::Array& array, std::size_t tuples,
                    const std::vector<std::size_t>& order, std::string name) {
    const std::vector<double> numbers = file.reals(array, tuples);
    FieldArray field{std::move(name), array.components, {}};
    field.values.resize(array.components * order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t c = 0; c < array.components; ++c)
            field.values[c * order.size() + i] =
                static_cast<float>(numbers[order[i] * array.components + c]);
    return field;
}

const VtpFile::Array& needed(const VtpFile& file, std::string_view section, std::string_view name) {
    const VtpFile::Array* array = file.find(section, name);
    if (array == nullptr) file.refuse(fmt::format("it has no {}", name));
    return *array;
}

void read_elements(const VtpFile& file, const std::vector<std::size_t>& place, Snapshot& snapshot) {
    const std::size_t n = file.polygons();
    const auto ends = small_numbers(file, needed(file, "Polys", "offsets"), n);
    for (std::size_t k = 0; k < n; ++k)
        if (ends[k] != 4 * (k + 1)) file.refuse("a polygon has other than four corners");
    for (const std::uint32_t corner :
         small_numbers(file, needed(file, "Polys", "connectivity"), 4 * n)) {
        if (corner >= place.size()) file.refuse("an element has a corner that does not exist");
        snapshot.corners.push_back(static_cast<std::uint32_t>(place[corner]));
    }
    std::vector<std::size_t> elements(n);  // cells begin with the points that are cells
    std::iota(elements.begin(), elements.end(), file.vertices());
    for (const auto& array : file.arrays())
        if (array.section == "CellData" && array.name != "element")
            snapshot.cells.push_back(
                arranged(file, array, file.vertices() + n, elements, array.name));
}

}  // namespace

Snapshot read_snapshot(const std::filesystem::path& path) {
    const VtpFile file(path);
    const std::size_t n = file.points();
    Snapshot snapshot;
    snapshot.t = file.time();
    snapshot.low = file.low();
    snapshot.high = file.high();
    snapshot.periodic = file.periodic();

    const auto id = small_numbers(file, needed(file, "PointData", "id"), n);
    std::vector<std::size_t> order(n), place(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return id[a] < id[b]; });
    for (std::size_t i = 0; i < n; ++i) {
        place[order[i]] = i;
        snapshot.id.push_back(id[order[i]]);
        if (i > 0 && snapshot.id[i] == snapshot.id[i - 1])
            file.refuse(fmt::format("two particles have the id {}", snapshot.id[i]));
    }
    snapshot.points.push_back(
        arranged(file, needed(file, "Points", "Points"), n, order, "position"));
    for (const char* name : {"velocity"})
        snapshot.points.push_back(arranged(file, needed(file, "PointData", name), n, order, name));
    for (const FieldArray& vector : snapshot.points) {
        if (vector.components != 3) file.refuse(vector.name + " should have three components");
        if (!std::all_of(vector.values.begin(), vector.values.end(),
                         [](float v) { return std::isfinite(v); }))
            file.refuse(vector.name + " is not finite");
    }
    for (const auto& array : file.arrays())
        if (array.section == "PointData" && array.name != "id" && array.name != "velocity")
            snapshot.points.push_back(arranged(file, array, n, order, array.name));
    if (file.polygons() > 0) read_elements(file, place, snapshot);
    return snapshot;
}

}  // namespace spam::view
