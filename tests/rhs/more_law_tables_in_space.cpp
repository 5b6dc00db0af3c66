// SPDX-License-Identifier: GPL-3.0-or-later
#include "rhs/more_law_tables.hpp"

template const spam::test::Laws<3>& spam::test::more_laws<3>();
