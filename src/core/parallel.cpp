// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/parallel.hpp>

#include <omp.h>

namespace spam {

int set_threads(int threads) {
    if (threads > 0) omp_set_num_threads(threads);
    return omp_get_max_threads();
}

}  // namespace spam
