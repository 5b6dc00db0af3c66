// SPDX-License-Identifier: GPL-3.0-or-later
// Any model cut into parts gives the bytes of the whole, and remembers the same: laws with schemes, walls, externals,
// periods, a fixed and an adaptive method; particles move between parts.
#include "rhs/more_laws.hpp"
#include "rhs/walled.hpp"
#include "support/effort.hpp"
#include "support/parts_in_threads.hpp"
#include "support/refusal.hpp"
#include <spam/core/parted_state.hpp>
#include <spam/material/flowing_solid.hpp>

#include <cstring>
#include <mutex>
#include <numeric>

using namespace spam;
using namespace spam::test;

struct Counts {
    int ran = 0, refused = 0;
};

namespace {

using PartsIn = std::tuple<std::integral_constant<int, SPAM_PARTS_IN>>;
constexpr int segments = 3, steps_in_each = 5;

/// Strips across x, then across y, then ...; one in 13 goes to another part, far from its neighbours.
template <int Dim>
std::vector<std::uint32_t> own_numbers(std::size_t count, std::size_t own, int segment,
                                       const Points<Dim>& x) {
    std::vector<std::uint32_t> order(static_cast<std::size_t>(x.cols())), numbers;
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
        return std::pair(x(segment % Dim, i), i) < std::pair(x(segment % Dim, j), j);
    });
    for (std::size_t k = 0; k < order.size(); ++k) {
        std::size_t part = k * count / order.size();
        if (order[k] % 13 == static_cast<std::uint32_t>(segment)) part = (part + 1) % count;
        if (part == own) numbers.push_back(order[k]);
    }
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

/// Of the whole.
struct Reached {
    std::vector<double> y;
    std::vector<std::byte> memory;  ///< of laws, beyond y
};

/// `memory` is read, unless it is empty, and written.
template <int Dim>
std::vector<double> moved(Sample<Dim>& sample, const std::vector<double>& y0,
                          const IntegratorOptions& options, std::vector<std::byte>& memory) {
    if (Archive before(memory); !memory.empty()) sample.model.remember(before);
    Motion<Dim> motion(sample.model, y0, options);
    for (int step = 0; step < steps_in_each; ++step) motion.step(1.0);
    Archive now;
    sample.model.remember(now);
    memory = now.take();
    return {motion.y().begin(), motion.y().end()};
}

template <int Dim>
Reached whole(const Add<Dim>& make, const Box<Dim>& box, const IntegratorOptions& options) {
    Reached all;
    for (int segment = 0; segment < segments; ++segment) {
        Sample<Dim> sample(box);
        make(sample);
        sample.model.events();
        const std::vector<double> start = sample.start();  // it tells scales as well
        all.y = moved(sample, segment == 0 ? start : all.y, options, all.memory);
    }
    return all;
}

template <int Dim>
Reached in_parts(std::size_t count, const Add<Dim>& make, const Box<Dim>& box,
                 const IntegratorOptions& options, Wrong wrong = Wrong::nothing) {
    Sample<Dim> all_of_it(box);
    make(all_of_it);
    const Points<Dim> X = all_of_it.model.particles().reference_position;
    const FieldLayout<Dim>& layout = all_of_it.model.layout();
    Reached result;
    const auto work = [&] {
        Parts& parts = Parts::here();
        Reached all;
        Points<Dim> x = X;
        for (int segment = 0; segment < segments; ++segment) {
            parts.set_numbers(own_numbers(count, parts.own(), segment, x));
            Sample<Dim> sample(box);
            make(sample);
            sample.model.events();
            std::vector<double> y = sample.start();
            if (segment > 0) y = own_state<Dim>(parts, layout, all.y);
            y = moved(sample, y, options, all.memory);
            all.y.resize(layout.size());
            whole_state<Dim>(parts, sample.model.layout(), y, all.y);
            x = Eigen::Map<const Points<Dim>>(all.y.data(), Dim, X.cols());
        }
        if (parts.own() == 0) result = all;
    };
    PartsInThreads::run(count, work, wrong);
    return result;
}

