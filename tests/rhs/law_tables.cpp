// SPDX-License-Identifier: GPL-3.0-or-later
#include "rhs/law_tables.hpp"

namespace spam::test {

const Laws<2> plane_laws{{"Elements", [](Sample<2>& s, const Scheme&) {
                              add_term<Elements>(s, mesh_of(s.model.particles()),
                                                 std::vector<Elements::Material>{
                                                     {YieldingSolid<PlaneVonMises>(
                                                          elastic<PlaneVonMises>(s), hardening(s)),
                                                      s.density(),
                                                      {0.1, 0.1}}});
                          }}};

template const Laws<2>& with_scheme<2>();
template const Laws<2>& without_scheme<2>();
template const std::map<std::string, Add<2>>& further<2>();
template const std::map<std::string, Add<2>>& externals<2>();

}  // namespace spam::test
