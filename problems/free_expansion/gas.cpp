// SPDX-License-Identifier: GPL-3.0-or-later
#include "gas.hpp"

#include "entropy.hpp"
#include <spam/io/image_file.hpp>
#include <spam/io/snapshot.hpp>
#include <spam/kernel/weight_integrals.hpp>
#include <spam/material/isentropic_gas.hpp>
#include <spam/rhs/own_ranges.hpp>

namespace free_expansion {
namespace {

template <class Number, int Dim>
std::array<Number, Dim> all_along(Number n) {
    std::array<Number, Dim> all;
    all.fill(n);
    return all;
}

/// Nodes `spacing` apart or a little closer.
template <int Dim>
FieldGrid<Dim> grid_of(const Gas<Dim>& gas, double spacing) {
    const int nodes = static_cast<int>(std::ceil(gas.side() / spacing));
    // Of mirrors, the middles of cells between them.
    const Box<Dim> room(all_along<double, Dim>(gas.side()));
    FieldGrid<Dim> grid = FieldGrid<Dim>::over(room, all_along<int, Dim>(nodes));
    for (int a = 0; a < Dim; ++a)
        if (!gas.model->box().periodic(a)) grid.origin[a] += 0.5 * grid.spacing[a];
    return grid;
}

/// The model and its state at rest at `x`; no state where the case is only described.
template <int Dim>
std::pair<std::unique_ptr<Model<Dim>>, std::vector<double>> begun(Particles<Dim> particles,
                                                                  const Points<Dim>& x,
                                                                  const Box<Dim>& box,
                                                                  const Parameters& p) {
    const Points<Dim> at_rest = Points<Dim>::Zero(Dim, x.cols());
    const Fluid matter{law_of(Dim)};
    const auto started = [&](auto model) {
        auto y0 = p.only_described ? std::vector<double>{} : model->state(x, at_rest);
        return std::pair<std::unique_ptr<Model<Dim>>, std::vector<double>>(std::move(model),
                                                                           std::move(y0));
    };
    if (p.ranges == Ranges::density)
        return started(std::make_unique<VariableRangeModel<Dim>>(
            std::move(particles), matter, VariableRangeScheme{p.range, p.kernel}, box));
    return started(std::make_unique<FluidModel<Dim>>(
        std::move(particles), matter,
        Scheme{.density = Density::summed, .kernel = p.kernel, .range = p.range}, box));
}

}  // namespace

AnyEquationOfState law_of(int dim) {
    if (dim == 1) return IsentropicGas{1.0 / 3.0, 1.0, 3.0};
    if (dim == 3) return IsentropicGas{0.6, 1.0, 5.0 / 3.0};
    return LucyGas{};
}

template <int Dim>
double step_for(const Parameters& p) {
    const auto steepest = [](Kernel kernel, double range) {
        return steepest_wave<Dim>(weight_function<Dim>(to_string(kernel), range));
    };
    const double longest = Dim == 1 ? 0.125 : Dim == 2 ? 0.25 : 0.2;
    const double wanted = 1.001 * longest * steepest(Kernel::lucy, Dim == 3 ? 4.0 : 6.0) /
                          steepest(p.kernel, p.range);
    double step = longest;
    while (step > wanted) step *= 0.5;
    return step;
}

template <int Dim>
Gas<Dim> make_gas(int cells, const Parameters& p) {
    if (!(cells > p.range))
        refuse(
            "cells: the box of {0} (twice --cells {1}) is not wider than "
            "twice --range {2:g}; "
            "use at least --cells {3}, or a shorter range",
            2 * cells, cells, p.range, static_cast<int>(std::floor(p.range)) + 1);
    // The one at a corner has few neighbours: about half of the density on a line, a quarter in the plane, an eighth
    // in space.
    if (p.ranges == Ranges::density && !(cells > 2.0 * p.range))
        refuse(
            "cells: with --ranges density particles at corners reach twice as far as "
            "--range {0:g}, and the box of {1} (twice --cells {2}) is not wider "
            "than twice that; use at least --cells {3}, or a shorter range",
            p.range, 2 * cells, cells, static_cast<int>(std::floor(2.0 * p.range)) + 1);
    const Box<Dim> room(all_along<double, Dim>(2.0 * cells));
    Points<Dim> sites = square_lattice<Dim>(all_along<int, Dim>(cells));
    sites.array() += 0.5 * (cells + 1.0);
    // Numbered alike whatever the walls: so that they draw the same offsets.
    auto particles = make_particles<Dim>(sites, 1.0, 1.0, room);
    const auto box = p.sides->box<Dim>(Point<Dim>::Zero(), Point<Dim>::Constant(2.0 * cells),
                                       {{"walls", std::string(to_string(p.walls))}});
    std::mt19937_64 random(static_cast<std::uint64_t>(p.seed));
    Points<Dim> x = particles.reference_position;
    for (Eigen::Index i = 0; i < x.cols(); ++i)  // the same numbers with every library
        for (int a = 0; a < Dim; ++a) x(a, i) += 0.1 * (drawn(random) - 0.5);
    auto [model, y0] = begun<Dim>(std::move(particles), x, box, p);
    Gas<Dim> gas{{}, cells, weight_function<Dim>(to_string(p.kernel), p.range)};
    gas.model = std::move(model);
    gas.y0 = std::move(y0);
    gas.drawn = states_at<Dim>(drawn_at, cells);
    return gas;
}

template <int Dim>
std::vector<Column<Dim>> entropy_columns(const Gas<Dim>& gas) {
    // An isentropic gas: e(rho), also where the energy equation shares the same sum out otherwise.
    const auto e_of = [law = law_of(Dim)](double rho) { return law.cold_energy(rho); };
    const auto particles_now = [e_of, weight = gas.weight](const Model<Dim>& model,
                                                           std::span<const double> y) {
        const ConstState<Dim> state(model.layout(), y);
        const auto rho = model.density(y);
        std::vector<double> e(rho.size());
        std::transform(rho.begin(), rho.end(), e.begin(), e_of);
        return GasEntropy<Dim>(weight, model.particles().mass, state.position(), state.velocity(),
                               rho, e, model.box());
    };
    // The columns of a row look at the same state: what one has made is there for the others.
    struct Latest {
        std::vector<double> y{};
        std::optional<GasEntropy<Dim>> entropy{};
    };
    const auto latest = std::make_shared<Latest>();
    const auto of_state = [latest, particles_now](
                              const Model<Dim>& model,
                              std::span<const double> y) -> const GasEntropy<Dim>& {
        if (!latest->entropy ||
            !std::equal(y.begin(), y.end(), latest->y.begin(), latest->y.end())) {
            latest->y.assign(y.begin(), y.end());
            latest->entropy.emplace(particles_now(model, y));
        }
        return *latest->entropy;
    };
    using Measure = std::function<double(const GasEntropy<Dim>&)>;
    const auto column = [&](const char* name, const Measure& entropy) {
        // Of the start only when the first row is due: a dry run has no use for it.
        auto start = std::make_shared<std::optional<double>>();
        return Column<Dim>{name, [=, &gas](const Model<Dim>& model, std::span<const double> y) {
                               if (!*start) *start = entropy(of_state(*gas.model, gas.y0));
                               return (entropy(of_state(model, y)) - **start) /
                                      (Dim * std::log(2.0));
                           }};
    };
    // A third of the range is as good as finer ones to 1e-4.
    const auto grid = grid_of(gas, gas.weight.range() / 3.0);
    return {
        column("entropy_sum", [](const auto& s) { return s.of_particles(Heat::fluctuation); }),
        column("entropy_grid",
               [=](const auto& s) { return s.on_grid(grid, Heat::fluctuation, e_of); }),
        column("entropy_full_v2", [](const auto& s) { return s.of_particles(Heat::all_motion); })};
}

template <int Dim>
Fields<Dim> fields_of(const Gas<Dim>& gas, const Points<Dim>& position, const Points<Dim>& v,
                      bool of_cut) {
    const auto images = images_behind_walls<Dim>(gas.model->box(), gas.weight.range(), position, v);
    Points<Dim> all(Dim, v.cols() + images.count());
    all << position, images.position;
    std::vector<double> mass = gas.model->particles().mass;
    for (const auto owner : images.owner) mass.push_back(mass[static_cast<std::size_t>(owner)]);
    Eigen::MatrixXd carried(Dim + 2, all.cols());
    carried.row(0).setOnes();
    carried.template bottomRows<Dim>() << v, images.velocity;
    carried.row(1) = carried.template bottomRows<Dim>().colwise().squaredNorm();
    // Smooth contours of small gases, too; all of space by no more nodes than the entropy needs.
    const double fine = std::min(1.0, gas.side() / 96.0);
    Fields<Dim> fields{
        grid_of(gas, Dim < 3 || of_cut ? fine : gas.weight.range() / 3.0), {}, {}, {}, {}};
    if (Dim == 3 && of_cut) fields.grid.origin[2] = gas.cut(), fields.grid.nodes[2] = 1;
    const FieldInterpolation<Dim> interpolation(gas.weight, mass, all, gas.model->box());
    const std::size_t nodes = fields.grid.size();
    fields.velocity.setZero(Dim, static_cast<Eigen::Index>(nodes));
    for (auto* values : {&fields.density, &fields.kinetic, &fields.hidden}) values->reserve(nodes);
    // In pieces: of all nodes at once, places and sums would take more room than the fields.
    constexpr std::size_t piece = 65536;
    for (std::size_t first = 0; first < nodes; first += piece) {
        const Eigen::MatrixXd sum =
            interpolation.sum(carried, fields.grid.points(first, std::min(piece, nodes - first)));
        for (Eigen::Index k = 0; k < sum.cols(); ++k) {
            const double rho = sum(0, k);
            auto velocity = fields.velocity.col(static_cast<Eigen::Index>(first) + k);
            if (rho > 0.0) velocity = sum.col(k).template tail<Dim>() / rho;
            fields.density.push_back(rho);
            fields.kinetic.push_back(0.5 * sum(1, k));
            fields.hidden.push_back(
                rho > 0.0  // of one particle alone: nothing but rounding, which may be negative
                    ? 0.5 * std::max(0.0, sum(1, k) / rho - velocity.squaredNorm())
                    : 0.0);
        }
    }
    return fields;
}

template <int Dim>
void write_fields(const RunFolder& folder, Gas<Dim>& gas, double t, std::span<const double> y) {
    const ConstState<Dim> state(gas.model->layout(), y);
    Fields<Dim> fields = fields_of<Dim>(gas, state.position(), state.velocity());
    // There may be four nodes a particle: nothing of them is held twice.
    std::vector<ImageField> images;
    const auto add = [&](const char* name, std::vector<double>& values) {
        images.push_back({name, Eigen::RowVectorXd::Map(values.data(),
                                                        static_cast<Eigen::Index>(values.size()))});
        values = {};
    };
    add("density", fields.density);
    images.push_back({"velocity", std::move(fields.velocity)});
    add("kinetic_energy", fields.kinetic);
    add("velocity_fluctuation", fields.hidden);
    const auto name = [](std::size_t k) { return fmt::format("fields_{:04}", k); };
    write_image(folder, name(gas.field_times.size()), t, gas.model->box(), fields.grid, images);
    gas.field_times.push_back(t);
    std::vector<std::pair<double, std::string>> files;
    for (std::size_t k = 0; k < gas.field_times.size(); ++k)
        if (std::filesystem::exists(folder / (name(k) + ".vti")))  // not all, where a run went on
            files.emplace_back(gas.field_times[k], name(k) + ".vti");
    write_file_series(folder, "fields", files);
}

#define SPAM_INSTANTIATE(D)                                                                \
    template double step_for<D>(const Parameters&);                                        \
    template Gas<D> make_gas(int, const Parameters&);                                      \
    template std::vector<Column<D>> entropy_columns(const Gas<D>&);                        \
    template Fields<D> fields_of(const Gas<D>&, const Points<D>&, const Points<D>&, bool); \
    template void write_fields(const RunFolder&, Gas<D>&, double, std::span<const double>);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace free_expansion
