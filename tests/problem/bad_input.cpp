// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever is wrong with the input ends before anything is computed: exit status 2, one line on
// standard error that names what, where, the allowed values and the fix; nothing else happens.
#include "support/process.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

struct Bad {
    Words arguments;
    Words says;          ///< what the line must contain
    std::string toml{};  ///< written to case.toml and given with --config, if not empty
    std::string program{"rotating_hexagon"};
};

Bad in(std::string program, Words arguments, Words says) {
    return {std::move(arguments), std::move(says), {}, std::move(program)};
}

Bad file(std::string toml, Words says) { return {{}, std::move(says), std::move(toml)}; }

/// A folder with things that must survive.
void furnish(const Scratch& folder, const Bad& bad) {
    folder.write("file", "mine");
    folder.write("full/keep", "mine");
    folder.write("binary", std::string("\x7f\x45\x4c\x46\x00\xff\xfe\n\x01", 9));
    if (!bad.toml.empty()) folder.write("case.toml", bad.toml);
}

void check_refused(const Bad& bad) {
    const Scratch folder;
    furnish(folder, bad);
    const auto before = folder.listing();
    // --smoke: should the case be accepted, at least it ends soon.
    Words arguments{"--smoke", "--no-plots"};
    if (!bad.toml.empty()) arguments.insert(arguments.end(), {"--config", "case.toml"});
    arguments.insert(arguments.end(), bad.arguments.begin(), bad.arguments.end());
    const Outcome outcome =
        Child(problem(bad.program, arguments), {folder.path()}).finish(Child::Seconds(20));

    std::string shown = bad.program + " " + bad.toml;
    for (const auto& word : bad.arguments) shown.append(" [").append(word, 0, 80).append("]");
    BOOST_TEST_CONTEXT(shown << "\n" << outcome.err) {
        BOOST_TEST(outcome.status == 2);
        if (outcome.status != 2) return;  // the rest would only repeat it
        BOOST_TEST(outcome.out == "");
        BOOST_TEST(outcome.err.starts_with(bad.program + ": "));
        BOOST_TEST(outcome.err.ends_with("\n"));
        BOOST_TEST(std::count_if(outcome.err.begin(), outcome.err.end(), [](unsigned char c) {
                       return c < 0x20;
                   }) == 1);  // the end of the one line
        for (const auto& word : bad.says)
            BOOST_TEST(outcome.err.find(word) != std::string::npos, "no '" << word << "'");
        BOOST_TEST((folder.listing() == before));
    }
}

void check_all(const std::vector<Bad>& table) {
    for (const Bad& bad : table) check_refused(bad);
}

const std::string dormand = "arkode:DORMAND_PRINCE_7_4_5";

}  // namespace

BOOST_AUTO_TEST_CASE(names_that_do_not_exist) {
    check_all({
        {{"--sped", "1"}, {"--sped", "--speed"}},
        {{"--turn=2"}, {"--turn", "--turns"}},
        {{"--Size", "4"}, {"--Size", "--size"}},
        {{"-q"}, {"-q"}},
        {{"stray"}, {"'stray' belongs to no option", "--name value"}},
        {{"--foo", "1"}, {"unknown option '--foo'. See"}},  // nothing like it
        {{"--quiet", "3"}, {"3"}},
        {{"--si\nze"}, {"--size"}},
        {{"--kernel", "gauss"}, {"kernel", "gauss", "lucy", "monaghan", "w8"}},
        {{"--kernel", "w9"}, {"kernel", "w9", "w8"}},
        {{"--transport", "monagan"}, {"transport", "monagan", "monaghan", "plain"}},
        {{"--model", "MD"}, {"model", "MD", "md"}},
        {{"--integrator", "RK4"}, {"integrator", "RK4", "rk4", "arkode:"}},
        {{"--integrator", "rk5"},
         {"rk5", "mean rk4?", "leapfrog", "arkode:DORMAND_PRINCE_7_4_5", "gsl:msadams"}},
        {{"--integrator", "arkode:DORMAND_PRINCE"}, {"DORMAND_PRINCE", "DORMAND_PRINCE_7_4_5"}},
        {{"--integrator", "arkode:ARKODE_ERK_NONE"}, {"integrator", "ARKODE_ERK_NONE"}},
        {{"--integrator", "arkode:"}, {"integrator", "DORMAND_PRINCE_7_4_5"}},
        {{"--integrator", "a\nb"}, {"integrator"}},
        {{"--integrator", "gsl:rk9"}, {"integrator", "rk9", "gsl:rk8pd"}},
        {{"--integrator", "gsl:bsimp"}, {"integrator", "gsl:bsimp", "Jacobian"}},
        {{"--integrator", "cvode:bd"}, {"integrator", "cvode:bdf", "cvode:adams"}},
        {{"--integrator", "cvode:bdf", "--dt", "0.1"}, {"dt", "cvode:bdf", "leave"}},
        {{"--integrator", "sprk:LEAPFROG"}, {"integrator", "sprk:", "LEAPFROG"}},
        {{"--integrator", dormand, "--controller", "pdi"}, {"controller", "pdi", "pid"}},
    });
}