template <class Value>
std::size_t different(const std::vector<Value>& a, const std::vector<Value>& b) {
    if (a.size() != b.size()) return std::max(a.size(), b.size());
    std::size_t different = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
        different += std::memcmp(&a[k], &b[k], sizeof(Value)) != 0 ? 1 : 0;
    return different;
}
std::size_t different_bytes(const Reached& a, const Reached& b) {
    return different(a.y, b.y) + different(a.memory, b.memory);
}

const IntegratorOptions fixed{.method = "rk4", .dt = 0.05};
const IntegratorOptions adaptive{
    .method = "arkode:BOGACKI_SHAMPINE_4_2_3", .dt = {}, .rtol = 1e-7, .atol = 1e-9};

/// Refused as a whole, or the same bytes in 2 to 4 parts; where parts refuse it they say why.
template <int Dim>
void compare(const Add<Dim>& make, const Box<Dim>& box, const IntegratorOptions& options,
             Counts& counts, std::size_t most = 4) {
    Reached right;
    try {
        right = whole<Dim>(make, box, options);
    } catch (const InputError&) {
        return;
    } catch (const GuardStop& stop) {
        BOOST_TEST_MESSAGE("whole: " << stop.what());
        return;
    }
    if (Dim == 3) most = 2;  // more of them only wait for each other
    for (std::size_t count = 2; count <= most; ++count) {
        Reached found;
        try {
            found = in_parts<Dim>(count, make, box, options);
        } catch (const InputError& refused) {
            BOOST_TEST(std::string(refused.what()).find("--ranks") != std::string::npos,
                       refused.what());
            ++counts.refused;
            return;
        }
        BOOST_TEST(different_bytes(found, right) == 0U, count << " parts");
    }
    ++counts.ran;
}

