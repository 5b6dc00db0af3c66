// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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

}  // namespace spam::test
