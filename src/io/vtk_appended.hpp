// SPDX-License-Identifier: GPL-3.0-or-later
// What VTK's XML files with raw appended numbers have in common.
#pragma once

#include <spam/neighbors/box.hpp>

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <ostream>
#include <string>
#include <string_view>

namespace spam {

/// A VTK file with appended data: an XML head, which says where each array begins, and a raw tail. The
/// arrays are gone through twice, first for the head and then for the numbers, so that these are
/// written one after the other and never gathered.
class VtkAppended {
  public:
    /// get(i, c): component c of tuple i. `unit`: empty for none.
    template <class Value, class Get>
    void array(std::string_view type, std::string_view name, int components, std::size_t tuples,
               const Get& get, std::string_view unit = {}) {
        const auto bytes = static_cast<std::uint64_t>(tuples) *
                           static_cast<std::uint64_t>(components) * sizeof(Value);
        if (tail_ == nullptr) {
            head_ += fmt::format(
                "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" "
                "format=\"appended\" offset=\"{}\"{}\n",
                type, name, components, offset_, end_of_array(unit));
            offset_ += sizeof bytes + bytes;
            return;
        }
        append(bytes);
        for (std::size_t i = 0; i < tuples; ++i)
            for (int c = 0; c < components; ++c) append(static_cast<Value>(get(i, c)));
        flush();
    }
    template <class Get>
    void reals(std::string_view name, int components, std::size_t tuples, const Get& get,
               std::string_view unit = {}) {
        array<double>("Float64", name, components, tuples, get, unit);
    }
    template <class Get>
    void integers(std::string_view name, std::size_t tuples, const Get& get) {
        array<std::int64_t>("Int64", name, 1, tuples, get);
    }
    /// What a reader must know beside the numbers: FieldData TimeValue (ParaView's name for it), box_low,
    /// box_high and periodic (3 each). The box is between walls, and where a side is open from `low` or to `high`.
    /// `units`: a text for readers, or empty.
    template <int Dim>
    static std::string field_data(double t, const Box<Dim>& box, const Point<Dim>& low,
                                  const Point<Dim>& high, std::string_view units = {}) {
        std::string lows, highs, periodic;
        for (int a = 0; a < 3; ++a) {
            const bool closed = a < Dim && box.periodic(a), free = a < Dim && !closed;
            const auto end = [&](bool upper) {
                if (!free) return upper && closed ? box.length(a) : 0.0;
                const Wall<Dim>& wall = box.wall(a, upper);
                return !wall.open() ? wall.at : upper ? high[a] : low[a];
            };
            lows += fmt::format(" {:.17g}", end(false));
            highs += fmt::format(" {:.17g}", end(true));
            periodic += closed ? " 1" : " 0";
        }
        return "    <FieldData>\n" + words("Float64", "TimeValue", 1, fmt::format(" {:.17g}", t)) +
               words("Float64", "box_low", 3, lows) + words("Float64", "box_high", 3, highs) +
               words("Int32", "periodic", 3, periodic) + text("units", units) +
               "    </FieldData>\n";
    }
    void open(std::string_view tag) { head_ += fmt::format("      <{}>\n", tag); }
    void close(std::string_view tag) { head_ += fmt::format("      </{}>\n", tag); }

    /// The file of a data set of this kind: what its element and its piece are given beside.
    /// `about`: its field data. `arrays(file)` opens, adds arrays and closes; it is called twice and must add the same.
    template <class Arrays>
    static void write(std::ostream& out, std::string_view kind, std::string_view attributes,
                      std::string_view about, std::string_view piece, const Arrays& arrays) {
        VtkAppended head;
        arrays(head);
        out << fmt::format(
                   "<?xml version=\"1.0\"?>\n"
                   "<VTKFile type=\"{0}\" version=\"1.0\" byte_order=\"{1}\" "
                   "header_type=\"UInt64\">\n"
                   "  <{0}{2}>\n"
                   "{3}"
                   "    <Piece {4}>\n",
                   kind, std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian",
                   attributes, about, piece)
            << head.head_
            << fmt::format("    </Piece>\n  </{}>\n  <AppendedData encoding=\"raw\">\n_", kind);
        VtkAppended tail;
        tail.tail_ = &out;
        arrays(tail);
        out << "\n  </AppendedData>\n</VTKFile>\n";
    }

  private:
    VtkAppended() = default;

    /// One tuple, in the head itself.
    static std::string words(std::string_view type, std::string_view name, int components,
                             std::string_view values) {
        return fmt::format(
            "      <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" "
            "NumberOfTuples=\"1\" format=\"ascii\">{} </DataArray>\n",
            type, name, components, values);
    }
    /// A text is an array of its bytes, ended by 0; nothing where it is empty.
    static std::string text(std::string_view name, std::string_view content) {
        if (content.empty()) return {};
        std::string bytes;
        for (const char c : content) bytes += fmt::format(" {}", static_cast<unsigned char>(c));
        return words("String", name, 1, bytes + " 0");
    }
    /// What ends the tag of an array in the head, and says its unit as VTK has it.
    static std::string end_of_array(std::string_view unit) {
        if (unit.empty()) return "/>";
        return fmt::format(
            "><InformationKey name=\"UNITS_LABEL\" "
            "location=\"vtkDataArray\">{}</InformationKey></DataArray>",
            unit);
    }
    template <class Value>
    void append(Value value) {
        if (used_ + sizeof(Value) > buffer_.size()) flush();
        std::memcpy(&buffer_[used_], &value, sizeof(Value));
        used_ += sizeof(Value);
    }
    void flush() {
        tail_->write(buffer_.data(), static_cast<std::streamsize>(used_));
        used_ = 0;
    }

    std::string head_;
    std::uint64_t offset_ = 0;
    std::ostream* tail_ = nullptr;  ///< null while the head is made
    std::array<char, 1 << 16> buffer_;
    std::size_t used_ = 0;
};

}  // namespace spam
