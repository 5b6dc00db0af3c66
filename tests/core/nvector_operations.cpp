// SPDX-License-Identifier: GPL-3.0-or-later
// Our operations against those of SUNDIALS, and their independence of the number of threads.
#include <spam/core/nvector.hpp>
#include <spam/core/parallel.hpp>

#include <boost/test/unit_test.hpp>
#include <nvector/nvector_serial.h>

#include <cmath>
#include <functional>
#include <random>

using namespace spam;

namespace {

/// The same numbers once with our operations, once with the library's.
struct Twins {
    SundialsContext context;
    Vector ours, other, result;
    N_Vector stock, stock_other, stock_result;

    explicit Twins(std::size_t n)
        : ours(n, context),
          other(n, context),
          result(n, context),
          stock(N_VNew_Serial(static_cast<sunindextype>(n), context.get())),
          stock_other(N_VClone(stock)),
          stock_result(N_VClone(stock)) {
        std::mt19937_64 random(5);
        std::normal_distribution<double> g;
        for (std::size_t k = 0; k < n; ++k) {
            ours.span()[k] = entries(stock)[k] = g(random);
            other.span()[k] = entries(stock_other)[k] = 1.5 + std::tanh(g(random));
        }
    }
    ~Twins() {
        for (N_Vector v : {stock, stock_other, stock_result}) N_VDestroy(v);
    }

    double difference() const {
        double worst = 0.0;
        for (std::size_t k = 0; k < result.size(); ++k)
            worst = std::max(worst, std::abs(result.span()[k] - entries(stock_result)[k]));
        return worst;
    }
};

}  // namespace

BOOST_AUTO_TEST_CASE(elementwise_operations_agree) {
    for (const std::size_t n : {1UL, 7UL, 4096UL, 50001UL}) {
        Twins t(n);
        using Operation = std::function<void(N_Vector, N_Vector, N_Vector)>;
        const std::vector<Operation> operations{
            [](N_Vector x, N_Vector y, N_Vector z) { N_VLinearSum(0.3, x, -1.7, y, z); },
            [](N_Vector x, N_Vector y, N_Vector z) { N_VProd(x, y, z); },
            [](N_Vector x, N_Vector y, N_Vector z) { N_VDiv(x, y, z); },
            [](N_Vector x, N_Vector, N_Vector z) { N_VScale(-2.5, x, z); },
            [](N_Vector x, N_Vector, N_Vector z) { N_VAbs(x, z); },
            [](N_Vector, N_Vector y, N_Vector z) { N_VInv(y, z); },
            [](N_Vector x, N_Vector, N_Vector z) { N_VAddConst(x, 0.7, z); },
            [](N_Vector, N_Vector, N_Vector z) { N_VConst(3.25, z); },
            [](N_Vector x, N_Vector y, N_Vector z) {
                N_VConst(0.5, z);
                double c[3] = {0.25, 2.0, -3.0};
                N_Vector v[3] = {z, x, y};  // the result among the arguments
                N_VLinearCombination(3, c, v, z);
            }};
        for (const auto& operation : operations) {
            operation(t.ours.get(), t.other.get(), t.result.get());
            operation(t.stock, t.stock_other, t.stock_result);
            BOOST_TEST(t.difference() < 1e-15 * 20.0);
        }
    }
}

BOOST_AUTO_TEST_CASE(reductions_agree) {
    for (const std::size_t n : {1UL, 7UL, 4096UL, 50001UL}) {
        Twins t(n);
        const auto close = [](double a, double b) {
            return std::abs(a - b) <= 1e-13 * (1.0 + std::abs(b));
        };
        BOOST_TEST(close(N_VDotProd(t.ours.get(), t.other.get()) / static_cast<double>(n),
                         N_VDotProd(t.stock, t.stock_other) / static_cast<double>(n)));
        BOOST_TEST(
            close(N_VWrmsNorm(t.ours.get(), t.other.get()), N_VWrmsNorm(t.stock, t.stock_other)));
        BOOST_TEST(N_VMaxNorm(t.ours.get()) == N_VMaxNorm(t.stock));
        BOOST_TEST(N_VMin(t.ours.get()) == N_VMin(t.stock));
    }
}

BOOST_AUTO_TEST_CASE(norms_have_the_same_bits_with_any_number_of_threads) {
    Twins t(100003);
    std::vector<double> norms;
    for (const int threads : {1, 2, 3, 4}) {
        set_threads(threads);
        norms.push_back(N_VWrmsNorm(t.ours.get(), t.other.get()));
    }
    set_threads(1);
    for (const double norm : norms) BOOST_TEST(norm == norms.front());
}

BOOST_AUTO_TEST_CASE(clones_inherit_the_operations) {
    const SundialsContext context;
    const Vector v(3, context);
    const Vector copy = v.clone();
    BOOST_TEST((v.get()->ops->nvlinearsum == copy.get()->ops->nvlinearsum));
    N_Vector stock = N_VNew_Serial(3, context.get());
    BOOST_TEST((v.get()->ops->nvlinearsum != stock->ops->nvlinearsum));
    N_VDestroy(stock);
}