/// Every law that needs no scheme, and every law that needs one, in the default; those with a further one that are due.
template <int Dim, class F>
void for_each_law(Spread& due, const F& f) {
    for (const auto& [law, build] : all_laws<Dim>())
        for (const auto& [more, add] : further<Dim>())
            if (more.empty() || due.next())
                f(law + (more.empty() ? "" : " + " + more),
                  [&law_of = build, &more_of = add](Sample<Dim>& s) {
                      law_of(s, Scheme{});
                      more_of(s);
                  });
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(every_law_between_every_kind_of_walls, In, PartsIn) {
    constexpr int Dim = In::value;
    Counts counts;
    Spread due(4, 12);
    for (const auto& [kind, wall] : walls<Dim>)
        for_each_law<Dim>(due, [&, name = kind, box = walled_by(wall)](const std::string& law,
                                                                       const Add<Dim>& make) {
            BOOST_TEST_CONTEXT(name << ": " << law) {
                compare<Dim>(make, box, fixed, counts, law.find('+') == std::string::npos ? 4 : 2);
            }
        });
    BOOST_TEST_MESSAGE(counts.ran << " laws between walls have the bytes of the whole, "
                                  << counts.refused << " cannot be parted");
    BOOST_TEST(counts.ran > effort(85, 60));
    BOOST_TEST(counts.refused < 30);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(
    every_law_in_open_and_periodic_space_with_a_fixed_and_an_adaptive_method, In, PartsIn) {
    constexpr int Dim = In::value;
    Counts counts;
    Spread due(3, 12);
    for (const auto& box : {Box<Dim>(), full_box<Dim>()})
        for (const auto* options : {&fixed, &adaptive})
            for_each_law<Dim>(due, [&](const std::string& law, const Add<Dim>& make) {
                BOOST_TEST_CONTEXT(law << (box.periodic() ? ", periodic, " : ", ")
                                       << options->method) {
                    compare<Dim>(make, box, *options, counts, options == &fixed ? 4 : 3);
                }
            });
    BOOST_TEST_MESSAGE(counts.ran << " have the bytes of the whole, " << counts.refused
                                  << " cannot be parted");
    BOOST_TEST(counts.ran > effort(150, 60));
    BOOST_TEST(counts.refused < 60);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(every_scheme, In, PartsIn) {
    constexpr int Dim = In::value;
    Counts counts;
    Spread due(4, 16);
    for (const auto& box : {Box<Dim>(), full_box<Dim>()})
        for (const auto& [law, build] : with_scheme<Dim>())
            for_each_scheme([&, name = law, &of = build](const Scheme& scheme) {
                if ((Dim == 3 && box.periodic()) || !due.next()) return;
                BOOST_TEST_CONTEXT(name << (box.periodic() ? ", periodic, " : ", ")
                                        << scheme.describe()) {
                    compare<Dim>([&](Sample<Dim>& s) { of(s, scheme); }, box, fixed, counts, 2);
                }
            });
    BOOST_TEST_MESSAGE(counts.ran << " schemes have the bytes of the whole");
    BOOST_TEST(counts.ran > effort(100, 20));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(every_external, In, PartsIn) {
    constexpr int Dim = In::value;
    Counts counts;
    for (const auto& [external, add] : externals<Dim>()) BOOST_TEST_CONTEXT(external) {
            for (const auto* options : {&fixed, &adaptive})
                compare<Dim>(
                    [&, &more = add](Sample<Dim>& s) {
                        with_scheme<Dim>().at("SmoothParticles, solid")(s, Scheme{});
                        more(s);
                    },
                    walled_by(walls<Dim>.at("rigid")), *options, counts, 3);
        }
    BOOST_TEST(counts.ran == 2 * static_cast<int>(externals<Dim>().size()));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(forces_of_any_range_reactions_and_ellipses, In, PartsIn) {
    constexpr int Dim = In::value;
    Counts counts;
    for (const char* law : {"LongRange in a gas", "Reaction in a gas", "Ellipses"})
        for (const auto* options : {&fixed, &adaptive}) BOOST_TEST_CONTEXT(law) {
                compare<Dim>([&](Sample<Dim>& s) { more_laws<Dim>().at(law)(s, Scheme{}); }, {},
                             *options, counts, 3);
            }
    BOOST_TEST(counts.ran == 6);
}

/// So fast that neighbours come and go, solids flow, and bonds break. A periodic box is wider than 2.2 ranges.
template <int Dim>
Add<Dim> fast(bool breaks, bool periodic = false) {
    return [=](Sample<Dim>& s) {
        s.speed = 40.0;
        MaterialVectorScheme scheme{s.density(), !periodic ? 2.5 : Dim == 2 ? 2.2 : 1.25};
        if (!breaks) {
            add_term<MaterialVectors<Dim>>(s, elastic<PolynomialSolid>(s), scheme);
            return;
        }
        scheme.bond_yield = 3.0;
        scheme.stretch_limit = 1.3;
        scheme.stress_limit = 0.05;
        add_term<MaterialVectors<Dim>>(s, FlowingSolid{elastic<PolynomialSolid>(s), 0.05, 0.1},
                                       scheme);
    };
}
const IntegratorOptions long_steps{.method = "rk4", .dt = 0.1};

BOOST_AUTO_TEST_CASE_TEMPLATE(solids_that_meet_new_neighbours_flow_and_break, In, PartsIn) {
    constexpr int Dim = In::value;
    Counts counts;
    for (const bool breaks : {false, true})
        for (const auto& box : {Box<Dim>(), full_box<Dim>()})
            BOOST_TEST_CONTEXT((breaks ? "flows and breaks" : "elastic")
                               << (box.periodic() ? ", periodic" : "")) {
                compare<Dim>(fast<Dim>(breaks, box.periodic()), box, long_steps, counts);
            }
    BOOST_TEST(counts.ran == 4);
    // Not only what rows were at the start travels.
    Sample<Dim> sample;
    fast<Dim>(true)(sample);
    Motion<Dim> motion(sample.model, sample.start(), long_steps);
    const auto& law = *sample.model.template term<MaterialVectors<Dim>>();
    const std::size_t builds = law.counts().list_builds;
    motion.advance_to(segments * steps_in_each * *long_steps.dt);
    BOOST_TEST(law.counts().list_builds > builds + 3);
    BOOST_TEST_MESSAGE(law.breaks().pairs << " pairs break, heat " << law.heat());
    BOOST_TEST(law.breaks().pairs > 3U);
    BOOST_TEST(law.heat() > 0.0);
}

// The test can fail: images that are not refreshed, sums of parts that are rounded before they are added, neighbours of
// other parts that are added after one's own, and a part that returns a reason before an exchange that others make.
BOOST_AUTO_TEST_CASE_TEMPLATE(what_is_left_out_is_seen, In, PartsIn) {
    constexpr int Dim = In::value;
    Scheme balanced;
    balanced.angular_momentum = AngularMomentum::torque_pair;
    const Add<Dim> make = [&](Sample<Dim>& s) {
        with_scheme<Dim>().at("SmoothParticles, solid")(s, balanced);
    };
    const auto right = whole<Dim>(make, {}, fixed);
    BOOST_TEST(different_bytes(in_parts<Dim>(3, make, {}, fixed), right) == 0U);
    for (const auto wrong : {Wrong::images, Wrong::sums, Wrong::order, Wrong::calls}) {
        Reached found;
        try {
            found = in_parts<Dim>(3, make, {}, fixed, wrong);
        } catch (const GuardStop&) {  // it has none of the bytes
        } catch (const std::logic_error& met) {
            BOOST_TEST((wrong == Wrong::calls), met.what());
        } catch (const InputError& met) {  // what is remembered travels as places of images do
            BOOST_TEST((wrong == Wrong::calls || wrong == Wrong::order), met.what());
        }
        BOOST_TEST(different_bytes(found, right) > 0U);
    }
}

// Likewise for material vectors: what bonds give to particles in other parts is not new.
BOOST_AUTO_TEST_CASE_TEMPLATE(what_is_left_out_of_bonds_is_seen, In, PartsIn) {
    constexpr int Dim = In::value;
    const auto make = fast<Dim>(false);
    const auto right = whole<Dim>(make, {}, long_steps);
    BOOST_TEST(different_bytes(in_parts<Dim>(2, make, {}, long_steps), right) == 0U);
    Reached found;
    try {
        found = in_parts<Dim>(2, make, {}, long_steps, Wrong::images);
    } catch (const GuardStop&) {         // it has none of the bytes
    } catch (const std::logic_error&) {  // nor here, where other pairs are bonded in either part
    }
    BOOST_TEST(different_bytes(found, right) > 0U);
}

// A state without meaning in one part ends the right-hand sides of all, with its reason.
BOOST_AUTO_TEST_CASE(all_parts_hear_of_a_state_without_meaning) {
    const Points<2> X = Sample<2>().model.particles().reference_position;
    std::mutex one;
    std::vector<std::string> reasons;
    PartsInThreads::run(3, [&] {
        Parts& parts = Parts::here();
        parts.set_numbers(own_numbers(3, parts.own(), 0, X));
        Sample<2> sample;
        with_scheme<2>().at("SmoothParticles, gas")(sample, Scheme{.density = Density::continuity});
        std::vector<double> y = sample.start(), y_dot(y.size());
        sample.model.rates(0.0, y, y_dot);
        const std::string before = sample.model.failure();
        State<2>(sample.model.layout(), y).density()(0, 0) = parts.own() == 1 ? -1.0 : 1.0;
        sample.model.rates(0.0, y, y_dot);
        const std::lock_guard lock(one);
        reasons.push_back(before + sample.model.failure());
    });
    BOOST_TEST_REQUIRE(reasons.size() == 3U);
    for (const auto& reason : reasons)
        BOOST_TEST(reason.find("is not positive") != std::string::npos, reason);
}
