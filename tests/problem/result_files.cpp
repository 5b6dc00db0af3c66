// SPDX-License-Identifier: GPL-3.0-or-later
#include "problem/result_files.hpp"

#include <boost/property_tree/xml_parser.hpp>
#include <nlohmann/json.hpp>

#include <charconv>
#include <cstdint>
#include <cstring>
#include <sstream>

namespace spam::test {

void require(bool holds, const std::string& otherwise) {
    if (!holds) throw std::runtime_error(otherwise);
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
    return parts;
}

Csv::Csv(const std::filesystem::path& file) {
    const std::string text = contents_of(file);
    require(text.ends_with('\n'), file.string() + " ends within a line");
    for (const auto& line : split(text, '\n')) cells.push_back(split(line, ','));
    names = cells.front();
    cells.erase(cells.begin());
    for (const auto& row : cells)
        require(row.size() == names.size(), file.string() + " has a ragged row");
}

std::vector<double> Csv::column(const std::string& name) const {
    const auto at = std::find(names.begin(), names.end(), name) - names.begin();
    std::vector<double> values;
    for (const auto& row : cells) values.push_back(number(row.at(static_cast<std::size_t>(at))));
    return values;
}

double Csv::number(const std::string& cell) {
    double value = 0.0;
    const char* last = cell.data() + cell.size();
    const auto [end, error] = std::from_chars(cell.data(), last, value);
    require(error == std::errc{} && end == last, "'" + cell + "' is not a number");
    return value;
}

nlohmann::json json_of(const std::filesystem::path& file) {
    return nlohmann::json::parse(contents_of(file));
}

boost::property_tree::ptree xml_of(const std::string& text) {
    std::istringstream in(text);
    boost::property_tree::ptree tree;
    boost::property_tree::read_xml(in, tree);
    return tree;
}

std::map<std::string, std::string> field_data(const boost::property_tree::ptree& set) {
    std::map<std::string, std::string> all;
    for (const auto& [tag, array] : set.get_child("FieldData")) {
        if (tag != "DataArray") continue;
        require(array.get<std::string>("<xmlattr>.format") == "ascii", "field data not ascii");
        require(array.get<int>("<xmlattr>.NumberOfTuples") == 1, "more than one tuple");
        std::istringstream words(array.data());
        std::string& text = all[array.get<std::string>("<xmlattr>.Name")];
        int count = 0;
        if (array.get<std::string>("<xmlattr>.type") == "String") {
            int byte = 0;
            while (words >> byte && byte != 0) text += static_cast<char>(byte);
            require(byte == 0, "a text does not end");
            continue;
        }
        for (std::string word; words >> word; ++count) text += (count > 0 ? " " : "") + word;
        require(array.get<int>("<xmlattr>.NumberOfComponents") == count, "components");
    }
    return all;
}

std::vector<std::pair<double, std::string>> collection(const std::filesystem::path& file) {
    const auto tree = xml_of(contents_of(file));
    require(tree.get<std::string>("VTKFile.<xmlattr>.type") == "Collection", "not a collection");
    std::vector<std::pair<double, std::string>> all;
    for (const auto& [tag, set] : tree.get_child("VTKFile.Collection"))
        if (tag == "DataSet")
            all.emplace_back(Csv::number(set.get<std::string>("<xmlattr>.timestep")),
                             set.get<std::string>("<xmlattr>.file"));
    return all;
}

namespace {

template <class Value>
Value value_at(const std::string& data, std::size_t offset) {
    Value value;
    std::memcpy(&value, data.data() + offset, sizeof value);
    return value;
}

}  // namespace

Vtp::Vtp(const std::filesystem::path& file) {
    const std::string text = contents_of(file);
    const std::string opening = "<AppendedData encoding=\"raw\">\n_";
    const std::size_t cut = text.find(opening);
    require(cut != std::string::npos, file.string() + " has no appended data");
    const auto tree = xml_of(text.substr(0, cut) + "</VTKFile>");
    require(tree.get<std::string>("VTKFile.<xmlattr>.type") == "PolyData", "not PolyData");
    require(tree.get<std::string>("VTKFile.<xmlattr>.byte_order") == "LittleEndian", "order");
    require(tree.get<std::string>("VTKFile.<xmlattr>.header_type") == "UInt64", "header type");
    about = field_data(tree.get_child("VTKFile.PolyData"));
    const auto& piece = tree.get_child("VTKFile.PolyData.Piece");
    points = piece.get<std::size_t>("<xmlattr>.NumberOfPoints");
    vertices = piece.get<std::size_t>("<xmlattr>.NumberOfVerts");
    polygons = piece.get<std::size_t>("<xmlattr>.NumberOfPolys");
    const std::string data = text.substr(cut + opening.size());
    std::size_t end = 0;  // arrays follow each other without gaps
    const auto read_part = [&](const char* part, const std::string& prefix, std::size_t tuples) {
        for (const auto& [tag, array] : piece.get_child(part)) {
            if (tag != "DataArray") continue;
            const bool corners = part == std::string("Polys") &&
                                 array.get<std::string>("<xmlattr>.Name") == "connectivity";
            end = read(array, data, end, corners ? 4 * tuples : tuples, prefix);
        }
    };
    read_part("PointData", "", points);
    if (polygons > 0) read_part("CellData", "element_", vertices + polygons);
    read_part("Points", "", points);
    read_part("Verts", "", vertices);
    if (polygons > 0) read_part("Polys", "polygon_", polygons);
    const auto rest = xml_of("<VTKFile><AppendedData>" + data.substr(end));
    require(rest.get_child("VTKFile").size() == 1, "something follows the data");
}

std::size_t Vtp::read(const boost::property_tree::ptree& array, const std::string& data,
                      std::size_t offset, std::size_t tuples, const std::string& prefix) {
    const auto name = prefix + array.get<std::string>("<xmlattr>.Name");
    const auto type = array.get<std::string>("<xmlattr>.type");
    if (const auto unit = array.get_optional<std::string>("InformationKey")) {
        require(array.get<std::string>("InformationKey.<xmlattr>.name") == "UNITS_LABEL", "key");
        units[name] = *unit;
    }
    const int width = components[name] = array.get<int>("<xmlattr>.NumberOfComponents");
    require(array.get<std::string>("<xmlattr>.format") == "appended", name + " not appended");
    require(array.get<std::size_t>("<xmlattr>.offset") == offset, name + " has a wrong offset");
    std::uint64_t bytes = 0;
    require(data.size() >= offset + sizeof bytes, name + " is cut off");
    std::memcpy(&bytes, data.data() + offset, sizeof bytes);
    offset += sizeof bytes;
    require(bytes == 8 * tuples * static_cast<std::size_t>(width), name + " has a wrong size");
    require(data.size() >= offset + bytes, name + " is cut off");
    require(type == "Float64" || type == "Int64", name + " has an unknown type");
    for (std::size_t k = 0; k < bytes; k += 8)
        arrays[name].push_back(type == "Float64"
                                   ? value_at<double>(data, offset + k)
                                   : static_cast<double>(value_at<std::int64_t>(data, offset + k)));
    return offset + bytes;
}

}  // namespace spam::test
