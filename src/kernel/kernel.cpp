// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/kernel/kernel.hpp>

#include <array>

namespace spam {

const std::vector<Kernel>& all_kernels() {
    static const std::vector<Kernel> all{Kernel::lucy, Kernel::monaghan, Kernel::w2,
                                         Kernel::w3,   Kernel::w4,       Kernel::w5,
                                         Kernel::w6,   Kernel::w7,       Kernel::w8};
    return all;
}

std::string_view to_string(Kernel kernel) {
    static constexpr std::array<std::string_view, 9> names{"lucy", "monaghan", "w2", "w3", "w4",
                                                           "w5",   "w6",       "w7", "w8"};
    return names[static_cast<std::size_t>(kernel)];
}

}  // namespace spam
