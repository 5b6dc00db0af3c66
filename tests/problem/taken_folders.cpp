// SPDX-License-Identifier: GPL-3.0-or-later
// What goes on in a folder of results while another run takes it with --force: at any moment between
// looking and locking. This program's own open and flock stand between the library and the C library,
// and let the other run act.
#include "problem/result_files.hpp"
#include <spam/core/error.hpp>
#include <spam/io/folder_lock.hpp>
#include <spam/material/harmonic_spring.hpp>
#include <spam/spam.hpp>

#include <boost/test/unit_test.hpp>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <chrono>
#include <cstdarg>
#include <functional>
#include <thread>

namespace {

/// Happens once: before a file or folder of that name is opened, or before a lock is asked for.
struct Meanwhile {
    std::string opened;
    bool locked = false;
    std::function<void()> act;

    void happen() {
        opened.clear();
        locked = false;
        std::exchange(act, nullptr)();
    }
} meanwhile;

}  // namespace

extern "C" {
int open(const char* path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const unsigned mode = (flags & O_CREAT) != 0 ? va_arg(rest, unsigned) : 0;
    va_end(rest);
    if (!meanwhile.opened.empty() && meanwhile.opened == path) meanwhile.happen();
    return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}
int flock(int fd, int operation) noexcept {
    if (meanwhile.locked) meanwhile.happen();
    return static_cast<int>(syscall(SYS_flock, fd, operation));
}
}

using namespace spam;
using spam::test::contents_of;
using spam::test::Scratch;
namespace fs = std::filesystem;

namespace {

using Words = std::vector<std::string>;

int call(Problem& problem, Words words, const std::function<void(Session&)>& body) {
    words.insert(words.begin(), "my_chain");
    std::vector<char*> arguments;
    for (auto& word : words) arguments.push_back(word.data());
    return problem.main(static_cast<int>(arguments.size()), arguments.data(), body);
}

/// Eight masses and springs on a line, the first one pushed.
int chain(Words words) {
    double push = 0.1;
    Problem problem("my_chain", "a chain of springs");
    problem.options().number("push", push, "speed of the first mass", any_number());
    words.insert(words.end(), {"--quiet", "--no-plots", "--dt", "0.05"});
    return call(problem, words, [&](Session& session) {
        BondedModel<1> model(make_particles<1>(square_lattice<1>({8}), 1.0), HarmonicSpring{});
        auto y0 = initial_state<1>(
            model, 1.0, 1.0, [&](const Point<1>& x) { return Point<1>(x[0] == 0.0 ? push : 0.0); });
        Plan<1> plan;
        plan.t_end = 2.0;
        plan.output_every = 1.0;
        plan.snapshot_every = 1.0;
        plan.checkpoint_every = 1.0;
        session.run<1>(model, std::move(y0), std::move(plan));
    });
}

/// A study of two numbers, of which so many come out.
int study(const std::string& out, const std::string& push, int known) {
    double p = 0.1;
    Problem problem("my_chain", "a study");
    problem.options().number("push", p, "a number", any_number());
    return call(problem, {"--quiet", "--no-plots", "--push", push, "--out", out}, [&](Session& s) {
        std::vector<StudyTask> tasks;
        for (int k = 0; k < 2; ++k)
            tasks.push_back({std::to_string(k), [k, known]() -> std::optional<Words> {
                                 if (k >= known) return {};
                                 return Words{"1"};
                             }});
        StudyTable table = s.begin_study("numbers", {"case", "number"}, {"two numbers"});
        s.run_study(table, tasks, 1);
    });
}

/// The run `o`, and another one, `other`, that takes its place: what --force does.
struct Folders : Scratch {
    const std::string o = (path() / "o").string(), other = (path() / "other").string(),
                      p = (path() / "p").string();

