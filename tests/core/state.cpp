// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/nvector.hpp>
#include <spam/core/state.hpp>
#include <spam/core/text.hpp>

#include <boost/test/unit_test.hpp>

#include <numeric>

using namespace spam;

BOOST_AUTO_TEST_CASE(blocks_follow_each_other) {
    const FieldLayout<2> layout(5,
                                {Field::energy, Field::position, Field::stress, Field::velocity});
    BOOST_TEST(layout.size() == 5U * (2 + 2 + 3 + 1));
    BOOST_TEST(!layout.has(Field::density));
    BOOST_TEST(layout.find(Field::position)->offset == 0U);
    BOOST_TEST(layout.find(Field::velocity)->offset == 10U);
    BOOST_TEST(layout.find(Field::stress)->offset == 20U);
    BOOST_TEST(layout.find(Field::energy)->offset == 35U);
    const auto entry = layout.entry(20 + 3 * 2 + 1);
    BOOST_TEST((entry.field == Field::stress));
    BOOST_TEST(entry.number == 2U);
    BOOST_TEST(entry.component == 1U);
    BOOST_TEST(FieldLayout<3>(7, {Field::stress}).size() == 42U);
    BOOST_TEST(FieldLayout<1>(7, {Field::stress, Field::position}).size() == 14U);
}

BOOST_AUTO_TEST_CASE(views_see_the_vector) {
    const FieldLayout<3> layout(4,
                                {Field::position, Field::velocity, Field::density, Field::stress});
    const SundialsContext context;
    Vector y(layout.size(), context);
    std::iota(y.span().begin(), y.span().end(), 0.0);
    const State<3> state(layout, y.span());
    BOOST_TEST(state.position()(1, 2) == 7.0);
    BOOST_TEST(state.velocity()(0, 0) == 12.0);
    BOOST_TEST(state.density()(0, 3) == 27.0);
    BOOST_TEST(state.stress()(5, 1) == 28.0 + 6.0 + 5.0);
    state.velocity()(2, 3) = -1.0;
    BOOST_TEST(y.span()[23] == -1.0);
}

BOOST_AUTO_TEST_CASE(vectors_own_what_they_hold) {
    const SundialsContext context;
    Vector a(3, context);
    a.span()[0] = 7.0;
    Vector b = a.clone();
    BOOST_TEST(b.size() == 3U);
    BOOST_TEST(b.get() != a.get());
    Vector c = std::move(a);
    BOOST_TEST(c.span()[0] == 7.0);
    BOOST_TEST(a.get() == nullptr);
}

BOOST_AUTO_TEST_CASE(symmetric_tensors) {
    for (const int dim : {1, 2, 3}) {
        std::vector<bool> seen(static_cast<std::size_t>(symmetric_size(dim)), false);
        for (int a = 0; a < dim; ++a)
            for (int b = a; b < dim; ++b) {
                BOOST_TEST(symmetric_index(dim, a, b) == symmetric_index(dim, b, a));
                seen[static_cast<std::size_t>(symmetric_index(dim, a, b))] = true;
            }
        for (const bool s : seen) BOOST_TEST(s);
    }
    SymTensor<3> t;  // xx yy zz xy yz xz, the order of VTK
    t.c = {1, 2, 3, 4, 5, 6};
    BOOST_TEST(t(0, 1) == 4);
    BOOST_TEST(t(2, 1) == 5);
    BOOST_TEST(t(0, 2) == 6);
    const auto v = t * Vec<3>{{1.0, 10.0, 100.0}};
    BOOST_TEST(v[0] == 1 + 40 + 600);
    BOOST_TEST(v[1] == 4 + 20 + 500);
    BOOST_TEST(v[2] == 6 + 50 + 300);
}

BOOST_AUTO_TEST_CASE(positive_part_is_exact) {
    for (const double x : {0.0, 1e-300, 0.1, 3.0, 1e300}) {
        BOOST_TEST(positive_part(x) == x);
        BOOST_TEST(positive_part(-x) == 0.0);
    }
}

BOOST_AUTO_TEST_CASE(nearest_words) {
    const std::vector<std::string> words{"range", "rtol", "transport"};
    BOOST_TEST(nearest("rnage", words) == "range");
    BOOST_TEST(nearest("Transprt", words) == "transport");
    BOOST_TEST(nearest("port", words) == "transport");
    BOOST_TEST(nearest("restart", words).empty());
    BOOST_TEST(nearest("x", {}).empty());
    BOOST_TEST(suggestion("rnage", words, "--") == "; did you mean --range?");
    BOOST_TEST(suggestion("nothing like it", words) == ".");
}
