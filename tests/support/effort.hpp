// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdlib>

namespace spam::test {

/// Under sanitizers `less`, which must show the same laws in a tenth of the work: code is ten times slower
/// there and more.
template <class T>
T effort(const T& full, const T& less) {
    return SPAM_SANITIZED ? less : full;
}

/// Whether what takes tens of seconds is due: the second size of a run, what shows the same law once more. So
/// `./spam test -L long` asks (spam_long() in tests/CMakeLists.txt), and the ordinary suite does not.
inline bool long_runs() { return !SPAM_SANITIZED && std::getenv("SPAM_LONG") != nullptr; }

/// What the suite, and `less` under sanitizers, show as well as long runs do.
template <class T>
T effort(const T& in_long_runs, const T& usual, const T& less) {
    return long_runs() ? in_long_runs : effort(usual, less);
}

/// Of many combinations that show one and the same: all of them in long runs, one of `usual` in the suite, one of
/// `sanitized` under sanitizers. Multiples of the golden mean are spread evenly however many loops ask in turn.
class Spread {
  public:
    Spread(int usual, int sanitized) : share_(long_runs() ? 1.0 : 1.0 / effort(usual, sanitized)) {}
    bool next() {
        place_ = std::fmod(place_ + 0.6180339887498949, 1.0);
        return place_ < share_;
    }

  private:
    double share_, place_ = 0.0;
};

}  // namespace spam::test