    void run_both() const {
        BOOST_REQUIRE(chain({"--push", "0.1", "--out", o}) == 0);
        BOOST_REQUIRE(chain({"--push", "0.2", "--out", other}) == 0);
    }
    std::function<void()> take() const {
        return [this] {
            fs::rename(o, o + ".old-1");
            fs::rename(other, o);
        };
    }
    /// Every file of one of them.
    std::map<std::string, std::string> of(const std::string& name) const {
        std::map<std::string, std::string> files;
        for (const auto& [file, text] : listing())
            if (file.starts_with(name + "/")) files[file.substr(name.size() + 1)] = text;
        return files;
    }
    bool taken() const { return fs::exists(o + ".old-1"); }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_folder_moved_while_it_is_being_locked_is_refused) {
    const Folders f;
    f.run_both();
    const auto before = f.of("other");
    meanwhile = {"", true, f.take()};
    BOOST_TEST(chain({"--restart", f.o, "--t-end", "4"}) == 2);
    BOOST_REQUIRE(f.taken());
    BOOST_TEST((f.of("o") == before));
}

/// Then it is the other run that is gone on with, in all its parts.
BOOST_AUTO_TEST_CASE(nothing_is_read_before_the_folder_is_locked) {
    for (const std::string restart : {"o", "o/checkpoint_0.h5"}) {
        const Folders f, whole;
        f.run_both();
        whole.run_both();
        BOOST_REQUIRE(chain({"--restart", (whole.path() / ("other" + restart.substr(1))).string(),
                             "--t-end", "4"}) == 0);
        meanwhile = {f.o, false, f.take()};
        BOOST_TEST(chain({"--restart", (f.path() / restart).string(), "--t-end", "4"}) == 0);
        BOOST_REQUIRE(f.taken());
        const auto expected = whole.of("other"), left = f.of("o");
        std::size_t compared = 0;
        for (const auto& [name, text] : expected) {
            if (!name.ends_with(".csv") && !name.ends_with(".vtp") && name != "case.toml") continue;
            BOOST_TEST((left.contains(name) && left.at(name) == text), name << " differs");
            ++compared;
        }
        BOOST_TEST(compared == 7u);  // case, rows, five configurations
    }
}

BOOST_AUTO_TEST_CASE(snapshots_of_another_run_are_not_copied) {
    const Folders f;
    f.run_both();
    const auto before = f.of("other");
    meanwhile = {f.o + "/snapshot_0001.vtp", false, f.take()};
    BOOST_TEST(chain({"--restart", f.o, "--t-end", "4", "--out", f.p}) == 4);
    BOOST_REQUIRE(f.taken());
    BOOST_TEST((f.of("o") == before));
}

/// A process that reads a checkpoint for a run elsewhere holds the folder for a moment only, and is waited for.
BOOST_AUTO_TEST_CASE(who_only_reads_is_waited_for) {
    const Folders f;
    f.run_both();
    auto reader = std::make_unique<FolderLock>(f.o);
    BOOST_CHECK_THROW(RunFolder::reopen(f.o), InputError);
    std::jthread ends([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        reader.reset();
    });
    BOOST_TEST(chain({"--restart", f.o, "--t-end", "4", "--out", f.p}) == 0);
    // ... and lets go of it before its own run ends.
    const RunFolder restarted = RunFolder::reopen(f.o);
    restarted.release();
    BOOST_CHECK_NO_THROW(RunFolder::reopen(f.o));
    BOOST_TEST(restarted.is_there());
    fs::rename(f.o, f.other + ".2");
    BOOST_TEST(!restarted.is_there());
}

BOOST_AUTO_TEST_CASE(a_study_goes_on_only_in_its_own_folder) {
    const Folders f;
    study(f.o, "0.1", 1);
    study(f.other, "0.2", 1);
    BOOST_REQUIRE(fs::exists(f.o + "/numbers.part.csv"));
    const auto before = f.of("other");
    meanwhile = {f.o, false, f.take()};
    BOOST_TEST(study(f.o, "0.1", 2) == 2);
    BOOST_REQUIRE(f.taken());
    BOOST_TEST((f.of("o") == before));
}
