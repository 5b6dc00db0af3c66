// SPDX-License-Identifier: GPL-3.0-or-later
// Names of units: made of three, as fields say what they are made of.
#include <spam/core/field.hpp>
#include <spam/core/unit_names.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;

namespace {

const UnitNames bar{.length = "mm", .mass = "g", .time = "µs", .stress = "TPa", .energy = "kJ"};
const UnitNames plate{
    .length = "m", .mass = "kg", .time = "s", .stress = "Pa", .of_unit_thickness = true};

std::string of(const UnitNames& units, Field field, int dim) { return units.of(field.unit(), dim); }

}  // namespace

BOOST_AUTO_TEST_CASE(names_of_fields) {
    BOOST_TEST(of(bar, Field::position, 3) == "mm");
    BOOST_TEST(of(bar, Field::velocity, 3) == "mm/µs");
    BOOST_TEST(of(bar, Field::density, 3) == "g/mm³");
    BOOST_TEST(of(bar, Field::density, 1) == "g/mm");
    BOOST_TEST(of(bar, Field::stress, 3) == "TPa");
    BOOST_TEST(of(bar, Field::stress, 2) == "g/µs²");
    BOOST_TEST(of(bar, Field::energy, 3) == "mm²/µs²");  // by mass
    BOOST_TEST(of(bar, Field::work, 3) == "kJ");
    BOOST_TEST(of(bar, Field::angular_impulse, 3) == "g mm²/µs");
    BOOST_TEST(bar.of("1", 3) == "");
    BOOST_TEST(bar.of("t", 3) == "µs");
    BOOST_TEST(bar.of("m/l^D", 2) == "g/mm²");
    UnitNames plain = bar;
    plain.stress = plain.energy = "";
    BOOST_TEST(of(plain, Field::stress, 3) == "g/(mm µs²)");
}

/// What is a mass by thickness in the plane has the units that it has in space.
BOOST_AUTO_TEST_CASE(a_plate_of_unit_thickness) {
    BOOST_TEST(of(plate, Field::density, 2) == "kg/m³");
    BOOST_TEST(of(plate, Field::stress, 2) == "Pa");
    BOOST_TEST(plate.of("m", 2) == "kg/m");
    BOOST_TEST(of(plate, Field::velocity, 2) == "m/s");
    BOOST_TEST(plate.describe() == "m, kg (of a thickness of 1 m), s; stress Pa, speed m/s");
}

BOOST_AUTO_TEST_CASE(units_without_names) {
    const UnitNames reduced = reduced_units("the mass of a particle");
    BOOST_TEST(of(reduced, Field::stress, 2) == "");
    BOOST_TEST(reduced.axis("t", "t", 2) == "t");
    BOOST_TEST(bar.axis("t", "t", 3) == "t, µs");
    BOOST_TEST(reduced.describe() == "reduced: 1 is the mass of a particle");
    BOOST_TEST(!UnitNames{}.declared());
    BOOST_TEST(reduced.declared());
    BOOST_TEST(reduced.table(2).empty());
}