BOOST_AUTO_TEST_CASE(values_out_of_range) {
    check_all({
        {{"--model", "md", "--torques"}, {"torques", "md"}},
        {{"--viscosity", "-1"}, {"viscosity", "-1"}},
        {{"--viscosity", "nan"}, {"viscosity", "nan"}},
        {{"--balance", "global"}, {"balance", "free", "torque_pair"}},
        {{"--balance", "global", "--angular-momentum", "torque_pair"}, {"balance", "for one"}},
        {{"--viscosity", "100"}, {"dt: damping (--viscosity)", "rk4", "below"}},
        {{"--guard", "off", "--limit-energy", "1e-3"}, {"limit-energy", "--guard"}},
        {{"--limit-momentum", "0"}, {"limit-momentum", "above 0"}},
        {{"--guard", "on"}, {"guard", "on", "off, warn, stop"}},
        {{"--gauss-singular", "stop", "--angular-momentum", "torque_pair"},
         {"gauss-singular", "torque_pair", "gauss"}},
        {{"--closest-approach", "-0.5"}, {"closest-approach", "-0.5", "0"}},
        {{"--closest-approach", "nan"}, {"closest-approach", "nan"}},
        {{"--closest-approach", "1e-300"}, {"closest-approach", "1e-300", "0.5 to 0.9"}},
        {{"--closest-approach", "1"}, {"closest-approach", "1", "spacing", "0.5 to 0.9"}},
        {{"--model", "md", "--closest-approach", "0.5"}, {"closest-approach", "md"}},
        {{"--range", "-1"}, {"range", "-1", "above 0"}},
        {{"--range", "0"}, {"range", "0", "above 0"}},
        {{"--range", "nan"}, {"range", "nan", "above 0"}},
        {{"--range", "inf"}, {"range", "inf", "above 0"}},
        {{"--range", "1e400"}, {"range", "1e400"}},
        {{"--range", ""}, {"range", "above 0"}},
        {{"--range", "three"}, {"range", "three"}},
        {{"--range", "3,5"}, {"range", "3,5"}},
        {{"--range", "3x"}, {"range", "3x"}},
        {{"--dt", "0"}, {"dt", "0", "above 0"}},
        {{"--dt=-0.1"}, {"dt", "-0.1", "above 0"}},
        {{"--dt", "1e-300"}, {"dt", "1e-300", "steps"}},  // t + dt == t: it would never end
        {{"--turns", "1e300"}, {"dt", "steps", "earlier end"}},
        {{"--dt", "1e300"}, {"dt: 1e+300 is longer than the run"}},
        {{"--t-end", "1e300", "--snapshot-every", "1e299", "--integrator", dormand},
         {"t-end", "at least as many steps"}},
        {{"--output-every", "1e-300", "--integrator", dormand}, {"output-every", "1e-300"}},
        {{"--speed", "0"}, {"speed", "0", "between 1e-06 and 1000"}},
        {{"--turns", "-1"}, {"turns", "-1"}},
        {{"--t-end", "0"}, {"t-end", "0"}},
        {{"--output-every", "0"}, {"output-every", "0"}},
        {{"--snapshot-every", "-2"}, {"snapshot-every", "-2"}},
        {{"--size", "-1"}, {"size", "-1", "between 1 and 2000"}},
        {{"--size", "0"}, {"size", "0", "between 1 and 2000"}},
        {{"--size", "2.5"}, {"size", "2.5", "whole number"}},
        {{"--size", "2001"}, {"size", "2001", "between 1 and 2000"}},
        {{"--size", "99999999999999999999"}, {"size", "between 1 and 2000"}},
        {{"--size", "4\n5"}, {"size", "whole number"}},
        {{"--threads", "0"}, {"threads", "0", "between 1 and"}},
        {{"--ranks", "0"}, {"ranks", "0", "between 1 and"}},
        {{"--rtol", "1", "--integrator", dormand}, {"rtol", "1", "below 1"}},
        {{"--safety", "1.5", "--integrator", dormand}, {"safety", "1.5", "below 1"}},
        {{"--max-step", "1e-13", "--integrator", dormand}, {"max-step", "steps to t"}},
        {{"--max-step", "1e-3", "--min-step", "1e-2", "--integrator", dormand},
         {"max-step", "min-step"}},
        {{"--min-step", "0", "--integrator", dormand}, {"min-step", "0", "above 0"}},
        {{"--initial-step", "2", "--max-step", "1", "--integrator", dormand},
         {"initial-step", "2", "max-step"}},
        {{"--atol-energy", "-1", "--integrator", dormand}, {"atol-energy", "-1", "above 0"}},
        {{"--max-steps", "0"}, {"max-steps", "0", "between 1"}},
        {{"--quiet=maybe"}, {"quiet", "maybe", "true or false"}},
        {{"--quiet="}, {"quiet", "missing", "--quiet=true"}},
        {{"--dry-run=x", "--dry-run"}, {"dry-run", "x", "true or false"}},
        {{"--speed", "+-5"}, {"speed", "+-5"}},
        {{"--size", "200", "--range", "1e5"}, {"range", "120601 particles", "shorter range"}},
    });
}

