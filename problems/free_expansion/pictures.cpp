// SPDX-License-Identifier: GPL-3.0-or-later
#include "gas.hpp"
#include <spam/picture/film.hpp>

#include <numeric>

namespace free_expansion {
namespace {

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// States that came about, each close to its time.
template <int Dim>
std::vector<const NearestState<Dim>*> reached(const Gas<Dim>& gas) {
    std::vector<const NearestState<Dim>*> states;
    for (const NearestState<Dim>& state : gas.drawn)
        if (state.t > 0.0 && std::abs(state.t - state.wanted) <= 0.05 * gas.cells)
            states.push_back(&state);
    return states;
}

template <int Dim>
ContourRoom room_of(const Gas<Dim>& gas) {
    return {Point<2>::Zero(), Point<2>::Constant(gas.side())};
}

/// In space those within half a spacing of the cut.
template <int Dim>
ContourPanel dots(const Gas<Dim>& gas, const Points<Dim>& position) {
    const Points<Dim> all = gas.model->box().wrapped(position);
    std::vector<Eigen::Index> shown;
    for (Eigen::Index i = 0; i < all.cols(); ++i)
        if (Dim == 2 || std::abs(all(Dim - 1, i) - gas.cut()) < 0.5) shown.push_back(i);
    const Points<2> places = all.template topRows<2>()(Eigen::all, shown);
    return {.title = "", .grid = {}, .particles = places, .dot = 0.8};
}

template <int Dim>
ContourPanel tones(const FieldGrid<Dim>& grid, const std::vector<double>& values) {
    const FieldGrid<2> plane{grid.origin.template head<2>(),
                             grid.spacing.template head<2>(),
                             {grid.nodes[0], grid.nodes[1]}};
    return {.title = "", .grid = plane, .values = values, .particles = {}, .level = mean(values)};
}

/// [HH01] Fig. 2: rows of particles, density and kinetic energy.
template <int Dim>
void draw_fields(Session& session, const Gas<Dim>& gas) {
    std::vector<ContourPanel> rows[3];
    for (const auto* state : reached(gas)) {
        const auto fields = fields_of(gas, state->position, state->velocity, true);
        const bool first = rows[0].empty();
        rows[0].push_back(dots(gas, state->position));
        rows[0].back().title = fmt::format("t = {:.4g}", state->t);
        rows[1].push_back(tones(fields.grid, fields.density));
        rows[2].push_back(tones(fields.grid, fields.kinetic));
        if (!first) continue;
        rows[0].back().side = "particles";
        rows[1].back().side = "density";
        rows[2].back().side = "kinetic energy";
    }
    if (rows[0].empty()) return;
    std::vector<ContourPanel> panels;
    for (const auto& row : rows) panels.insert(panels.end(), row.begin(), row.end());
    draw_contours(session, "expansion",
                  fmt::format("Free expansion of {} smooth particles{}; white: above the average",
                              gas.particles(), Dim == 3 ? ", a cut through the middle" : ""),
                  panels, rows[0].size(), room_of(gas));
}

/// How the density fluctuates, wave length by wave length.
template <int Dim>
void draw_spectrum(Session& session, const Gas<Dim>& gas) {
    LogLogPicture picture{fmt::format("Density of {} smooth particles by waves", gas.particles()),
                          {{"", "wave number k", "part of <ρ²> in a shell of |k|", {}}},
                          1,
                          {},
                          "",
                          false};
    for (const auto* state : reached(gas)) {
        const auto fields = fields_of(gas, state->position, state->velocity);
        const WaveSpectrum spectrum = wave_spectrum(fields.grid, fields.density);
        LogLogCurve curve{picture.key.size(), false, {}, {}};
        const double all = std::accumulate(spectrum.power.begin(), spectrum.power.end(), 0.0);
        const double shortest = std::numbers::pi / fields.grid.spacing.maxCoeff();
        for (std::size_t k = 1; k < spectrum.k.size() && spectrum.k[k] < std::min(3.0, shortest);
             ++k)
            add_point(curve, spectrum.k[k], spectrum.power[k] / all);
        picture.panels[0].curves.push_back(std::move(curve));
        picture.key.push_back(fmt::format("t = {:.4g}", state->t));
    }
    if (!picture.key.empty()) draw_log_log(session, "spectrum", picture);
}

const char* title_of(const std::string& column, bool short_one) {
    if (column == "entropy_sum") return short_one ? "particles" : "sum over particles";
    if (column == "entropy_grid") return short_one ? "grid" : "integral over a grid";
    return short_one ? "full v²" : "full v² in place of its fluctuation";
}

template <int Dim>
Curve entropy_curve(const Gas<Dim>& gas, const History& h, const std::string& column,
                    const std::string& title, int style) {
    return {title, divided(h.column("t"), gas.cells), h.column(column), Mark::line, style};
}

}  // namespace

template <int Dim>
void draw_entropy(Session& session, const std::vector<Gas<Dim>>& gases,
                  const std::vector<RunRecord>& runs) {
    const std::vector<std::string> columns{"entropy_sum", "entropy_grid", "entropy_full_v2"};
    const std::string unit = fmt::format("ΔS / N k ln {}", 1 << Dim);
    const bool several = runs.size() > 1;
    std::vector<CurvePanel> panels;
    double last = 0.0;
    for (std::size_t k = 0; k < runs.size(); ++k)
        last = std::max(last, runs[k].history.last("t") / gases[k].cells);
    if (several) last = std::min(last, Dim == 3 ? 4.0 : 1.5);
    for (std::size_t c = 0; c < columns.size(); ++c) {
        if (several || panels.empty())
            panels.push_back(frame(several ? title_of(columns[c], false) : "",
                                   Dim == 1 ? "t / N" : "t / n", unit));
        for (std::size_t k = 0; k < runs.size(); ++k) {
            const int style = static_cast<int>(several ? k : c) + 1;
            Curve curve = entropy_curve(gases[k], runs[k].history, columns[c],
                                        several ? fmt::format("{} particles", gases[k].particles())
                                                : title_of(columns[c], true),
                                        style);
            while (!curve.x.empty() && curve.x.back() > last + 1e-9) {
                curve.x.pop_back();
                curve.y.pop_back();
            }
            panels.back().curves.push_back(std::move(curve));
        }
        if (several || c + 1 == columns.size())
            panels.back().curves.push_back(
                {.title = "equilibrium", .x = {0.0, last}, .y = {1.0, 1.0}, .style = 4});
    }
    const std::string of = several ? std::string("three gases")
                                   : fmt::format("{} smooth particles", gases[0].particles());
    draw_curves(session, "entropy", fmt::format("Entropy of {} expanding freely", of), panels);
}

template <int Dim>
void draw(Session& session, const Gas<Dim>& gas) {
    draw_fields(session, gas);
    draw_spectrum(session, gas);
}

/// Density and velocity along the line.
template <>
void draw(Session& session, const Gas<1>& gas) {
    std::vector<CurvePanel> panels{frame("density", "x / N", "ρ"),
                                   frame("velocity", "x / N", "<v>"),
                                   frame("velocity fluctuation", "x / N", "(<v²> − <v>²) / 2")};
    for (const auto* state : reached(gas)) {
        const auto fields = fields_of(gas, state->position, state->velocity);
        const Points<1> at = fields.grid.points();
        std::vector<double> x(at.data(), at.data() + at.size());
        for (double& place : x) place /= gas.cells;
        const std::string title = fmt::format("t = {:.4g}", state->t);
        const auto& v = fields.velocity;
        panels[0].curves.push_back({title, x, fields.density});
        panels[1].curves.push_back({title, x, std::vector<double>(v.data(), v.data() + v.size())});
        panels[2].curves.push_back({title, x, fields.hidden});
    }
    if (panels[0].curves.empty()) return;
    draw_curves(session, "profiles",
                fmt::format("Twofold expansion of {} smooth particles on a line", gas.particles()),
                panels);
}

template <int Dim>
bool draw_frame(const RunFolder& folder, const Gas<Dim>& gas, int number, double t,
                std::span<const double> y) {
    const ConstState<Dim> state(gas.model->layout(), y);
    const auto fields = fields_of<Dim>(gas, state.position(), state.velocity(), true);
    ContourPanel density = tones(fields.grid, fields.density), kinetic = density;
    density.colours = ContourPanel::Colours{0.0, 1.0, "density"};
    kinetic.values = fields.kinetic;
    kinetic.colours = ContourPanel::Colours{0.0, 0.25, "kinetic energy"};
    const RunFolder frames = folder.inside("frames");
    const std::string name = fmt::format("frame_{:04}", number);
    if (!draw_contours(frames, name, fmt::format("t = {:.1f}", t),
                       {dots<Dim>(gas, state.position()), density, kinetic}, 3, room_of(gas)))
        return false;
    for (const char* part : {".dat", ".gp"}) {  // a hundred scripts are of no use
        std::error_code ignored;
        std::filesystem::remove(frames / (name + part), ignored);
    }
    return true;
}

void make_movie(Session& session, const RunFolder& folder) {
    const std::string trouble = make_film(folder.inside("frames"), "expansion", 12);
    session.terminal().say(trouble.empty()
                               ? "movie       frames/expansion.mp4"
                               : fmt::format("movie       {}: the frames are in frames/", trouble));
}

template void draw_entropy(Session&, const std::vector<Gas<1>>&, const std::vector<RunRecord>&);
template void draw_entropy(Session&, const std::vector<Gas<2>>&, const std::vector<RunRecord>&);
template void draw_entropy(Session&, const std::vector<Gas<3>>&, const std::vector<RunRecord>&);
template void draw(Session&, const Gas<2>&);
template void draw(Session&, const Gas<3>&);
template bool draw_frame(const RunFolder&, const Gas<2>&, int, double, std::span<const double>);
template bool draw_frame(const RunFolder&, const Gas<3>&, int, double, std::span<const double>);

}  // namespace free_expansion
