// SPDX-License-Identifier: GPL-3.0-or-later
// scalar_half_list/N: the sums of elastic_rhs as one writes them without thinking of registers and
// threads, and well: each pair once, both its particles' sums, particles sorted, one row of numbers
// for a particle, one row for its sums, a list of whole numbers. The yardstick for the engine.
#include "systems.hpp"
#include <spam/kernel/lucy.hpp>
#include <spam/neighbors/pair_list.hpp>

#include <algorithm>
#include <cmath>

namespace spam::bench {
namespace {

struct Particle {
    double x, y, vx, vy, m, rho, Axx, Ayy, Axy;
};
struct Sums {
    double gxx, gxy, gyx, gyy, rho_dot, ux, uy, ax, ay, power;
};

class HalfList {
  public:
    HalfList(const SmoothParticleModel<2>& model, std::span<const double> y)
        : model_(model),
          weight_(model.reach()),
          particles_(model.particles().size()),
          sums_(particles_.size()),
          grad_v_(particles_.size()) {
        const PairList<2> list(ConstState<2>(model.layout(), y).position(), 1.075 * model.reach(),
                               model.box());
        for (std::size_t i = 0; i < list.size(); ++i) {
            start_.push_back(entries_.size());
            for (const auto j : list.neighbours(i))
                if (j > i) entries_.push_back(j);
            numbers_.push_back(static_cast<std::uint32_t>(i));
        }
        start_.push_back(entries_.size());
    }
    std::size_t pairs() const { return entries_.size(); }

    void rates(std::span<const double> y, std::span<double> y_dot) {
        const ConstState<2> state(model_.layout(), y);
        const State<2> rate(model_.layout(), y_dot);
        pack(state);
        sweep();
        const double* const v = state.velocity().data();
        double *const x_dot = rate.position().data(), *const v_dot = rate.velocity().data();
        double *const rho_dot = rate.density().data(), *const e_dot = rate.energy().data();
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            const Sums& s = sums_[i];
            x_dot[2 * i] = v[2 * i] + 2.0 * s.ux;
            x_dot[2 * i + 1] = v[2 * i + 1] + 2.0 * s.uy;
            v_dot[2 * i] = s.ax;
            v_dot[2 * i + 1] = s.ay;
            rho_dot[i] = s.rho_dot;
            e_dot[i] = 0.5 * s.power;
            grad_v_[i].c = {2.0 * s.gxx, 2.0 * s.gxy, 2.0 * s.gyx, 2.0 * s.gyy};
        }
        law_.stress_rates(numbers_, grad_v_, state.stress().data(), state, rate);
    }

  private:
    void pack(const ConstState<2>& state) {
        const double *const x = state.position().data(), *const v = state.velocity().data(),
                            *const rho = state.density().data(),
                            *const sigma = state.stress().data();
        for (std::size_t i = 0; i < particles_.size(); ++i) {
            const double scale = 1.0 / (rho[i] * rho[i]);
            particles_[i] = {x[2 * i],
                             x[2 * i + 1],
                             v[2 * i],
                             v[2 * i + 1],
                             model_.particles().mass[i],
                             rho[i],
                             scale * sigma[3 * i],
                             scale * sigma[3 * i + 1],
                             scale * sigma[3 * i + 2]};
        }
    }

    void sweep() {
        std::fill(sums_.begin(), sums_.end(), Sums{});
        const double h2 = weight_.range() * weight_.range();
        for (std::size_t i = 0; i < particles_.size(); ++i) {
            const Particle pi = particles_[i];
            Sums si = sums_[i];
            for (std::size_t k = start_[i]; k < start_[i + 1]; ++k) {
                const Particle& pj = particles_[entries_[k]];
                const double x = pj.x - pi.x, y = pj.y - pi.y, r2 = x * x + y * y;
                if (r2 >= h2) continue;
                Sums& sj = sums_[entries_[k]];
                const double r = std::sqrt(r2), w = weight_.value(r);
                const double slope = weight_.minus_slope_over_r(r), gx = slope * x, gy = slope * y;
                const double vx = pj.vx - pi.vx, vy = pj.vy - pi.vy;
                const double inverse = 1.0 / (pi.rho + pj.rho);
                const double volume_i = pi.m * inverse, volume_j = pj.m * inverse;
                const double gxx = gx * vx, gxy = gx * vy, gyx = gy * vx, gyy = gy * vy;
                const double fx = (pi.Axx + pj.Axx) * gx + (pi.Axy + pj.Axy) * gy;
                const double fy = (pi.Axy + pj.Axy) * gx + (pi.Ayy + pj.Ayy) * gy;
                const double power = fx * vx + fy * vy;
                si.gxx += volume_j * gxx;
                si.gxy += volume_j * gxy;
                si.gyx += volume_j * gyx;
                si.gyy += volume_j * gyy;
                si.rho_dot -= pj.m * (gxx + gyy);
                si.ux += w * volume_j * vx;
                si.uy += w * volume_j * vy;
                si.ax += pj.m * fx;
                si.ay += pj.m * fy;
                si.power += pj.m * power;
                sj.gxx += volume_i * gxx;
                sj.gxy += volume_i * gxy;
                sj.gyx += volume_i * gyx;
                sj.gyy += volume_i * gyy;
                sj.rho_dot -= pi.m * (gxx + gyy);
                sj.ux -= w * volume_i * vx;
                sj.uy -= w * volume_i * vy;
                sj.ax -= pi.m * fx;
                sj.ay -= pi.m * fy;
                sj.power += pi.m * power;
            }
            sums_[i] = si;
        }
    }

    const SmoothParticleModel<2>& model_;
    Material<2> law_ = ElasticSolid::triangular_lattice();
    Lucy<2> weight_;
    std::vector<Particle> particles_;
    std::vector<Sums> sums_;
    std::vector<Mat<2>> grad_v_;
    std::vector<std::uint32_t> numbers_, entries_;
    std::vector<std::size_t> start_;
};

void scalar_half_list(benchmark::State& state) {
    ElasticSystem system(state.range(0), monaghan);
    system.rates();
    HalfList half(system.model, system.y);
    std::vector<double> y_dot(system.y.size());
    half.rates(system.y, y_dot);
    double worst = 0.0, size = 0.0;
    for (std::size_t k = 0; k < y_dot.size(); ++k) {
        worst = std::max(worst, std::abs(y_dot[k] - system.y_dot[k]));
        size = std::max(size, std::abs(y_dot[k]));
    }
    if (!(worst < 1e-12 * size)) return state.SkipWithError("the two right-hand sides differ");
    const Stopwatch watch;
    for ([[maybe_unused]] auto _ : state) half.rates(system.y, y_dot);
    count(state, system.model, watch.seconds() / static_cast<double>(state.iterations()));
}

}  // namespace

BENCHMARK(scalar_half_list)->Apply(sizes);

}  // namespace spam::bench
