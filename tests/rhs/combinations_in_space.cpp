// SPDX-License-Identifier: GPL-3.0-or-later
// What combinations.cpp counts in space, in a file of its own because it takes long to compile.
#include "rhs/every_combination.hpp"

template spam::test::Tally spam::test::every_scheme<3>();
template spam::test::Tally spam::test::every_external<3>();
template void spam::test::potentials_need_plain_velocities<3>();
