// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace spam {

/// A signal was noted in the middle of a computation whose results so far are of no use.
struct Interrupted : std::runtime_error {
    Interrupted() : std::runtime_error("interrupted by a signal") {}
};

/// What SIGINT, SIGTERM and SIGHUP do while this is alive. At first they end the process at once, with
/// a line on standard error and status 128 + signal: nothing has been computed that could be lost.
/// From complete_results() on they are only noted, so that a run can complete its results; a second
/// signal, half a second later or more, then ends the process (timeout(1) sends two at once). A signal that was ignored
/// at the start stays ignored (nohup).
class InterruptWatch {
  public:
    /// `program` names the process in that line.
    explicit InterruptWatch(const std::string& program);
    ~InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;

    /// While one is alive a signal waits for its end: a result folder is not left without the checkpoint
    /// from which it can be gone on with.
    class Delay {
      public:
        Delay();
        ~Delay();
        Delay(const Delay&) = delete;
        Delay& operator=(const Delay&) = delete;
    };

    /// From here on there are results to be completed.
    static void complete_results();

    /// While one is alive after complete_results() a signal ends the process at once again, and says that
    /// the results so far are complete: for long computations between results. So does, at its beginning,
    /// a signal that was noted before.
    class AtOnce {
      public:
        AtOnce();
        ~AtOnce();
        AtOnce(const AtOnce&) = delete;
        AtOnce& operator=(const AtOnce&) = delete;
    };

    /// The signal noted, 0 if none.
    static int received();
    /// Throws Interrupted if there is one; not where other parts of the run would wait for this one.
    static void check();
    /// That of any part of a run (core/parts.hpp) which all know of by the exchanges so far: for use within a step.
    static int told();
    /// That of any part, asked for, which is then noted here as well.
    static int agreed();
};

}  // namespace spam
