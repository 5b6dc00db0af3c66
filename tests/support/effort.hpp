// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace spam::test {

/// Under sanitizers `less`, which must show the same laws in a tenth of the work: code is ten times slower
/// there and more.
template <class T>
T effort(const T& full, const T& less) {
    return SPAM_SANITIZED ? less : full;
}

}  // namespace spam::test
