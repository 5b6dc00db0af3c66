// SPDX-License-Identifier: GPL-3.0-or-later
// The temperature of few molecules, whose mean velocity takes a part in their fluctuations.
#include "molecules.hpp"

namespace md_fields {
namespace {

using State = std::span<const double>;

const double ranges[] = {3.0, 4.0, 6.0};

/// True, of a system whose momentum is zero.
double temperature_of(const Model<2>& model, State y) {
    const auto v = ConstState<2>(model.layout(), y).velocity();
    return 0.5 * v.squaredNorm() / static_cast<double>(v.cols() - 1);
}

/// Where it is measured: 16 x 16.
Points<2> sampled_places(const Box<2>& box) { return FieldGrid<2>::over(box, {16, 16}).points(); }

/// sum w^2/(sum w)^2, the mean over places by sum w.
double part_of_mean_velocity(const AnyWeight<2>& weight, const Box<2>& box, const Points<2>& x,
                             const Points<2>& places) {
    double part = 0.0, all = 0.0;
    for (const auto& place : places.colwise()) {
        double first = 0.0, second = 0.0;
        for (const auto& at : x.colwise()) {
            const double r2 = box.nearest(place - at).squaredNorm();
            if (!(r2 < weight.range() * weight.range())) continue;
            const double w = weight.value(std::sqrt(r2));
            first += w;
            second += w * w;
        }
        part += second / first;
        all += first;
    }
    return part / all;
}

/// Mean over the last four fifths of a run, and its error by the means of its parts.
struct Mean {
    double value = 0.0, error = 0.0;
    explicit Mean(const std::vector<double>& rows) {
        constexpr int parts = 16;
        const std::size_t first = rows.size() / 5, each = (rows.size() - first) / parts;
        for (std::size_t part = 0; part < parts; ++part) {
            double mean = 0.0;
            for (std::size_t k = 0; k < each; ++k)
                mean += rows[first + part * each + k] / static_cast<double>(each);
            value += mean / parts;
            error += mean * mean / parts;
        }
        error = std::sqrt(std::max(0.0, error - value * value) / (parts - 1.0));
    }
};

}  // namespace

std::vector<Column<2>> columns_of(const Molecules& one, const Parameters& p) {
    std::vector<Column<2>> columns{{"temperature", temperature_of}};
    for (const double range : ranges) {
        const auto weight = weight_function<2>(spam::to_string(p.kernel), range);
        columns.push_back({fmt::format("temperature_{:g}", range),
                           [&one, weight](const Model<2>& model, State y) {
                               const MolecularFields<2> fields(weight, *one.model, y);
                               const auto values =
                                   fields.at(sampled_places(model.box()), BondStress::at_particles);
                               return values.temperature.dot(values.density) /
                                      values.density.sum() / temperature_of(model, y);
                           }});
        columns.push_back(
            {fmt::format("expected_{:g}", range), [weight](const Model<2>& model, State y) {
                 const Box<2>& box = model.box();
                 const Points<2> x = box.wrapped(ConstState<2>(model.layout(), y).position());
                 return 1.0 - part_of_mean_velocity(weight, box, x, sampled_places(box));
             }});
    }
    return columns;
}

Observer<2> draw_velocities(Molecules& one, int seed, double interval) {
    return {.revise =
                [&one, seed, interval](double t, Model<2>& model, std::span<double> y) {
                    if (t < one.drawn_at + interval - 1e-9) return false;
                    one.drawn_at += interval;
                    const ::spam::State<2> state(model.layout(), y);
                    Points<2> v = Points<2>::Zero(2, state.velocity().cols());
                    displace<2>(v, 1.0, seed + ++one.draws);
                    v = centred<2>(v);
                    state.velocity() = state.velocity().norm() / v.norm() * v;
                    return true;
                },
            .memory = [&one](Archive& archive) { archive(one.draws, one.drawn_at); }};
}

void report_temperature(const Findings& findings, const RunRecord& run, bool known) {
    const double others[] = {0.9072, 0.9479, 0.9768};
    if (run.history.rows().size() < 20) return;
    findings.measure("mean_temperature", Mean(run.history.column("temperature")).value);
    for (std::size_t k = 0; k < std::size(ranges); ++k) {
        const std::string name = fmt::format("temperature_{:g}", ranges[k]);
        const Mean found(run.history.column(name));
        const Mean expected(run.history.column(fmt::format("expected_{:g}", ranges[k])));
        findings.measure("mean_" + name + "_error", found.error, "by sixteen parts of the time");
        findings.claim("mean_" + name, found.value, expected.value, 4.0 * found.error,
                       "1 - sum w^2/(sum w)^2; four errors of the mean", run.complete);
        findings.claim("mean_" + name + "_known", found.value, others[k], 4.0 * found.error,
                       "another program; four errors of the mean", known);
    }
}

}  // namespace md_fields
