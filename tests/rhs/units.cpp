// SPDX-License-Identifier: GPL-3.0-or-later
// Every law of the library in other units of mass, length and time: the same run, bit for bit with powers of two, with
// fixed steps and adaptive ones. No number of a law, a limit, a tolerance or an estimate has a unit.
#include "rhs/more_laws.hpp"
#include "rhs/walled.hpp"
#include "support/effort.hpp"
#include <spam/integrate/methods.hpp>
#include <spam/material/gamma_gas.hpp>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

using namespace spam;
using namespace spam::test;

namespace {
using UnitsIn = std::tuple<std::integral_constant<int, SPAM_UNITS_IN>>;

/// The first two are powers of two, those of mass and length even: roots are taken of densities and of moduli.
const std::vector<Units> units{
    {64.0, 0.0625, 128.0}, {0x1p-10, 0x1p20, 0x1p-40}, {7.0, 3.0, 2.0}, {1e-3, 1e6, 1e3}};
bool powers_of_two(const Units& u) { return &u < &units[2]; }

/// What is put together, in units in which spacing and mass are 1.
template <int Dim>
struct Setting {
    Build<Dim> law;
    Scheme scheme{};
    std::string more{}, external{};
    std::function<Box<Dim>(const Units&)> box = [](const Units&) { return Box<Dim>(); };
    double speed = 1.0, end = 0.2;
    std::function<void(Sample<Dim>&, std::vector<double>& y)> mutate{};
};

/// A run, and what is said of it.
template <int Dim>
struct Course {
    std::string refused{}, stopped{};
    std::vector<double> y{};
    FieldLayout<Dim> layout{0, {}};
    Integrator::Statistics steps{};
    double damping = 0.0, forces = 0.0, reach = 0.0;
    Promises promises{};
    /// Whether rounding has a say in adaptive steps, by far more than its own size: errors are differences, and
    /// where some steps are rejected or rates jump, others may be.
    bool by_rounding = false;
    bool cube_roots = false;  ///< which are not the same bits for other powers of two
};

IntegratorOptions fixed(const Units& u) {
    IntegratorOptions options;
    options.dt = 0.1 * u.time;
    return options;
}
IntegratorOptions adaptive(const Units&) {
    IntegratorOptions options;
    options.method = "arkode:DORMAND_PRINCE_7_4_5";
    options.rtol = 1e-6;
    return options;
}
using Options = std::function<IntegratorOptions(const Units&)>;

template <int Dim>
Course<Dim> course_of(const Setting<Dim>& setting, const Units& u, const Options& options) {
    Course<Dim> course;
    Sample<Dim> sample(setting.box(u), u);
    sample.speed = setting.speed;
    try {
        setting.law(sample, sample.scheme(setting.scheme));
        further<Dim>().at(setting.more)(sample);
        externals<Dim>().at(setting.external)(sample);
        auto y = sample.start();
        if (setting.mutate) setting.mutate(sample, y);
        course.layout = sample.model.layout();
        course.damping = sample.model.fastest_damping(y);
        course.promises = sample.model.promises();
        course.reach = sample.model.reach();
        course.cube_roots = Dim == 3 && sample.model.describe().find("^(1/D)") != std::string::npos;
        Motion<Dim> motion(sample.model, y, options(u));
        try {
            motion.advance_to(setting.end * u.time);
        } catch (const GuardStop& stop) {
            course.stopped = stop.what();
        }
        course.y.assign(motion.y().begin(), motion.y().end());
        course.steps = motion.integrator().statistics();
        course.by_rounding = course.steps.rejected_steps > 0 || !sample.model.smooth();
        course.forces = sample.model.neighbour_forces(course.y);
    } catch (const InputError& e) {
        course.refused = e.what();
    }
    return course;
}

/// How far `in_others` is from `course`, given in these units: the largest difference of a number of y or of what is
/// said of it, in parts of the largest of its field, or of what rounding may leave.
template <int Dim>
double difference(const Course<Dim>& course, const Course<Dim>& in_others, const Units& u) {
    constexpr double least = 1e-5;
    double worst = 0.0;
    const auto compare = [&](double a, double b, double unit, double size) {
        const double off = std::abs(b / unit - a) / std::max(size, least);
        if (!(off <= worst)) worst = off;  // NaN stays
    };
    compare(course.damping, in_others.damping, 1.0 / u.time, course.damping);
    compare(course.forces, in_others.forces, u.of("m l/t^2", Dim), course.forces);
    compare(course.reach, in_others.reach, u.length, course.reach);
    for (const auto& block : course.layout.blocks()) {
        const double unit = u.of(block.field.unit(), Dim);
        compare(block.scale, in_others.layout.find(block.field, block.holder)->scale, unit,
                block.scale);
        double size = 0.0;
        for (std::size_t k = block.offset; k < block.offset + block.size; ++k)
            size = std::max(size, std::abs(course.y[k]));
        for (std::size_t k = block.offset; k < block.offset + block.size; ++k)
            compare(course.y[k], in_others.y[k], unit, size);
    }
    return worst;
}

/// A sentence without its numbers.
std::string words_of(const std::string& text) {
    return std::regex_replace(text, std::regex("[-+]?[0-9.]+(e[-+]?[0-9]+)?"), "#");
}

struct Found {
    bool ran = false;
    double worst = 0.0;
};

/// Checks `setting` in all units, where these are powers of two to the bit. Returns whether it ran, and the largest
/// difference.
template <int Dim>
Found check(const Setting<Dim>& setting, const Options& options = fixed) {
    const Course<Dim> course = course_of(setting, {}, options);
    Found found{course.refused.empty()};
    for (const Units& u : units) {
        const Course<Dim> other = course_of(setting, u, options);
        BOOST_TEST_CONTEXT("units " << u.mass << ", " << u.length << ", " << u.time) {
            BOOST_TEST(words_of(other.refused) == words_of(course.refused));
            BOOST_TEST(words_of(other.stopped) == words_of(course.stopped));
            if (!course.refused.empty() || !other.refused.empty()) continue;
            BOOST_TEST((other.promises.angular_momentum == course.promises.angular_momentum &&
                        other.promises.energy == course.promises.energy));
            const bool same_steps = powers_of_two(u) || options(u).dt || !course.by_rounding;
            if (same_steps) {
                BOOST_TEST(other.steps.steps == course.steps.steps);
                BOOST_TEST(other.steps.rejected_steps == course.steps.rejected_steps);
                BOOST_TEST(other.steps.events == course.steps.events);
            }
            const double off = difference(course, other, u);
            BOOST_TEST(off <= (powers_of_two(u) && !course.cube_roots ? 0.0
                               : options(u).dt                        ? 1e-9
                               : same_steps                           ? 1e-7
                                                                      : 1e-4));
            found.worst = std::max(found.worst, off);
        }
    }
    return found;
}

std::string text_of(const std::filesystem::path& file) {
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

/// What the headers of laws declare that `describe()`s itself, by name; without what laws have in common.
std::set<std::string> names_of_laws() {
    const std::set<std::string> common{
        "AnyEquationOfState", "Fluid",          "HyperelasticMaterial",
        "Material",           "Failure",        "FlowState",
        "LogarithmicStrain",  "ReturnedStress", "PlaneStressMultiplier",
        "RadialVonMises"};
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(
             std::filesystem::path(SPAM_SOURCE) / "include/spam/material")) {
        const std::string text = text_of(entry.path());
        const std::regex law("\\n(?:struct|class) (\\w+)(?= [^;]*\\{)");
        if (text.find("describe() const {") == std::string::npos) continue;
        for (std::sregex_iterator it(text.begin(), text.end(), law), end; it != end; ++it)
            if (!common.contains((*it)[1])) names.insert((*it)[1]);
    }
    return names;
}

}  // namespace

