// SPDX-License-Identifier: GPL-3.0-or-later
// Does not compile by itself: what style.headers_gate must find.
#pragma once

namespace spam {

inline std::vector<int> nothing() { return {}; }

}  // namespace spam
