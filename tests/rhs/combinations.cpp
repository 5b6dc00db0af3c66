// SPDX-License-Identifier: GPL-3.0-or-later
// Every law of matter x every further term x every choice of scheme, with and without externals: each
// combination keeps what it promises, or is refused with a reason; and all of it between walls of every kind. No
// term, no external and no kind of wall is forgotten: the headers are looked at.
#include <spam/core/error.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/external/clamp.hpp>
#include <spam/external/drag.hpp>
#include <spam/external/friction.hpp>
#include <spam/external/gravity.hpp>
#include <spam/external/load.hpp>
#include <spam/external/rigid_velocity.hpp>
#include <spam/external/thermostat.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/density_potentials.hpp>
#include <spam/rhs/own_ranges.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

using namespace spam;

namespace {

const double site_density = 2.0 / std::sqrt(3.0);

/// A model on the way, and how its y begins.
struct Sample {
    /// In a periodic box particles fill it.
    explicit Sample(const Box<2>& box = {})
        : model(box.periodic() ? make_particles<2>(triangular_block(8, 6), 1.0, 1.0, box)
                               : make_particles<2>(triangular_block(8, 5), 1.0),
                box) {}
    ParticleModel<2> model;
    std::function<std::vector<double>(const Points<2>&, const Points<2>&)> fluid{};