BOOST_AUTO_TEST_CASE(options_without_or_with_too_many_values) {
    check_all({
        {{"--size", "3", "--size", "4"}, {"size: given 2 times"}},
        {{"--config", "a", "--config", "b"}, {"config: given 2 times"}},
        {{"--dt", "--transport"}, {"dt"}},
        {{"--out"}, {"out: the value of --out is missing"}},
        {{"--out", "--force"}, {"out", "--force"}},
        {{"--out", ""}, {"out", "empty"}},
        {{"--out="}, {"--out"}},
        {{"--config", ""}, {"config", "empty"}},
    });
}

BOOST_AUTO_TEST_CASE(combinations_that_make_no_sense) {
    check_all({
        {{"--rtol", "1e-6"}, {"rtol", "rk4", "--dt"}},
        {{"--atol", "1e-6", "--integrator", "rk4"}, {"atol", "rk4"}},
        {{"--dt", "0.1", "--rtol", "1e-6", "--integrator", dormand}, {"rtol", "--dt", "leave"}},
        {{"--integrator", "arkode:KNOTH_WOLKE_3_3"}, {"integrator", "KNOTH_WOLKE", "--dt"}},
        {{"--integrator", "cvode:adams", "--dt", "0.1"}, {"dt", "cvode:adams", "leave"}},
        {{"--integrator", "gsl:msadams", "--dt", "0.1"}, {"dt", "gsl:msadams", "leave"}},
        {{"--integrator", "cvode:adams", "--safety", "0.5"}, {"safety", "cvode:adams", "arkode:"}},
        {{"--integrator", "gsl:rk8pd", "--controller", "pi"}, {"controller", "gsl:rk8pd"}},
        {{"--controller", "pi"}, {"controller", "rk4", "fixed step"}},
        {{"--integrator", dormand, "--dt", "0.1", "--max-step", "1"}, {"max-step", "--dt"}},
        {{"--integrator", dormand, "--model", "md", "--atol-stress", "1"},
         {"atol-stress", "no stress"}},
        {{"--integrator", "cvode:adams", "--closest-approach", "0.5"},
         {"integrator", "cvode:adams", "closest approach"}},
        {{"--integrator", "leapfrog"}, {"dt", "leapfrog", "fixed step", "positions alone"}},
        {{"--integrator", "leapfrog", "--dt", "0.1"}, {"leapfrog", "density", "rk4"}},
        {{"--model", "md", "--integrator", "leapfrog", "--dt", "0.1", "--rtol", "1e-6"},
         {"rtol", "leapfrog"}},
        {{"--density", "chain_rule"}, {"chain_rule", "--transport"}},
        {{"--density", "chain_rule", "--transport", "plain"}, {"chain_rule", "--transport"}},
        {{"--turns", "1", "--t-end", "5"}, {"turns", "t-end", "leave"}},
        {{"--model", "md", "--density", "summed"}, {"density", "--model md"}},
        {{"--model", "md", "--transport", "plain"}, {"transport", "--model md"}},
        {{"--model", "md", "--angular-momentum", "torque_pair"},
         {"angular-momentum", "--model md"}},
        {{"--model", "md", "--range", "3"}, {"range", "--model md"}},
        {{"--model", "md", "--penalty", "1"}, {"penalty", "--model md"}},
        {{"--model", "md", "--formulation", "updated"}, {"formulation", "--model md"}},
        {{"--penalty", "1"}, {"penalty", "--formulation updated"}},
        {{"--formulation", "total_lagrangian", "--penalty", "-1"}, {"penalty", "-1"}},
        {{"--formulation", "total_lagrangian", "--transport", "plain"},
         {"transport", "--formulation total_lagrangian"}},
        {{"--formulation", "total_lagrangian", "--range", "0.9"}, {"range", "0.9"}},
        {{"--formulation", "material_vectors", "--kernel", "w5"}, {"kernel", "material_vectors"}},
        {{"--formulation", "material_vectors", "--torques"}, {"torques", "material_vectors"}},
        {{"--formulation", "material_vectors", "--penalty", "-1"}, {"penalty", "-1"}},
    });
}

