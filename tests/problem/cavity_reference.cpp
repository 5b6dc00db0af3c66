// SPDX-License-Identifier: GPL-3.0-or-later
// The tables that the problem cavity compares with, found again by finite differences: stream function and
// vorticity, three grids, extrapolated. Ghia's is off the solution by more than particles are.
#include "cavity/centre_line.hpp"

#include <Eigen/SparseLU>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

using namespace cavity;

namespace {

/// Lap psi = -omega, u . grad omega = Lap omega/Re in the unit square, u = (psi_y, -psi_x), psi = 0 on all
/// sides; omega there by Thom's formula from the lid's velocity. Central differences, Newton's method.
class Stream {
  public:
    Stream(int cells, double reynolds)
        : N_(cells),
          h_(1.0 / cells),
          nu_(1.0 / reynolds),
          unknowns_((cells - 1) * (cells - 1)),
          q_(Eigen::VectorXd::Zero(2 * unknowns_)) {
        for (int step = 0; step < 30 && newton() > 1e-8; ++step) {
        }
    }

    /// psi on the line x = 1/2, from the floor to the lid.
    std::vector<double> on_centre_line() const {
        std::vector<double> line;
        for (int j = 0; j <= N_; ++j) line.push_back(psi(N_ / 2, j));
        return line;
    }

  private:
    bool inside(int i, int j) const { return i > 0 && i < N_ && j > 0 && j < N_; }
    int number(int i, int j) const { return (i - 1) * (N_ - 1) + j - 1; }
    double psi(int i, int j) const { return inside(i, j) ? q_[number(i, j)] : 0.0; }
    double omega(int i, int j) const {
        if (inside(i, j)) return q_[unknowns_ + number(i, j)];
        const int a = std::clamp(i, 1, N_ - 1), b = std::clamp(j, 1, N_ - 1);
        return -2.0 * psi(a, b) / (h_ * h_) - (j == N_ ? 2.0 / h_ : 0.0);
    }

    /// One step; returns the residual before it.
    double newton() {
        Eigen::VectorXd residual(2 * unknowns_);
        std::vector<Eigen::Triplet<double>> slopes;
        const double square = h_ * h_;
        for (int i = 1; i < N_; ++i)
            for (int j = 1; j < N_; ++j) {
                const int k = number(i, j), w = unknowns_ + k;
                const double u = (psi(i, j + 1) - psi(i, j - 1)) / (2.0 * h_),
                             v = (psi(i - 1, j) - psi(i + 1, j)) / (2.0 * h_);
                const double w_x = (omega(i + 1, j) - omega(i - 1, j)) / (2.0 * h_),
                             w_y = (omega(i, j + 1) - omega(i, j - 1)) / (2.0 * h_);
                residual[k] = omega(i, j) - 4.0 * psi(i, j) / square;
                residual[w] = u * w_x + v * w_y + 4.0 * nu_ * omega(i, j) / square;
                slopes.emplace_back(k, k, -4.0 / square);
                slopes.emplace_back(k, w, 1.0);
                slopes.emplace_back(w, w, 4.0 * nu_ / square);
                for (const int sign : {1, -1})
                    for (const bool along_x : {true, false}) {
                        const int a = i + (along_x ? sign : 0), b = j + (along_x ? 0 : sign);
                        residual[k] += psi(a, b) / square;
                        residual[w] -= nu_ * omega(a, b) / square;
                        const double by_omega =
                            -nu_ / square + sign * (along_x ? u : v) / (2.0 * h_);
                        if (!inside(a, b)) {
                            slopes.emplace_back(w, k, -2.0 / square * by_omega);
                            continue;
                        }
                        slopes.emplace_back(k, number(a, b), 1.0 / square);
                        slopes.emplace_back(w, unknowns_ + number(a, b), by_omega);
                        slopes.emplace_back(w, number(a, b),
                                            sign * (along_x ? -w_y : w_x) / (2.0 * h_));
                    }
            }
        Eigen::SparseMatrix<double> jacobian(2 * unknowns_, 2 * unknowns_);
        jacobian.setFromTriplets(slopes.begin(), slopes.end());
        Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(jacobian);
        BOOST_REQUIRE(factors.info() == Eigen::Success);
        q_ -= Eigen::VectorXd(factors.solve(residual));
        return residual.cwiseAbs().maxCoeff();
    }

    int N_;
    double h_, nu_;
    int unknowns_;
    Eigen::VectorXd q_;
};

/// psi_y at height y: of the polynomial through six values.
double velocity(const std::vector<double>& psi, double y) {
    const int N = static_cast<int>(psi.size()) - 1;
    const double s = y * N;
    const int first = std::clamp(static_cast<int>(std::floor(s)) - 2, 0, N - 5);
    double slope = 0.0;
    for (int a = 0; a < 6; ++a)
        for (int b = 0; b < 6; ++b) {
            if (b == a) continue;
            double part = 1.0 / (a - b);
            for (int c = 0; c < 6; ++c)
                if (c != a && c != b) part *= (s - first - c) / (a - c);
            slope += psi[static_cast<std::size_t>(first + a)] * part * N;
        }
    return slope;
}

}  // namespace

BOOST_AUTO_TEST_CASE(tables_of_the_cavity) {
    std::vector<std::vector<double>> psi;
    for (const int cells : {24, 48, 96}) psi.push_back(Stream(cells, 100.0).on_centre_line());
    const auto extrapolated = [&](double y) {
        const double middle = velocity(psi[1], y), fine = velocity(psi[2], y);
        return (4.0 * fine - middle) / 3.0;
    };
    double off = 0.0, change = 0.0, before = 0.0, ghias = 0.0;
    for (const auto& [y, u] : converged()) {
        off = std::max(off, std::abs(extrapolated(y) - u));
        change = std::max(change, std::abs(velocity(psi[2], y) - velocity(psi[1], y)));
        before = std::max(before, std::abs(velocity(psi[1], y) - velocity(psi[0], y)));
    }
    for (const auto& [y, u] : ghia()) ghias = std::max(ghias, std::abs(extrapolated(y) - u));
    BOOST_TEST(std::log2(before / change) > 1.8);
    BOOST_TEST(off < 4e-4);
    BOOST_TEST(ghias > 0.004);
    BOOST_TEST(ghias < 0.006);
}
