// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// The dimensions that the library is compiled for, here alone.
///
/// what(1) what(2) what(3): `what` is a macro of the file that defines some templates' members.
#define SPAM_IN_EACH_DIMENSION(what) what(1) what(2) what(3)

/// SPAM_COMPILED(template class Name); instantiates Name<1>, Name<2>, Name<3>, and
/// SPAM_COMPILED(extern template class Name); says in the header that this is done elsewhere.
#define SPAM_COMPILED(name) \
    name<1>;                \
    name<2>;                \
    name<3>
