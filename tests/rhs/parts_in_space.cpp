// SPDX-License-Identifier: GPL-3.0-or-later
// The same for space, in a file of its own because it takes long to compile; SPAM_PARTS_IN is 3.
#include "parts.cpp"
