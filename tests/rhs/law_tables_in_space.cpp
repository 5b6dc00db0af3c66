// SPDX-License-Identifier: GPL-3.0-or-later
#include "rhs/law_tables.hpp"

namespace spam::test {

template const Laws<3>& with_scheme<3>();
template const Laws<3>& without_scheme<3>();
template const std::map<std::string, Add<3>>& further<3>();
template const std::map<std::string, Add<3>>& externals<3>();

}  // namespace spam::test
