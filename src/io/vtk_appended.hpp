// SPDX-License-Identifier: GPL-3.0-or-later
// What VTK's XML files with raw appended numbers have in common.
#pragma once

#include <spam/neighbors/box.hpp>

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace spam {

/// The XML head and the raw tail of a VTK file with appended data, built side by side.
class VtkAppended {
  public:
    /// get(i, c): component c of tuple i
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
    void reals(std::string_view name, int components, std::size_t tuples, const Get& get) {
        array<double>("Float64", name, components, tuples, get);
    }
    template <class Get>
    void integers(std::string_view name, std::size_t tuples, const Get& get) {
        array<std::int64_t>("Int64", name, 1, tuples, get);
    }
    /// What a reader must know beside the numbers: FieldData TimeValue (ParaView's name for it), box_low,
    /// box_high and periodic (3 each). Where space is free the box is from `low` to `high`.
    template <int Dim>
    void about(double t, const Box<Dim>& box, const Point<Dim>& low, const Point<Dim>& high) {
        std::string lows, highs, periodic;
        for (int a = 0; a < 3; ++a) {
            const bool closed = a < Dim && box.periodic(a), free = a < Dim && !closed;
            lows += fmt::format(" {:.17g}", free ? low[a] : 0.0);
            highs += fmt::format(" {:.17g}", free ? high[a] : closed ? box.length(a) : 0.0);
            periodic += closed ? " 1" : " 0";
        }
        about_ = "    <FieldData>\n" +
                 words("Float64", "TimeValue", 1, fmt::format(" {:.17g}", t)) +
                 words("Float64", "box_low", 3, lows) + words("Float64", "box_high", 3, highs) +
                 words("Int32", "periodic", 3, periodic) + "    </FieldData>\n";
    }
    void open(std::string_view tag) { head_ += fmt::format("      <{}>\n", tag); }
    void close(std::string_view tag) { head_ += fmt::format("      </{}>\n", tag); }

    /// The file of a data set of this kind: what its element and its piece are given beside.
    std::string text(std::string_view kind, std::string_view attributes,
                     std::string_view piece) const {
        return fmt::format(
                   "<?xml version=\"1.0\"?>\n"
                   "<VTKFile type=\"{0}\" version=\"1.0\" byte_order=\"{1}\" "
                   "header_type=\"UInt64\">\n"
                   "  <{0}{2}>\n"
                   "{3}"
                   "    <Piece {4}>\n",
                   kind, std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian",
                   attributes, about_, piece) +
               head_ +
               fmt::format("    </Piece>\n  </{}>\n  <AppendedData encoding=\"raw\">\n_", kind) +
               tail_ + "\n  </AppendedData>\n</VTKFile>\n";
    }

  private:
    /// One tuple, in the head itself.
    static std::string words(std::string_view type, std::string_view name, int components,
                             std::string_view values) {
        return fmt::format(
            "      <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" "
            "NumberOfTuples=\"1\" format=\"ascii\">{} </DataArray>\n",
            type, name, components, values);
    }
    template <class Value>
    void append(Value value) {
        char bytes[sizeof(Value)];
        std::memcpy(bytes, &value, sizeof(Value));
        tail_.append(bytes, sizeof(Value));
    }
    std::string about_, head_, tail_;
};

}  // namespace spam