BOOST_AUTO_TEST_CASE(what_other_problems_cannot_do) {
    const Words sizes{"--cells", "16", "--compare-sizes"};
    const auto and_also = [](Words words, const Words& more) {
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    check_all({
        in("plane_wave", and_also(sizes, {"--t-end", "5"}), {"t-end: 5", "the least is"}),
        in("plane_wave", and_also(sizes, {"--block", "3"}), {"block", "--compare-sizes"}),
        in("plane_wave", {"--polarization", "longitudinal", "--block", "3"}, {"block", "leave"}),
        in("plane_wave", {"--block", "1000"}, {"block: 1000", "half a wave", "--cells 10"}),
        in("plane_wave", {"--block", "1e-9"}, {"block", "between 2 and"}),
        in("plane_wave", {"--range", "10"}, {"cells: 10 x 10", "--range 10", "the least is 24"}),
        in("plane_wave", {"--cells", "7"}, {"cells: 7", "even"}),
        in("plane_wave", {"--seed", "3"}, {"seed", "--perturb"}),
        in("tensile_instability", {"--range", "10"}, {"cells: 10 x 10", "the least is 24"}),
        in("tensile_instability", {"--speed", "1e-300"}, {"speed", "at least 1e-12"}),
        in("fragmenting_bar", {"--speed", "1e5"}, {"speed: at 100000", "dt = 0.05", "--dt below"}),
        in("fragmenting_bar", {"--speed", "10"}, {"speed: at 10", "--output-every below 0.3"}),
        in("rotating_disk", {"--model", "md", "--kernel", "lucy"}, {"kernel", "--model md"}),
        in("rotating_disk", {"--damping", "100"}, {"dt: damping (--damping)", "rk4"}),
        in("rotating_disk", {"--closest-approach", "0.5", "--integrator", "cvode:adams"},
           {"integrator", "cvode:adams", "closest approach"}),
        in("rotating_disk", {"--balance", "global"}, {"balance", "for one"}),
        in("stability", {"--mean-density", "geometric"}, {"mean-density", "first order"}),
        in("stability", {"--guard", "stop"}, {"guard", "integrates nothing"}),
        in("turns_survived", {"--limit-energy", "1"}, {"limit-energy", "many runs"}),
    });
}

/// What would compute for ever before the first step.
BOOST_AUTO_TEST_CASE(cases_that_would_never_start) {
    check_all({
        in("drop", {"--range", "1e6"}, {"range", "spacing", "1000"}),
        in("drop", {"--range", "1e9"}, {"range", "spacing", "1000"}),
        in("drop", {"--cells", "1000", "--range", "900"}, {"range", "pairs", "1000000 particles"}),
        in("string_phase", {"--side", "1e8"}, {"side", "never meet"}),
        in("string_phase", {"--particles", "1000000", "--side", "8"}, {"side", "neighbours"}),
        in("stability", {"--range", "1e6"}, {"range", "30 spacings"}),
        in("sheared_square", {"--cells", "600", "--range", "9e5"}, {"range", "pairs"}),
        in("rotating_disk", {"--radius", "300", "--range", "9e5"}, {"range", "radius"}),
        in("free_expansion", {"--cells", "12", "--ranges", "density"},
           {"cells", "--ranges density", "at least --cells 13"}),
        in("free_expansion", {"--cells", "400", "--range", "399"}, {"range", "pairs"}),
        in("turns_survived", {"--turns", "1e12"}, {"dt", "steps"}),
        in("turns_survived", {"--speed", "1e300"}, {"speed", "between"}),
        in("turns_survived", {"--speed", "1e3"}, {"speed", "between", "sound"}),
        in("algorithm_sweep", {"--turns", "1e12"}, {"dt", "steps"}),
        in("invariant_drift", {"--periods", "1e12"}, {"calls-per-time", "right-hand sides"}),
    });
}

BOOST_AUTO_TEST_CASE(result_folders_that_cannot_be) {
    const std::string long_name(300, 'x');
    check_all({
        {{"--out", "file"}, {"out", "file"}},
        {{"--out", "file", "--force"}, {"out", "file", "not a folder"}},
        {{"--out", "file/below"}, {"out", "file/below", "Not a directory"}},
        {{"--out", "full"}, {"out", "full", "--force"}},
        {{"--out", "full/"}, {"out", "full", "--force"}},
        {{"--out", "."}, {"out", "--force"}},
        {{"--out", ".", "--force"}, {"out"}},
        {{"--out", "full/..", "--force"}, {"out"}},
        {{"--out", "/proc/spam"}, {"out", "/proc/spam"}},
        {{"--out", long_name}, {"out", "File name too long"}},
    });
}

BOOST_AUTO_TEST_CASE(files_of_options) {
    check_all({
        {{"--config", "nosuch.toml"}, {"config", "nosuch.toml"}},
        {{"--config", "full"}, {"config", "full"}},
        {{"--config", "/proc/self/mem"}, {"config", "/proc/self/mem", "cannot be read to its end"}},
        {{"--config", "/dev/zero"}, {"config", "/dev/zero", "longer than 16 MiB"}},
        {{"--config", "binary"}, {"config", "binary"}},
        {{"--config"}, {"config"}},
        file("rnge = 3\n", {"case.toml line 1", "rnge", "mean range?"}),
        file("size = 3\n\ntransprot = \"plain\"\n", {"line 3", "transprot", "mean transport?"}),
        file("\"a\\nb\" = 1\n", {"line 1", "unknown key"}),
        file("range = nan\n", {"line 1", "range", "nan", "above 0"}),
        file("range = -inf\n", {"line 1", "range", "-inf", "above 0"}),
        file("range = \"3\"\n", {"line 1", "range", "\"3\" must be a number, without quotes"}),
        file("size = \"4\"\n", {"line 1", "size", "without quotes", "between 1 and 2000"}),
        file("[size]\n", {"line 1", "size: [size] begins a table", "write size ="}),
        file("[transport]\n", {"line 1", "begins a table", "write transport = \"...\""}),
        file("size = 2.5\n", {"line 1", "size", "2.5", "between 1 and 2000"}),
        file("size = true\n", {"line 1", "size", "true", "between 1 and 2000"}),
        file("size = [3, 4]\n", {"line 1", "size", "between 1 and 2000"}),
        file("size = {a = 1}\n", {"line 1", "size", "between 1 and 2000"}),
        file("dt = 1979-05-27\n", {"line 1", "dt", "above 0"}),
        file("transport = 3\n", {"line 1", "transport", "3", "plain"}),
        file("transport = \"avarage\"\n", {"line 1", "transport", "avarage", "average"}),
        file("integrator = \"\"\n", {"line 1", "integrator", "empty"}),
        file("force = 1\n", {"line 1", "force", "1", "true or false"}),
        file("quiet = \"true\"\n", {"line 1", "quiet", "true or false, without quotes"}),
        file("[scheme]\ndensity = \"summed\"\n", {"line 1", "scheme"}),
        file("size = 3\nsize = 4\n", {"line 2", "size"}),
        file("size = 3\nrange 4\n", {"line 2", "="}),
        file("size = 3\r\nrange = -4\r\n", {"line 2", "range", "-4"}),
        file("\xef\xbb\xbfrange = -4\n", {"line 1", "range", "-4"}),
        file("range = 3 # \xff\n", {"line 1", "utf-8"}),
        file("config = \"other.toml\"\n", {"line 1", "config"}),
    });
}

BOOST_AUTO_TEST_CASE(a_missing_file_has_no_lines) {
    const Scratch folder;
    const auto outcome =
        run(problem("rotating_hexagon", {"--config", "nosuch.toml"}), {folder.path()});
    BOOST_TEST(outcome.err.find("line 0") == std::string::npos, outcome.err);
}