    std::vector<double> start() {
        const Points<2>& x = model.particles().reference_position;
        Points<2> v(2, x.cols());
        for (Eigen::Index i = 0; i < x.cols(); ++i) {
            v(0, i) = x(0, i) < 1.2 ? 0.0 : 0.02 * std::sin(0.7 * x(0, i)) - 0.01 * x(1, i);
            v(1, i) = x(0, i) < 1.2 ? 0.0 : 0.01 * x(0, i) + 0.02 * std::cos(0.9 * x(1, i));
        }
        if (fluid) return fluid(x, v);
        auto y = initial_state<2>(model, site_density, 0.43,
                                  [](const Point<2>&) { return Point<2>::Zero().eval(); });
        State<2>(model.layout(), y).velocity() = v;
        return y;
    }
};

using Build = std::function<void(Sample&, const Scheme&)>;

void add_fluid(Sample& s, const Fluid& fluid, const Scheme& scheme) {
    auto& law = s.model.add_term<SmoothParticles<2>>(fluid, scheme);
    s.fluid = [&law](const Points<2>& x, const Points<2>& v) { return law.start(x, v, 0.2); };
}

/// Laws that a scheme belongs to.
const std::map<std::string, Build> with_scheme{
    {"SmoothParticles, solid",
     [](Sample& s, const Scheme& scheme) {
         s.model.add_term<SmoothParticles<2>>(ElasticSolid{0.43, 0.43}, scheme);
     }},
    {"SmoothParticles, gas",
     [](Sample& s, const Scheme& scheme) { add_fluid(s, {IdealGas{}}, scheme); }},
    {"SmoothParticles, fluid with friction and conduction", [](Sample& s, const Scheme& scheme) {
         add_fluid(s, {IdealGas{}, NewtonViscosity{0.1, 0.3}, FourierConduction{0.2}}, scheme);
     }}};

/// Laws that make a body by themselves.
const std::map<std::string, Build> without_scheme{
    {"OwnRanges",
     [](Sample& s, const Scheme&) {
         auto& law = s.model.add_term<OwnRanges<2>>(Fluid{IdealGas{}}, VariableRangeScheme{});
         s.fluid = [&law](const Points<2>& x, const Points<2>& v) { return law.start(x, v, 0.2); };
     }},
    {"DensityPotentialTerm",
     [](Sample& s, const Scheme&) {
         s.model.add_term<DensityPotentialTerm<2>>(
             DensityPotentials{.state = EmbeddedAtom{1.0, site_density}});
     }},
    {"LucyPairPotential",
     [](Sample& s, const Scheme&) { s.model.add_term<LucyPairPotential<2>>(3.0); }},
    {"TotalLagrangian",
     [](Sample& s, const Scheme&) {
         s.model.add_term<TotalLagrangian<2>>(StVenantKirchhoff{0.43, 0.43},
                                              TotalLagrangianScheme{site_density});
     }},
    {"Springs", [](Sample& s, const Scheme&) { s.model.add_term<Springs<2>>(HarmonicSpring{}); }}};

/// What is put on top.
const std::map<std::string, std::function<void(Sample&)>> further{
    {"", [](Sample&) {}},
    {"Core",
     [](Sample& s) {
         s.model.add_term<Core<2>>(CorePotential{0.1, 1.1});
     }},
    {"Springs", [](Sample& s) { s.model.add_term<Springs<2>>(HarmonicSpring{}); }},
    {"LucyPairPotential", [](Sample& s) { s.model.add_term<LucyPairPotential<2>>(2.5); }},
    {"DensityPotentialTerm", [](Sample& s) {
         s.model.add_term<DensityPotentialTerm<2>>(
             DensityPotentials{.surface_tension = 0.02, .kernel = Kernel::w4});
     }}};

const std::map<std::string, std::function<void(ParticleModel<2>&)>> externals{
    {"", [](auto&) {}},
    {"Gravity", [](auto& m) { m.add(std::make_unique<Gravity<2>>(Point<2>(0.003, -0.01))); }},
    {"Friction", [](auto& m) { m.add(std::make_unique<Friction<2>>(0.1)); }},
    {"Drag", [](auto& m) { m.add(std::make_unique<Drag<2>>(0.5, 1.0, Point<2>(0.1, 0.0))); }},
    {"Thermostat", [](auto& m) { m.add(std::make_unique<Thermostat<2>>(1e-3, 0.3)); }},
    {"Load",
     [](auto& m) {
         m.add(std::make_unique<Load<2>>([](double t) { return Point<2>(0.01 * t, 0.02); }));
     }},
    {"Clamp", [](auto& m) {
         m.add(std::make_unique<Clamp<2>>(
             select<2>(m.particles(), [](const Point<2>& x) { return x.x() < 1.2; })));
     }}};

/// Walls of one kind on all sides, outside the body, and further apart than any range.
const std::map<std::string, Wall<2>> walls{
    {"mirror", {WallKind::mirror, 0.0, {0, 0}, {}}},
    {"mirror of a temperature", {WallKind::mirror, 0.0, {0, 0}, 0.3}},
    {"no_slip", {WallKind::no_slip, 0.0, {0, 0}, {}}},
    {"no_slip of a temperature", {WallKind::no_slip, 0.0, {0, 0}, 0.3}},
    {"no_slip that moves", {WallKind::no_slip, 0.0, {0.02, 0.02}, {}}}};

Box<2> walled_by(Wall<2> wall) {
    const Points<2> x = triangular_block(8, 5);
    const Point<2> along = wall.velocity;
    Box<2> box;
    for (int a = 0; a < 2; ++a)
        for (const bool upper : {false, true}) {
            wall.at = upper ? x.row(a).maxCoeff() + 1.5 : x.row(a).minCoeff() - 0.43;
            wall.velocity = along;
            wall.velocity[a] = 0.0;
            box.set_wall(a, upper, wall);
        }
    return box;
}

/// What a combination came to.
struct Row {
    std::string refused{};
    double momentum = 0.0, angular_momentum = 0.0, energy = 0.0;  ///< how fast what is kept changes
    bool turns = false;  ///< the angular momentum is promised
};

/// The derivatives of p - impulse, L - angular impulse and E - work - heat along the rates, as in
/// accounts.cpp, at a state on the way.
Row run(Sample& sample) {
    Row row;
    IntegratorOptions rk4;
    rk4.dt = 0.1;
    Motion<2> motion(sample.model, sample.start(), rk4);
    motion.advance_to(0.2);
    const std::vector<double> y(motion.y().begin(), motion.y().end());
    std::vector<double> y_dot(y.size());
    sample.model.rates(0.2, y, y_dot);
    BOOST_TEST_REQUIRE(sample.model.failure().empty(), sample.model.failure());
    constexpr double h = 1e-3;
    std::vector<Invariants<2>> at;
    for (const double step : {h, -h, 2.0 * h, -2.0 * h}) {
        std::vector<double> z = y;
        for (std::size_t k = 0; k < z.size(); ++k) z[k] += step * y_dot[k];
        at.push_back(measure_invariants<2>(sample.model, z));
    }
    const auto slope = [&](const auto& f) {
        return std::abs((8.0 * (f(at[0]) - f(at[1])) - (f(at[2]) - f(at[3]))) / (12.0 * h));
    };
    row.momentum = std::max(slope([](const auto& i) { return i.momentum_balance()[0]; }),
                            slope([](const auto& i) { return i.momentum_balance()[1]; }));
    row.angular_momentum = slope([](const auto& i) { return i.angular_momentum_balance()[0]; });
    row.energy = slope([](const auto& i) { return i.energy_balance(); });
    row.turns = sample.model.promises().angular_momentum != Promise::not_kept;
    return row;
}

Row combine(const Build& law, const std::function<void(Sample&)>& more, const Scheme& scheme,
            const std::function<void(ParticleModel<2>&)>& external, const Box<2>& box = {}) {
    Sample sample(box);
    try {
        law(sample, scheme);
        more(sample);
        external(sample.model);
        sample.model.events();
    } catch (const InputError& e) {
        return {.refused = e.what()};
    }
    return run(sample);
}

/// A reason is one line that names the option, says what is wrong and what to do.
void judge(const Row& row) {
    if (!row.refused.empty()) {
        BOOST_TEST(row.refused.find('\n') == std::string::npos);
        BOOST_TEST(std::regex_search(row.refused, std::regex("^[a-z-]+: .{30,}[;,] ")),
                   row.refused);
        return;
    }
    BOOST_TEST(row.momentum < 1e-10);
    BOOST_TEST(row.energy < 1e-8);
    if (row.turns) BOOST_TEST(row.angular_momentum < 1e-9);
}

template <class F>
void for_each_scheme(const F& f) {
    for (const auto density : {Density::continuity, Density::summed, Density::chain_rule})
        for (const auto transport :
             {Transport::plain, Transport::average, Transport::monaghan, Transport::shifting})
            for (const auto angular_momentum :
                 {AngularMomentum::free, AngularMomentum::gauss, AngularMomentum::torque_particle,
                  AngularMomentum::torque_pair})
                for (const double viscosity : {0.0, 1.0})
                    for (const double closest : {0.0, 0.5})
                        f(Scheme{.density = density,
                                 .transport = transport,
                                 .angular_momentum = angular_momentum,
                                 .viscosity = viscosity,
                                 .closest_approach = closest});
}

std::set<std::string> classes_derived_from(const std::string& base, const std::string& room) {
    std::set<std::string> names;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(SPAM_SOURCE) / room)) {
        std::ifstream in(entry.path());
        std::stringstream text;
        text << in.rdbuf();
        const std::string source = text.str();
        const std::regex derived("class (\\w+) (?:final )?: public " + base + "<Dim>");
        for (std::sregex_iterator it(source.begin(), source.end(), derived), end; it != end; ++it)
            names.insert((*it)[1]);
    }
    return names;
}

}  // namespace

