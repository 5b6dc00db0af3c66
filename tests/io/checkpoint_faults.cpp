// SPDX-License-Identifier: GPL-3.0-or-later
// Every system call of a save fails once in every way: either the save reports it and the earlier
// checkpoint is as it was, or the new one is whole. This program's own write, fsync, ... stand
// between the library and the C library's.
#include "support/checkpoint.hpp"
#include <spam/core/error.hpp>

#include <boost/test/unit_test.hpp>
#include <fcntl.h>
#include <sys/syscall.h>

#include <algorithm>
#include <cstdarg>
#include <cstring>

namespace {

enum Call { open_call, write_call, fsync_call, close_call, rename_call, calls };

/// What happens to which call; `seen` counts calls while armed.
struct Plan {
    bool armed = false;
    Call call = calls;
    int at = 0;            ///< the how-manieth fails
    int reason = 0;        ///< errno
    std::size_t room = 0;  ///< above 0: writes do this much at most
    int seen[calls] = {};
} plan;

/// Does this call fail? Then errno is set.
bool fails(Call call) {
    if (!plan.armed) return false;
    const bool its_turn = plan.seen[call]++ == plan.at && plan.call == call;
    if (its_turn) errno = plan.reason;
    return its_turn;
}

}  // namespace

extern "C" {
int open(const char* path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const unsigned mode = (flags & O_CREAT) != 0 ? va_arg(rest, unsigned) : 0;
    va_end(rest);
    if (fails(open_call)) return -1;
    return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}
ssize_t write(int fd, const void* bytes, size_t size) {
    if (fails(write_call)) return plan.reason == 0 ? 0 : -1;
    if (plan.armed && plan.room > 0) size = std::min(size, plan.room);
    return syscall(SYS_write, fd, bytes, size);
}
int fsync(int fd) { return fails(fsync_call) ? -1 : static_cast<int>(syscall(SYS_fsync, fd)); }
int close(int fd) {
    // As on Linux: closed, whatever it reports.
    const bool failing = fails(close_call);
    const int reason = errno, result = static_cast<int>(syscall(SYS_close, fd));
    if (failing) errno = reason;
    return failing ? -1 : result;
}
int rename(const char* from, const char* to) noexcept {
    if (fails(rename_call)) return -1;
    return static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}
}

using namespace spam;
using namespace spam::test;

namespace {

enum Left { kept, replaced, broken };

struct Trial {
    bool reported = false;
    std::string line;
    Left outcome = broken;
    bool litter = false;
    int seen[calls] = {};
};

const Sample& earlier() {
    static const Sample sample(200, 1);
    return sample;
}
const Sample& later() {
    static const Sample sample(300, 2);
    return sample;
}

Trial save_with(Plan fault) {
    const Scratch folder;
    earlier().writer().save(folder / "a.h5");
    const CheckpointWriter writer = later().writer();
    Trial trial;
    plan = fault;
    plan.armed = true;
    try {
        writer.save(folder / "a.h5");
    } catch (const OutputError& error) {
        trial.reported = true;
        trial.line = error.what();
    }
    plan.armed = false;
    std::copy(std::begin(plan.seen), std::end(plan.seen), std::begin(trial.seen));
    const CheckpointReader reader(folder / "a.h5");
    if (earlier().equals(reader)) trial.outcome = kept;
    if (later().equals(reader)) trial.outcome = replaced;
    trial.litter = std::filesystem::exists(folder / "a.h5.tmp");
    return trial;
}

}  // namespace

BOOST_AUTO_TEST_CASE(calls_go_through_this_program) {
    const Trial trial = save_with({});
    BOOST_TEST(trial.outcome == replaced);
    BOOST_TEST(trial.seen[open_call] == 2);   // folder and temporary
    BOOST_TEST(trial.seen[write_call] == 2);  // contents and seal
    BOOST_TEST(trial.seen[fsync_call] == 2);
    BOOST_TEST(trial.seen[close_call] == 2);
    BOOST_TEST(trial.seen[rename_call] == 1);
}

BOOST_AUTO_TEST_CASE(a_fault_is_reported_and_harms_nothing_earlier) {
    int faults = 0;
    for (const int reason : {ENOSPC, EDQUOT, EIO, EFBIG, EROFS, EACCES, EMFILE, ENOMEM})
        for (const auto& [call, times] : {std::pair{open_call, 2},
                                          {write_call, 9},
                                          {fsync_call, 2},
                                          {close_call, 1},
                                          {rename_call, 1}})
            for (int at = 0; at < times; ++at) {
                const Trial trial = save_with({.call = call,
                                               .at = at,
                                               .reason = reason,
                                               .room = call == write_call ? 1000U : 0U});
                const bool after_rename = call == fsync_call && at == 1;
                BOOST_TEST_CONTEXT("call " << call << " at " << at << ": " << strerror(reason)) {
                    BOOST_TEST(trial.reported);
                    BOOST_TEST(trial.line.find(strerror(reason)) != std::string::npos, trial.line);
                    BOOST_TEST(trial.line.find("a.h5") != std::string::npos);
                    BOOST_TEST(trial.outcome == (after_rename ? replaced : kept));
                    BOOST_TEST(!trial.litter);
                }
                ++faults;
            }
    BOOST_TEST(faults == 8 * 15);
    BOOST_TEST_MESSAGE(faults << " faults");
}

BOOST_AUTO_TEST_CASE(what_only_interrupts_is_no_fault) {
    for (const auto& [call, times] :
         {std::pair{open_call, 2}, {write_call, 9}, {fsync_call, 2}, {close_call, 1}})
        for (int at = 0; at < times; ++at) {
            const Trial trial = save_with({.call = call, .at = at, .reason = EINTR, .room = 1000});
            BOOST_TEST(!trial.reported, trial.line);
            BOOST_TEST(trial.outcome == replaced);
        }
    const Trial bytewise = save_with({.room = 7});
    BOOST_TEST(bytewise.outcome == replaced);
    BOOST_TEST(bytewise.seen[write_call] > 1000);
    // A file system that knows no fsync of folders.
    const Trial no_such_sync = save_with({.call = fsync_call, .at = 1, .reason = EINVAL});
    BOOST_TEST(!no_such_sync.reported);
    // A write that does nothing must not be tried for ever.
    const Trial nothing_written = save_with({.call = write_call, .at = 0, .reason = 0});
    BOOST_TEST(nothing_written.reported);
    BOOST_TEST(nothing_written.outcome == kept);
}
