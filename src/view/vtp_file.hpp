// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spam::view {

/// A snapshot as io/snapshot.hpp describes it: PolyData with raw appended numbers of 64 bits, little
/// endian. Everything that is asked for is checked against the length of the file first: whatever the
/// bytes are, reading ends with numbers or with an InputError of one line that names the file.
class VtpFile {
  public:
    /// Throws InputError where the file cannot be read, is cut off, or is of another kind.
    explicit VtpFile(std::filesystem::path path);

    struct Array {
        std::string section;  ///< PointData, CellData, Points, Verts or Polys
        std::string name;
        bool whole_numbers;
        std::size_t components;
        std::size_t offset;  ///< of its length, from the begin of the tail
    };

    std::size_t points() const { return points_; }
    std::size_t vertices() const { return vertices_; }
    std::size_t polygons() const { return polygons_; }
    const std::vector<Array>& arrays() const { return arrays_; }
    /// Null where there is none.
    const Array* find(std::string_view section, std::string_view name) const;

    /// `components` numbers for each of `tuples`, tuple by tuple. Throws InputError where the array is of
    /// another length or type.
    std::vector<double> reals(const Array& array, std::size_t tuples) const;
    std::vector<std::int64_t> integers(const Array& array, std::size_t tuples) const;

    /// Field data: TimeValue and the box.
    double time() const { return time_; }
    const std::array<double, 3>& low() const { return low_; }
    const std::array<double, 3>& high() const { return high_; }
    const std::array<bool, 3>& periodic() const { return periodic_; }

    /// Throws InputError: <file> is damaged: <reason>.
    [[noreturn]] void refuse(const std::string& reason) const;

  private:
    using Attributes = std::map<std::string, std::string, std::less<>>;
    void read_head(std::string_view head);
    void read_element(const std::string& name, const Attributes& attributes, std::string_view text,
                      const std::string& section);
    void read_field_data(const Attributes& attributes, std::string_view text);
    std::size_t count(const Attributes& attributes, std::string_view name) const;
    template <class Number>
    std::vector<Number> numbers(const Array& array, std::size_t tuples) const;

    std::filesystem::path path_;
    std::string bytes_;
    std::size_t tail_ = 0;  ///< where the appended numbers begin in bytes_
    std::size_t points_ = 0, vertices_ = 0, polygons_ = 0;
    std::vector<Array> arrays_;
    double time_ = 0.0;
    bool timed_ = false;
    std::array<double, 3> low_{}, high_{};
    std::array<bool, 3> periodic_{};
};

}  // namespace spam::view