BOOST_AUTO_TEST_CASE(no_term_and_no_external_is_left_out) {
    std::set<std::string> terms, outside;
    for (const auto* laws : {&with_scheme, &without_scheme})
        for (const auto& [name, build] : *laws) terms.insert(name.substr(0, name.find(',')));
    for (const auto& [name, build] : further) terms.insert(name);
    for (const auto& [name, add] : externals) outside.insert(name);
    auto all_terms = classes_derived_from("Term", "include/spam/rhs");
    all_terms.merge(classes_derived_from("PairTerm", "include/spam/rhs"));
    all_terms.erase("PairTerm");  // what they have in common
    const auto all_externals = classes_derived_from("External", "include/spam/external");
    BOOST_TEST(all_terms.size() >= 7u);
    BOOST_TEST(all_externals.size() >= 6u);
    for (const auto& name : all_terms) BOOST_TEST(terms.contains(name), name);
    for (const auto& name : all_externals)
        BOOST_TEST((outside.contains(name) || name == "RigidVelocity"), name);
}

BOOST_AUTO_TEST_CASE(every_scheme_with_every_further_term_keeps_its_promises_or_is_refused) {
    const auto all_at_once = [](ParticleModel<2>& m) {
        for (const char* name : {"Gravity", "Friction", "Drag"}) externals.at(name)(m);
    };
    int ran = 0, refused = 0, not_turning = 0;
    for (const auto& law : with_scheme)
        for (const auto& more : further)
            for_each_scheme([&](const Scheme& scheme) {
                for (const bool outside : {false, true})
                    BOOST_TEST_CONTEXT(law.first << " + " << more.first << ", " << scheme.describe()
                                                 << (outside ? ", externals" : "")) {
                        const Row row = combine(law.second, more.second, scheme,
                                                outside ? all_at_once : externals.at(""));
                        judge(row);
                        ++(row.refused.empty() ? ran : refused);
                        not_turning += row.refused.empty() && !row.turns;
                    }
            });
    BOOST_TEST_MESSAGE(ran << " combinations run, " << not_turning
                           << " of them without a promise for L; " << refused << " are refused");
    BOOST_TEST(ran > 700);
    BOOST_TEST(refused > 700);
}