BOOST_AUTO_TEST_CASE(no_law_is_left_out) {
    std::stringstream text;
    for (const char* file : {"combined_laws.hpp", "law_tables.hpp", "more_law_tables.hpp"})
        text << std::ifstream(std::filesystem::path(SPAM_SOURCE) / "tests/rhs" / file).rdbuf();
    const auto names = names_of_laws();
    BOOST_TEST(names.size() > 18u);
    for (const auto& name : names) BOOST_TEST(text.str().find(name) != std::string::npos, name);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(every_law_and_every_external, In, UnitsIn) {
    constexpr int Dim = In::value;
    for (const auto& [law, build] : every_law<Dim>())
        for (const auto& [external, add] : externals<Dim>())
            BOOST_TEST_CONTEXT(law << ", " << external)
    BOOST_TEST(check<Dim>({.law = build, .external = external}).ran);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(every_law_with_adaptive_steps_and_from_rest, In, UnitsIn) {
    constexpr int Dim = In::value;
    for (const auto& [law, build] : every_law<Dim>())
        for (const double speed : {1.0, 0.0}) BOOST_TEST_CONTEXT(law << ", speed " << speed)
    BOOST_TEST(
        check<Dim>({.law = build, .external = "Gravity", .speed = speed, .end = 0.5}, adaptive)
            .ran);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(every_further_term, In, UnitsIn) {
    constexpr int Dim = In::value;
    for (const auto& [more, add] : further<Dim>())
        for (const char* law : {"SmoothParticles, gas", "TotalLagrangian"})
            BOOST_TEST_CONTEXT(law << " + " << more)
    BOOST_TEST(check<Dim>({.law = every_law<Dim>().at(law), .more = more}).ran);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(every_scheme_and_every_weight_function, In, UnitsIn) {
    constexpr int Dim = In::value;
    int ran = 0;
    Spread due(2, 8);
    for (const auto& [law, build] : with_scheme<Dim>()) {
        for_each_scheme([&, name = law, &build = build](const Scheme& scheme) {
            if (due.next()) BOOST_TEST_CONTEXT(name << ", " << scheme.describe())
            ran += check<Dim>({.law = build, .scheme = scheme}).ran;
        });
        for (const Kernel kernel : all_kernels())
            for (const auto mean : {MeanDensityKind::arithmetic, MeanDensityKind::geometric})
                BOOST_TEST_CONTEXT(law << ", " << to_string(kernel))
        BOOST_TEST(
            check<Dim>({.law = build, .scheme = {.mean_density = mean, .kernel = kernel}}).ran);
    }
    BOOST_TEST(ran > effort(80, 15));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(every_wall_and_a_period, In, UnitsIn) {
    constexpr int Dim = In::value;
    int ran = 0;
    for (const auto& [kind, wall] : walls<Dim>)
        for (const auto& [law, build] : every_law<Dim>()) BOOST_TEST_CONTEXT(kind << ": " << law) {
                const auto box = [&wall = wall](const Units& u) { return walled_by(wall, u); };
                ran += check<Dim>({.law = build, .external = "Gravity", .box = box}).ran;
            }
    BOOST_TEST(ran > 60);
    const auto periodic = [](const Units& u) { return full_box<Dim>(u.length); };
    for (const auto& [law, build] : every_law<Dim>()) BOOST_TEST_CONTEXT("periodic: " << law)
    ran += check<Dim>({.law = build, .box = periodic}).ran;
    BOOST_TEST(ran > 85);
    for (const auto& [law, build] : more_laws<Dim>())
        if (law.find("mbeddedAtom") != std::string::npos && !law.starts_with("D"))
            BOOST_TEST_CONTEXT("shifted: " << law) {
                const Scheme shifted{.transport = Transport::shifting};
                BOOST_TEST(check<Dim>({.law = build, .scheme = shifted, .box = periodic}).ran);
            }
}

/// Pairs that come near are reflected at times that are found.
BOOST_AUTO_TEST_CASE_TEMPLATE(reflections_of_pairs, In, UnitsIn) {
    constexpr int Dim = In::value;
    const Scheme scheme{.closest_approach = 0.99};
    for (const Options& options : {Options(fixed), Options(adaptive)})
        for (const char* law : {"SmoothParticles, gas", "SmoothParticles, solid"}) {
            const Setting<Dim> setting{
                .law = with_scheme<Dim>().at(law), .scheme = scheme, .speed = 3.0, .end = 1.0};
            BOOST_TEST(course_of(setting, {}, options).steps.events > 10u);
            BOOST_TEST(check(setting, options).ran);
        }
}

/// Also from rest, where none can tell how long a first step may be but by the scales of fields.
BOOST_AUTO_TEST_CASE_TEMPLATE(every_method, In, UnitsIn) {
    constexpr int Dim = In::value;
    for (const auto& method : integration_methods())
        for (const bool free : {false, true}) {
            const bool by_tolerance = method.adaptive && (free || !method.fixed);
            const auto options = [&](const Units& u) {
                IntegratorOptions one = by_tolerance ? adaptive(u) : fixed(u);
                one.method = method.name;
                return one;
            };
            const char* const law = method.separable ? "TotalLagrangian" : "SmoothParticles, solid";
            for (const double speed : {1.0, 0.0})
                BOOST_TEST_CONTEXT(method.name << (by_tolerance ? ", adaptive" : "") << ", speed "
                                               << speed)
            BOOST_TEST(
                check<Dim>({.law = every_law<Dim>().at(law), .external = "Gravity", .speed = speed},
                           options)
                    .ran);
        }
}

namespace {

/// A gas with a pressure that is the same number in all units.
struct AnchoredGas {
    GammaGas gas;
    double pressure(double rho, double e) const { return gas.pressure(rho, e) + 1e-3 * rho; }
    double sound_speed_squared(double rho, double e) const {
        return gas.sound_speed_squared(rho, e);
    }
    std::string describe() const { return "anchored"; }
};

/// Whether the difference is seen in one of the units.
template <int Dim>
bool seen(const Setting<Dim>& setting, const Options& options = fixed) {
    const Course<Dim> course = course_of(setting, {}, options);
    return std::any_of(units.begin(), units.begin() + 2, [&](const Units& u) {
        const Course<Dim> other = course_of(setting, u, options);
        return difference(course, other, u) != 0.0 || other.steps.steps != course.steps.steps;
    });
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(a_hidden_unit_is_found, In, UnitsIn) {
    constexpr int Dim = In::value;
    const Build<Dim> gas = with_scheme<Dim>().at("SmoothParticles, gas");
    const Build<Dim> smooth = more_laws<Dim>().at("SmoothHenckySolid");
    BOOST_TEST(!seen<Dim>({.law = gas}));
    BOOST_TEST(seen<Dim>(
        {.law = fluid_of<Dim>([](const Sample<Dim>&) { return AnchoredGas{GammaGas{1.4}}; })}));
    BOOST_TEST(seen<Dim>({.law = [](Sample<Dim>& s, const Scheme& scheme) {
        add_fluid(s, {IdealGas{Dim}, NewtonViscosity{0.1, 0.3}}, scheme);
    }}));
    BOOST_TEST(seen<Dim>({.law = solid_of<Dim>([](const Sample<Dim>& s) {
                              return YieldingSolid<RadialVonMises<Dim>>(
                                  elastic<RadialVonMises<Dim>>(s),
                                  LinearHardening{1e-3, s.stress(0.1)});
                          })}));
    BOOST_TEST(seen<Dim>({.law = [&](Sample<Dim>& s, const Scheme& scheme) {
        gas(s, scheme);
        add_external<Friction<Dim>>(s, 1e-3);
    }}));
    // The tolerance of one field, that of a plastic work here.
    const Setting<Dim> flowing{.law = smooth, .speed = 3.0, .end = 1.0};
    BOOST_TEST(!seen(flowing, adaptive));
    Setting<Dim> of_scale_1 = flowing;
    of_scale_1.mutate = [](Sample<Dim>& s, std::vector<double>&) {
        s.model.layout().set_scale(field_kind::flowing_plastic_work, 1.0);
    };
    BOOST_TEST(seen(of_scale_1, adaptive));
}
