// SPDX-License-Identifier: GPL-3.0-or-later
// Dyson's ellipsoid, and the cloud of particles that stands for it.
#pragma once

#include "../common.hpp"
#include "../ranges.hpp"
#include <spam/material/gamma_gas.hpp>
#include <spam/rhs/ellipses.hpp>
#include <spam/rhs/own_ranges.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <charconv>
#include <limits>

namespace gas_cloud {

using namespace spam;

struct Parameters {
    int dimension = 3;
    std::string axes;
    std::optional<double> size{}, time{};
    Kernel kernel = Kernel::w4;
    double range = 3.0;
    Ranges ranges = Ranges::fixed;
    bool returns = false;
    bool rezone = false;
    std::optional<double> largest_volume{};
    double gradient_axes = 0.0;
    std::optional<double> aspect{};  ///< none
};

/// The numbers of --axes.
inline std::vector<double> numbers_of(const Parameters& p) {
    std::vector<double> axes;
    std::string words = p.axes.empty() ? (p.dimension == 3 ? "4,2,1" : "2,1") : p.axes;
    for (bool more = true; more;) {
        const auto comma = words.find(',');
        const std::string word = words.substr(0, comma);
        double value = 0.0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc{} || end != word.data() + word.size() ||
            !(value >= 0.1 && value <= 10.0))
            refuse("axes: '{}' is no number between 0.1 and 10; give the semi-axes as in --axes {}",
                   word, p.dimension == 3 ? "4,2,1" : "2,1");
        axes.push_back(value);
        more = comma != std::string::npos;
        if (more) words = words.substr(comma + 1);
    }
    if (static_cast<int>(axes.size()) != p.dimension)
        refuse("axes: {} numbers for {} dimensions; give one for each", axes.size(), p.dimension);
    return axes;
}

/// Dyson's semi-axes, and how fast they grow, in units of the shortest one and the speed of sound.
template <int Dim>
class Dyson {
  public:
    explicit Dyson(const Point<Dim>& axes) : start_(axes) {}

    /// By RK4, with an error below 1e-9.
    Point<Dim> axes(double t) const {
        const int steps = 1 + static_cast<int>(std::ceil(200.0 * t));
        const double h = t / steps;
        Point<Dim> a = start_, v = Point<Dim>::Zero();
        for (int k = 0; k < steps; ++k) {
            const Point<Dim> k1 = pull(a), k2 = pull(a + 0.5 * h * v),
                             k3 = pull(a + 0.5 * h * v + 0.25 * h * h * k1),
                             k4 = pull(a + h * v + 0.5 * h * h * k2);
            a += h * v + h * h / 6.0 * (k1 + k2 + k3);
            v += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        }
        return a;
    }

  private:
    Point<Dim> pull(const Point<Dim>& a) const {
        return (2.0 * start_.prod() / a.prod()) * a.cwiseInverse();
    }
    Point<Dim> start_;
};

template <int Dim>
struct Cloud : Variant<Dim> {
    Point<Dim> axes;   ///< by the shortest
    double size;       ///< of the shortest
    double half_time;  ///< where velocities are reversed; infinite where they are not

    /// a_i by the shortest, where they should be.
    Point<Dim> exact(double t) const {
        return Dyson<Dim>(axes).axes(std::min(t, 2.0 * half_time - t) / size);
    }
};

/// The gas of these particles; at rest on its isentrope in `y0`, where that is wanted.
template <int Dim>
std::shared_ptr<ParticleModel<Dim>> gas_of(const Parameters& p, Particles<Dim> particles,
                                           std::vector<double>* y0 = nullptr) {
    auto model = std::make_shared<ParticleModel<Dim>>(std::move(particles));
    const Fluid gas{GammaGas{2.0}};
    const auto begin = [&](auto& law) {
        if (y0 == nullptr) return;
        const Points<Dim> x = model->particles().reference_position;
        *y0 = law.start(x, Points<Dim>::Zero(Dim, x.cols()), 1.0);
        const State<Dim> state(model->layout(), *y0);
        const auto rho = model->density(*y0);
        for (Eigen::Index i = 0; i < x.cols(); ++i)
            state.energy()(0, i) = 0.5 * rho[static_cast<std::size_t>(i)];
    };
    if (p.ranges == Ranges::density)
        begin(
            model->template add_term<OwnRanges<Dim>>(gas, VariableRangeScheme{p.range, p.kernel}));
    else if (p.ranges == Ranges::ellipses)
        begin(model->template add_term<Ellipses<Dim>>(
            gas, EllipseScheme{.range = p.range,
                               .kernel = p.kernel,
                               .gradient_share = p.gradient_axes,
                               .largest_aspect =
                                   p.aspect.value_or(std::numeric_limits<double>::infinity())}));
    else
        begin(model->template add_term<SmoothParticles<Dim>>(
            gas, Scheme{.density = Density::summed, .kernel = p.kernel, .range = p.range}));
    return model;
}

/// Sites inside of the ellipsoid, the middle of the lattice's cell at its centre or a site.
template <int Dim>
Cloud<Dim> make_cloud(const Parameters& p, double size) {
    Cloud<Dim> cloud;
    const auto numbers = numbers_of(p);
    for (int a = 0; a < Dim; ++a) cloud.axes[a] = numbers[static_cast<std::size_t>(a)];
    cloud.axes /= cloud.axes.minCoeff();
    cloud.size = size;
    std::array<int, Dim> cells;
    for (int a = 0; a < Dim; ++a)
        cells[static_cast<std::size_t>(a)] = 2 * static_cast<int>(std::ceil(size * cloud.axes[a]));
    const Points<Dim> sites = centred<Dim>(square_lattice<Dim>(cells));
    std::vector<Eigen::Index> inside;
    const auto depth = [&](const auto& x) {
        return 1.0 - (x.array() / (size * cloud.axes.array())).matrix().squaredNorm();
    };
    for (Eigen::Index k = 0; k < sites.cols(); ++k)
        if (depth(sites.col(k)) > 0.0) inside.push_back(k);
    auto particles = one_body(make_particles<Dim>(sites(Eigen::all, inside), 1.0));
    for (std::size_t i = 0; i < particles.size(); ++i)
        particles.mass[i] = depth(particles.reference_position.col(static_cast<Eigen::Index>(i)));
    cloud.model = gas_of<Dim>(p, std::move(particles), &cloud.y0);
    return cloud;
}

/// By second moments about the centre of mass.
template <int Dim>
Point<Dim> semi_axes(const Model<Dim>& model, std::span<const double> y, double size) {
    const ConstState<Dim> state(model.layout(), y);
    const auto& mass = model.particles().mass;
    const Point<Dim> centre = mean_by_mass<Dim>(mass, state.position());
    Points<Dim> squares = (state.position().colwise() - centre).array().square();
    return ((Dim + 4.0) * mean_by_mass<Dim>(mass, squares)).cwiseSqrt() / size;
}

}  // namespace gas_cloud
