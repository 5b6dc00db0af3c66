// SPDX-License-Identifier: GPL-3.0-or-later
// A .vti file read back: the grid and every number as they were, in the order that VTK expects.
#include "problem/result_files.hpp"
#include <spam/core/error.hpp>
#include <spam/io/image_file.hpp>

#include <boost/property_tree/ptree.hpp>
#include <boost/test/unit_test.hpp>

using namespace spam;
using spam::test::Scratch;

namespace {

/// An image as a strict reader finds it.
struct Vti {
    std::string extent, whole_extent, origin, spacing;
    std::map<std::string, int> components;
    std::map<std::string, std::vector<double>> arrays;
    std::map<std::string, std::string> about;  ///< field data

    explicit Vti(const std::filesystem::path& file) {
        const std::string text = test::contents_of(file),
                          opening = "<AppendedData encoding=\"raw\">\n_";
        const std::size_t cut = text.find(opening);
        test::require(cut != std::string::npos, "no appended data");
        const auto tree = test::xml_of(text.substr(0, cut) + "</VTKFile>");
        test::require(tree.get<std::string>("VTKFile.<xmlattr>.type") == "ImageData", "type");
        test::require(tree.get<std::string>("VTKFile.<xmlattr>.header_type") == "UInt64", "header");
        const auto& image = tree.get_child("VTKFile.ImageData");
        whole_extent = image.get<std::string>("<xmlattr>.WholeExtent");
        origin = image.get<std::string>("<xmlattr>.Origin");
        spacing = image.get<std::string>("<xmlattr>.Spacing");
        extent = image.get<std::string>("Piece.<xmlattr>.Extent");
        about = test::field_data(image);
        const std::string raw = text.substr(cut + opening.size());
        std::size_t end = 0;
        for (const auto& [tag, array] : image.get_child("Piece.PointData"))
            if (tag == "DataArray") end = read(array, raw, end);
        test::require(raw.substr(end) == "\n  </AppendedData>\n</VTKFile>\n", "something follows");
    }

  private:
    std::size_t read(const boost::property_tree::ptree& array, const std::string& raw,
                     std::size_t offset) {
        const auto name = array.get<std::string>("<xmlattr>.Name");
        components[name] = array.get<int>("<xmlattr>.NumberOfComponents");
        test::require(array.get<std::string>("<xmlattr>.type") == "Float64", "type of " + name);
        test::require(array.get<std::size_t>("<xmlattr>.offset") == offset, "offset of " + name);
        std::uint64_t bytes = 0;
        std::memcpy(&bytes, raw.data() + offset, sizeof bytes);
        offset += sizeof bytes;
        test::require(raw.size() >= offset + bytes, name + " is cut off");
        arrays[name].resize(bytes / sizeof(double));
        std::memcpy(arrays[name].data(), raw.data() + offset, bytes);
        return offset + bytes;
    }
};

Eigen::MatrixXd numbers(Eigen::Index rows, std::size_t nodes) {
    Eigen::MatrixXd values(rows, static_cast<Eigen::Index>(nodes));
    for (Eigen::Index k = 0; k < values.size(); ++k)
        values.reshaped()(k) = 1.0 / (3.0 + static_cast<double>(k));
    return values;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_plane) {
    const Scratch folder;
    const auto grid = FieldGrid<2>::between({-1.0, 0.1}, {2.0, 0.6}, 0.5);  // 7 x 2
    const Eigen::MatrixXd rho = numbers(1, 14), v = numbers(2, 14), sigma = numbers(3, 14);
    write_image(RunFolder(folder / "out", false), "field", 1.25, Box<2>({0.0, 2.0}), grid,
                {{"density", rho}, {"velocity", v}, {"stress", sigma}});
    const Vti vti(folder / "out/field.vti");
    BOOST_TEST(vti.extent == "0 6 0 1 0 0");
    BOOST_TEST(vti.whole_extent == vti.extent);
    BOOST_TEST(vti.origin == "-1 0.10000000000000001 0");
    BOOST_TEST(vti.spacing == "0.5 0.5 1");
    BOOST_TEST((vti.about == std::map<std::string, std::string>{{"TimeValue", "1.25"},
                                                                {"box_low", "-1 0 0"},
                                                                {"box_high", "2 2 0"},
                                                                {"periodic", "0 1 0"}}));
    BOOST_TEST((vti.components ==
                std::map<std::string, int>{{"density", 1}, {"velocity", 3}, {"stress", 3}}));
    for (std::size_t p = 0; p < 14; ++p) {
        const auto i = static_cast<Eigen::Index>(p);
        BOOST_TEST(vti.arrays.at("density").at(p) == rho(0, i));
        BOOST_TEST(vti.arrays.at("velocity").at(3 * p) == v(0, i));
        BOOST_TEST(vti.arrays.at("velocity").at(3 * p + 1) == v(1, i));
        BOOST_TEST(vti.arrays.at("velocity").at(3 * p + 2) == 0.0);
        BOOST_TEST(vti.arrays.at("stress").at(3 * p + 2) == sigma(2, i));
    }
}

BOOST_AUTO_TEST_CASE(a_line_and_space) {
    const Scratch folder;
    const RunFolder out(folder / "out", false);
    write_image(out, "line", 0.0, Box<1>({2.0}), FieldGrid<1>::over(Box<1>({2.0}), {4}),
                {{"f", numbers(1, 4)}});
    write_image(out, "space", 0.0, Box<3>({2.0, 3.0, 4.0}),
                FieldGrid<3>::over(Box<3>({2.0, 3.0, 4.0}), {2, 3, 4}), {{"v", numbers(3, 24)}});
    BOOST_TEST(Vti(folder / "out/line.vti").extent == "0 3 0 0 0 0");
    BOOST_TEST(Vti(folder / "out/line.vti").components.at("f") == 1);
    BOOST_TEST(Vti(folder / "out/space.vti").extent == "0 1 0 2 0 3");
    BOOST_TEST(Vti(folder / "out/space.vti").arrays.at("v").size() == 72u);
}

BOOST_AUTO_TEST_CASE(a_field_of_another_grid_is_refused) {
    const Scratch folder;
    const RunFolder out(folder / "out", false);
    BOOST_CHECK_THROW(write_image(out, "line", 0.0, Box<1>({2.0}),
                                  FieldGrid<1>::over(Box<1>({2.0}), {4}), {{"f", numbers(1, 5)}}),
                      InputError);
    BOOST_TEST(!std::filesystem::exists(folder / "out/line.vti"));
}
