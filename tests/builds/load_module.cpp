// SPDX-License-Identifier: GPL-3.0-or-later
// The module can be loaded, all its symbols found at once, into a program that knows nothing of libspam.
#include <boost/test/unit_test.hpp>
#include <dlfcn.h>

BOOST_AUTO_TEST_CASE(a_module_that_holds_libspam_runs) {
    void* const module = dlopen(SPAM_MODULE, RTLD_NOW | RTLD_LOCAL);
    BOOST_TEST_REQUIRE(module != nullptr, dlerror());
    const auto run = reinterpret_cast<double (*)()>(dlsym(module, "spam_module_run"));
    BOOST_TEST_REQUIRE((run != nullptr));
    const double change = run();
    BOOST_TEST(change > 1e-3);
    BOOST_TEST(change < 10.0);
}
