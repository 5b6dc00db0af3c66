// SPDX-License-Identifier: GPL-3.0-or-later
// Two checkpoints in turn: whenever a run is killed, the newest complete one is at most one save
// behind what it had reported.
#include "support/checkpoint.hpp"
#include <spam/core/error.hpp>
#include <spam/io/checkpoint_pair.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;
namespace fs = std::filesystem;

namespace {

std::int64_t number_in(const fs::path& path) {
    return CheckpointReader(path).integers("/sequence").at(0);
}

/// A child that saves in a loop and reports the numbers of what is saved. It is killed `delay` after its first
/// report or, where there is a limit, by the kernel at that byte of its second file. Returns the last number
/// reported.
std::int64_t save_until_killed(const fs::path& folder, std::chrono::microseconds delay,
                               rlim_t limit = RLIM_INFINITY) {
    std::signal(SIGCHLD, SIG_DFL);
    int reports[2];
    if (pipe2(reports, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    const pid_t child = fork();
    if (child == 0) {
        const Sample sample;
        for (CheckpointPair pair(folder);;) {
            pair.save(sample.writer());
            const std::int64_t number = pair.sequence();
            if (write(reports[1], &number, sizeof number) != sizeof number) _exit(1);
            std::signal(SIGXFSZ, SIG_DFL);
            const rlimit bytes{limit, limit}, no_core{0, 0};
            setrlimit(RLIMIT_CORE, &no_core);
            setrlimit(RLIMIT_FSIZE, &bytes);
        }
    }
    close(reports[1]);
    std::int64_t number = 0, last = 0;
    bool started = false;
    while (read(reports[0], &number, sizeof number) == sizeof number) {
        last = number;
        if (!started && limit == RLIM_INFINITY) {
            usleep(static_cast<useconds_t>(delay.count()));
            kill(child, SIGKILL);
        }
        started = true;
    }
    close(reports[0]);
    waitpid(child, nullptr, 0);
    return last;
}

}  // namespace

BOOST_AUTO_TEST_CASE(generations_alternate) {
    const Scratch folder;
    const fs::path zero = folder / "checkpoint_0.h5", one = folder / "checkpoint_1.h5";
    BOOST_TEST(!newest_checkpoint(folder.path()));
    BOOST_TEST(!newest_checkpoint(folder / "absent"));
    CheckpointPair pair(folder.path());
    BOOST_TEST(pair.sequence() == 0);
    for (const auto& [number, path] : {std::pair{1, zero}, {2, one}, {3, zero}, {4, one}}) {
        BOOST_TEST(pair.next() == path);
        pair.save(Sample().writer());
        BOOST_TEST(pair.sequence() == number);
        BOOST_TEST(number_in(path) == number);
        BOOST_TEST(newest_checkpoint(folder.path()).value() == path);
    }
    // Another process goes on where this one is.
    CheckpointPair next(folder.path());
    BOOST_TEST(next.next() == zero);
    next.save(Sample().writer());
    BOOST_TEST(number_in(zero) == 5);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_read_is_the_oldest) {
    for (const char* damaged : {"checkpoint_0.h5", "checkpoint_1.h5"})
        for (const std::size_t left : {0U, 100U, 5000U}) {
            const Scratch folder;
            CheckpointPair pair(folder.path());
            pair.save(Sample().writer());
            pair.save(Sample().writer());
            fs::resize_file(folder / damaged, left);
            const auto newest = newest_checkpoint(folder.path());
            BOOST_TEST_REQUIRE(newest.has_value());
            BOOST_TEST((newest->filename() != damaged));
            BOOST_TEST(Sample().equals(CheckpointReader(*newest)));
            BOOST_TEST((CheckpointPair(folder.path()).next().filename() == damaged));
        }
}

BOOST_AUTO_TEST_CASE(a_checkpoint_without_a_number_counts_for_nothing) {
    const Scratch folder;
    Sample().writer().save(folder / "checkpoint_1.h5");
    BOOST_TEST(!newest_checkpoint(folder.path()));
}

BOOST_AUTO_TEST_CASE(a_save_that_fails_leaves_the_pair_as_it_was) {
    const Scratch folder;
    CheckpointPair pair(folder.path());
    pair.save(Sample().writer());
    fs::create_directory(folder / "checkpoint_1.h5");
    BOOST_CHECK_THROW(pair.save(Sample().writer()), OutputError);
    BOOST_TEST(pair.sequence() == 1);
    BOOST_TEST(pair.next() == folder / "checkpoint_1.h5");
    fs::remove(folder / "checkpoint_1.h5");
    pair.save(Sample().writer());
    BOOST_TEST(number_in(folder / "checkpoint_1.h5") == 2);
}

BOOST_AUTO_TEST_CASE(a_run_killed_at_any_moment_leaves_its_newest_checkpoint) {
    const Scratch folder;
    CheckpointPair(folder.path()).save(Sample().writer());
    const auto size = fs::file_size(newest_checkpoint(folder.path()).value());
    std::mt19937 random(11);
    std::uniform_int_distribution<int> delay(0, 30'000);
    std::uniform_int_distribution<rlim_t> byte(1, size - 1);
    std::int64_t saved = 1;
    int halves = 0;
    for (int k = 0; k < 50; ++k) {
        // Where files lie in memory, a moment is seldom within a file: every second child ends there for certain.
        const bool within = k % 2 == 1;
        const std::int64_t last =
            within ? save_until_killed(folder.path(), {}, byte(random))
                   : save_until_killed(folder.path(), std::chrono::microseconds(delay(random)));
        BOOST_TEST(last > saved);
        saved = last;
        const auto newest = newest_checkpoint(folder.path());
        BOOST_TEST_REQUIRE(newest.has_value());
        BOOST_TEST(number_in(*newest) >= saved);
        BOOST_TEST(Sample().equals(CheckpointReader(*newest)));
        int torn = 0;
        for (const auto& entry : fs::directory_iterator(folder.path()))
            torn += entry.path().extension() == ".tmp";
        if (within) BOOST_TEST(torn > 0);
        halves += torn;
    }
    BOOST_TEST_MESSAGE(saved << " saves; files left by one that was killed: " << halves);
}