BOOST_AUTO_TEST_CASE(every_law_with_every_further_term_and_every_external) {
    int ran = 0;
    for (const auto* laws : {&with_scheme, &without_scheme})
        for (const auto& [law, build] : *laws)
            for (const auto& [more, add] : further)
                for (const auto& [external, act] : externals)
                    BOOST_TEST_CONTEXT(law << " + " << more << ", " << external) {
                        const Row row = combine(build, add, Scheme{}, act);
                        judge(row);
                        BOOST_TEST(row.refused.empty(), row.refused);
                        ++ran;
                    }
    BOOST_TEST(ran == 8 * 5 * 7);
}

BOOST_AUTO_TEST_CASE(no_kind_of_wall_is_left_out) {
    std::ifstream in(std::filesystem::path(SPAM_SOURCE) / "include/spam/neighbors/wall.hpp");
    std::stringstream text;
    text << in.rdbuf();
    const std::string source = text.str(), begin = "enum class WallKind {";
    const auto from = source.find(begin) + begin.size();
    const std::string kinds = source.substr(from, source.find('}', from) - from);
    const std::regex name("\\n\\s+(\\w+),");
    int found = 0;
    for (std::sregex_iterator it(kinds.begin(), kinds.end(), name), end; it != end; ++it, ++found)
        BOOST_TEST(((*it)[1] == "open" || walls.contains((*it)[1])), (*it)[1]);
    BOOST_TEST(found >= 3);
}

BOOST_AUTO_TEST_CASE(every_kind_of_wall_with_every_law_is_accounted_for_or_refused) {
    int ran = 0, refused = 0;
    const auto count = [&](const Row& row) {
        judge(row);
        ++(row.refused.empty() ? ran : refused);
    };
    const auto gravity = externals.at("Gravity"), nothing = externals.at("");
    for (const auto& [kind, wall] : walls) {
        const Box<2> box = walled_by(wall);
        for (const auto& [law, build] : with_scheme)
            for_each_scheme([&](const Scheme& scheme) {
                BOOST_TEST_CONTEXT(kind << ": " << law << ", " << scheme.describe())
                count(combine(build, further.at(""), scheme, gravity, box));
            });
        for (const auto* laws : {&with_scheme, &without_scheme})
            for (const auto& [law, build] : *laws)
                for (const auto& [more, add] : further)
                    BOOST_TEST_CONTEXT(kind << ": " << law << " + " << more)
        count(combine(build, add, Scheme{}, nothing, box));
    }
    BOOST_TEST_MESSAGE(ran << " combinations with walls run, " << refused << " are refused");
    BOOST_TEST(ran > 200);
    BOOST_TEST(refused > 200);
}

/// Shifting is refused above, in open space. Here fluids fill a periodic box.
BOOST_AUTO_TEST_CASE(shifted_fluids_with_every_external) {
    Fluid rubbing{EmbeddedAtom{1.0, site_density}, NewtonViscosity{0.1, 0.3}};
    const Fluid smooth = rubbing, cold{rubbing.state};
    rubbing.by_pairs = true;
    const Box<2> box = triangular_box(8, 6);
    int ran = 0, refused = 0;
    for (const Fluid& fluid : {cold, smooth, rubbing})
        for (const auto& external : externals)
            for_each_scheme([&](const Scheme& scheme) {
                if (scheme.transport != Transport::shifting) return;
                BOOST_TEST_CONTEXT(fluid.describe()
                                   << " + " << external.first << ", " << scheme.describe()) {
                    const Build full = [&](Sample& s, const Scheme& given) {
                        add_fluid(s, fluid, given);
                    };
                    const Row row = combine(full, further.at(""), scheme, external.second, box);
                    judge(row);
                    BOOST_TEST(!row.turns);
                    ++(row.refused.empty() ? ran : refused);
                }
            });
    // Continuity or summed, with artificial viscosity where friction is not by pairs.
    BOOST_TEST(ran == 7 * 2 * (2 + 2 + 1));
    BOOST_TEST(refused == 7 * 3 * 3 * 4 * 2 * 2 - ran);
}

/// What the text forbids, by name.
BOOST_AUTO_TEST_CASE(potentials_of_positions_need_plain_velocities) {
    const Scheme averaged{.transport = Transport::monaghan};
    for (const auto& [more, add] : further) {
        if (more.empty()) continue;
        const Row row =
            combine(with_scheme.at("SmoothParticles, solid"), add, averaged, externals.at(""));
        BOOST_TEST(row.refused.find("averaged velocity") != std::string::npos, more);
    }
    const Scheme summed{.density = Density::summed, .transport = Transport::monaghan};
    const Row row =
        combine(with_scheme.at("SmoothParticles, gas"), further.at(""), summed, externals.at(""));
    BOOST_TEST(row.refused.find("gains energy without limit") != std::string::npos);
}
