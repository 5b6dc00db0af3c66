// SPDX-License-Identifier: GPL-3.0-or-later
// Reads result files back, independently of the code that writes them, and strictly: whatever a
// picky reader would stumble over throws. Compiled once (spam_test_files).
#pragma once

#include "support/process.hpp"

#include <boost/property_tree/ptree_fwd.hpp>
#include <nlohmann/json_fwd.hpp>

namespace spam::test {

/// Throws std::runtime_error{otherwise} unless it holds.
void require(bool holds, const std::string& otherwise);

std::vector<std::string> split(const std::string& text, char separator);

/// A table of numbers under a header. Every line must be whole.
struct Csv {
    std::vector<std::string> names;
    std::vector<std::vector<std::string>> cells;

    explicit Csv(const std::filesystem::path& file);
    std::vector<double> column(const std::string& name) const;
    static double number(const std::string& cell);
};

/// To look into it, include <nlohmann/json.hpp>.
nlohmann::json json_of(const std::filesystem::path& file);

boost::property_tree::ptree xml_of(const std::string& text);

/// Field data of a VTK data set by name, as words with single blanks between them; texts, which are bytes in VTK,
/// as they are.
std::map<std::string, std::string> field_data(const boost::property_tree::ptree& set);

/// A ParaView collection: time and file of every snapshot.
std::vector<std::pair<double, std::string>> collection(const std::filesystem::path& file);

/// A VTK PolyData file with raw appended data: its arrays by name, as doubles; those of cells with "element_"
/// before it, those of the polygons themselves with "polygon_".
struct Vtp {
    std::size_t points = 0, vertices = 0, polygons = 0;
    std::map<std::string, std::vector<double>> arrays;
    std::map<std::string, int> components;
    std::map<std::string, std::string> about;  ///< field data
    std::map<std::string, std::string> units;  ///< of arrays that have one

    explicit Vtp(const std::filesystem::path& file);

  private:
    std::size_t read(const boost::property_tree::ptree& array, const std::string& data,
                     std::size_t offset, std::size_t tuples, const std::string& prefix);
};

}  // namespace spam::test
