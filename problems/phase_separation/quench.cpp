// SPDX-License-Identifier: GPL-3.0-or-later
#include "separation.hpp"
#include <spam/external/friction.hpp>
#include <spam/material/van_der_waals.hpp>

namespace phase_separation {
namespace {

/// Between these times domains grow by a power of time.
constexpr double growth_from = 40.0, growth_until = 113.0;
const std::vector<double> temperatures{0.8, 0.85, 0.9};

struct Quench : Variant<2> {
    double temperature;
    int seed;
    VanDerWaalsMatter matter;
    /// The latest row's.
    std::shared_ptr<std::optional<DensityField>> field =
        std::make_shared<std::optional<DensityField>>();

    FluidModel<2>* isolated = nullptr;  ///< the model, where there is an energy equation
};

DensityField field_of(const Quench& one, std::span<const double> y) {
    return {one.matter.weight(), ConstState<2>(one.model->layout(), y).position(),
            one.model->box()};
}

/// Like van der Waals' fluid, with a temperature of its own at every particle.
Fluid fluid_of(const Parameters& p) {
    return {VanDerWaals{van_der_waals_a, van_der_waals_b, 2},
            NewtonViscosity::shear_and_bulk(p.viscosity, 0.0, 2), FourierConduction{p.conductivity},
            true};
}

Quench make_quench(const Parameters& p, double temperature, int seed, bool only_described) {
    Quench one;
    one.temperature = temperature;
    one.seed = seed;
    one.matter = p;
    one.matter.temperature = temperature;
    one.title = fmt::format("T = {:g}", temperature);
    auto particles = p.particles();
    Points<2> x = particles.reference_position;
    displace(x, p.disorder * p.spacing(), seed);
    if (p.isolated) {
        const auto model = std::make_shared<FluidModel<2>>(
            std::move(particles), fluid_of(p),
            Scheme{.density = Density::summed, .kernel = p.kernel, .range = p.range}, p.box());
        if (!only_described) one.y0 = model->state(x, Points<2>::Zero(2, x.cols()), temperature);
        one.isolated = model.get();
        one.model = model;
        return one;
    }
    one.model = std::make_shared<DensityPotentialModel<2>>(std::move(particles),
                                                           one.matter.potentials(), p.box());
    if (p.damping > 0.0)
        one.model->add(std::make_unique<Friction<2>>(p.damping, FrictionOf::all_motion));
    one.y0 = initial_state<2>(*one.model, p.density, 1.0, at_rest<2>());
    State<2>(one.model->layout(), one.y0).position() = x;
    one.model->layout().set_scale(Field::velocity, 0.1);
    return one;
}

Plan<2> plan_of(const Session& session, const Parameters& p, Quench& one) {
    using State = std::span<const double>;
    Plan<2> plan;
    plan.t_end = session.end(p.damping > 0.0 || p.isolated ? 300.0 : 120.0, 8.0);
    plan.output_every = plan.t_end / 120.0;
    plan.snapshot_every = plan.t_end / 15.0;
    plan.observe(
        {.on_row = [&one, weight = one.matter.weight()](double, const Model<2>& model, State y) {
            one.field->emplace(weight, ConstState<2>(model.layout(), y).position(), model.box());
        }});
    plan.record({{"domain_size",
                  [field = one.field, side = p.box().length(0)](const Model<2>&, State) {
                      return std::min(side, (*field)->domain_size(critical_density));
                  }},
                 {"mean_wavelength", [field = one.field](const Model<2>&, State) {
                      return (*field)->mean_wavelength();
                  }}});
    if (one.isolated) {
        const auto T = [model = one.isolated](State y) {
            return Eigen::ArrayXd::Map(model->temperature(y).data(),
                                       static_cast<Eigen::Index>(model->particles().size()))
                .eval();
        };
        plan.record({{"temperature", [T](const Model<2>&, State y) { return T(y).mean(); }},
                     {"temperature_deviation", [T](const Model<2>&, State y) {
                          const auto all = T(y);
                          return std::sqrt((all - all.mean()).square().mean());
                      }}});
    }
    one.drawn = states_at<2>({1.0 / 15.0, 2.0 / 15.0, 0.4, 1.0}, plan.t_end);
    plan.observe(keep_nearest<2>(one.drawn,
                                 [](const Model<2>& model, State y) { return model.density(y); }));
    return plan;
}

// ---- what was found ----

/// The temperature at which two phases side by side have the energy of a fluid at rest at `T_0` and density `rho_0`
/// everywhere, where the mean density in room is `mean`: T - a <rho> by mass = T_0 - a rho_0.
double separated_temperature(double T_0, double rho_0, double mean) {
    const auto excess = [&](double T) {
        const Coexistence two =
            coexistence(VanDerWaalsIsotherm{van_der_waals_a, van_der_waals_b, T});
        const double vapour = two.vapour_share(mean);
        const double by_mass = vapour * two.vapour + (1.0 - vapour) * two.liquid;
        return T - van_der_waals_a * by_mass - (T_0 - van_der_waals_a * rho_0);
    };
    return sign_change(excess, T_0, 1.0 - 1e-9);
}

std::optional<double> growth_exponent(const History& h, const char* column) {
    const auto t = h.column("t"), size = h.column(column);
    std::vector<double> log_t, log_size;
    for (std::size_t k = 0; k < t.size(); ++k)
        if (t[k] >= growth_from && t[k] <= growth_until) {
            log_t.push_back(std::log(t[k]));
            log_size.push_back(std::log(size[k]));
        }
    if (t.back() < growth_until || log_t.size() < 3) return {};
    return fit_line(log_t, log_size).slope;
}

/// Everything but temperature, friction and seeds.
bool is_known(const Session& session, const RunRecord& run, double least_time) {
    return session.when_default({"cells", "density", "disorder", "kernel", "range"}) &&
           run.complete && run.statistics.t_end >= least_time;
}

void report_phases(const Session& session, const Parameters& p, const Quench& one,
                   const RunRecord& run, const Findings& findings) {
    const Coexistence two = coexistence(one.matter.law());
    const bool known = is_known(session, run, 300.0) && session.at_default({"damping"}) &&
                       one.temperature >= 0.8 && one.temperature <= 0.9;
    const double n = static_cast<double>(run.statistics.particles);
    for (const bool liquid : {true, false}) {
        const double found = field_of(one, run.y).phase_density(critical_density, liquid, p.range);
        const double expected = liquid ? two.liquid : two.vapour;
        const std::string name = liquid ? "liquid" : "vapour";
        findings.measure(name + "_of_maxwell", expected, "equal pressure and chemical potential");
        if (std::isfinite(found))
            findings.claim(name + "_density", found, expected, (liquid ? 0.02 : 0.1) * expected,
                           "Maxwell's construction", known);
    }
    for (const Drift& drift : run.drifts)
        if (drift.name == "energy")
            findings.claim("energy_change_per_particle", drift.change * drift.scale / n, 0.0, 5e-5,
                           "less the work of friction", known);
}

void report_isolated(const Session& session, const Parameters& p, const Quench& one,
                     const RunRecord& run, const Findings& findings) {
    const double expected = separated_temperature(
        one.temperature,
        Eigen::ArrayXd::Map(one.model->density(one.y0).data(),
                            static_cast<Eigen::Index>(one.model->particles().size()))
            .mean(),
        p.density);
    const bool known = session.when_default({"cells", "density", "disorder", "kernel", "range",
                                             "temperature", "viscosity", "conductivity"}) &&
                       run.complete && run.statistics.t_end >= 300.0;
    findings.claim("temperature", run.history.last("temperature"), expected, 0.005,
                   "energy and Maxwell's construction", known);
    findings.claim("temperature_deviation", run.history.last("temperature_deviation"), 0.0, 0.002,
                   "conduction: the same within 0.002", known);
    const double n = static_cast<double>(run.statistics.particles);
    for (const Drift& drift : run.drifts) {
        if (drift.name == "energy")
            findings.claim("energy_change_per_particle", drift.change * drift.scale / n, 0.0, 1e-6,
                           "pairs give what others take", known);
        if (drift.name == "momentum")
            findings.claim("momentum_per_particle", drift.change * drift.scale / n, 0.0, 1e-12,
                           "equal and opposite forces", known);
    }
}

void report(Session& session, const Parameters& p, const Quench& one, const RunRecord& run) {
    const Findings findings(session, one.prefix);
    findings.measure_last(run.history, {"domain_size", "mean_wavelength"});
    if (one.isolated)
        report_isolated(session, p, one, run, findings);
    else if (p.damping > 0.0)
        report_phases(session, p, one, run, findings);
    else
        for (const char* column : {"domain_size", "mean_wavelength"})
            if (const auto exponent = growth_exponent(run.history, column))
                findings.measure(fmt::format("{}_exponent", column), *exponent,
                                 "from t = 40 to 113");
    findings.check_promises(run);
}

void report_seeds(Session& session, const Parameters& p, const std::vector<RunRecord>& runs) {
    for (const char* column : {"domain_size", "mean_wavelength"}) {
        std::vector<double> exponents;
        for (const auto& run : runs)
            if (const auto one = growth_exponent(run.history, column)) exponents.push_back(*one);
        if (exponents.size() < 2) continue;
        const OfSeeds all(exponents);
        const bool known = std::string_view(column) == "domain_size" && p.temperature == 0.85 &&
                           p.damping == 0.0 && exponents.size() >= 5 &&
                           is_known(session, runs.front(), growth_until);
        Findings(session).claim(
            fmt::format("{}_exponent_mean", column), all.mean, 0.75, 0.1,
            known ? "another program; 2/3 of inertial growth" : "from t = 40 to 113", known);
        Findings(session).measure(fmt::format("{}_exponent_deviation", column), all.deviation,
                                  "of one seed");
    }
}

// ---- pictures ----

ConfigurationPanel panel_of(const Quench& one, const NearestState<2>& state,
                            const std::string& title) {
    const auto& box = one.model->box();
    return {title,
            box.wrapped(state.position),
            state.values,
            {rectangle({0.0, 0.0}, {box.length(0), box.length(1)})}};
}

void draw_configurations_of(Session& session, const Parameters& p, const std::vector<Quench>& all) {
    std::vector<ConfigurationPanel> panels;
    const auto add = [&](const Quench& one, const NearestState<2>& state) {
        if (state.there())
            panels.push_back(
                panel_of(one, state, fmt::format("{}, t = {:.4g}", one.title, state.t)));
    };
    if (p.compare) add(all.front(), all.front().drawn[1]);
    if (p.compare)
        for (const auto& one : all) add(one, one.drawn.back());
    else
        for (const auto& state : all.front().drawn) add(all.front(), state);
    draw_configurations(session, "configurations", "Van der Waals fluid, quenched", panels, 2,
                        "density");
}

/// Densities of both phases over temperature, and what was found.
void draw_coexistence(Session& session, const Parameters& p, const std::vector<Quench>& all,
                      const std::vector<RunRecord>& runs) {
    Curve binodal{.title = "coexistence", .x = {}, .y = {}}, unstable = binodal;
    unstable.title = "spinodal";
    std::vector<std::array<double, 5>> rows;
    for (double T = 0.7; T < 0.9999;
         T += 0.2 * (1.0001 - T) * std::min(1.0, 0.02 / (1.0 - T) + 0.3)) {
        const VanDerWaalsIsotherm law{van_der_waals_a, van_der_waals_b, T};
        const Coexistence two = coexistence(law);
        const auto limits = spinodal(law);
        rows.push_back({T, two.vapour, two.liquid, limits[0], limits[1]});
    }
    const auto trace = [&rows](Curve& curve, std::size_t low, std::size_t high) {
        for (auto it = rows.begin(); it != rows.end(); ++it) add_point(curve, (*it)[low], (*it)[0]);
        for (auto it = rows.rbegin(); it != rows.rend(); ++it)
            add_point(curve, (*it)[high], (*it)[0]);
    };
    trace(binodal, 1, 2);
    trace(unstable, 3, 4);
    Curve found{.title = "particles", .x = {}, .y = {}, .mark = Mark::points};
    for (std::size_t k = 0; k < runs.size(); ++k)
        for (const bool liquid : {false, true})
            add_point(found,
                      field_of(all[k], runs[k].y).phase_density(critical_density, liquid, p.range),
                      all[k].temperature);
    CurvePanel panel = frame("", "density", "temperature");
    panel.curves = {binodal, unstable, found};
    draw_curves(session, "coexistence", "Liquid and vapour of a van der Waals fluid", {panel});
}

void draw_growth(Session& session, const Parameters& p, const std::vector<Quench>& all,
                 const std::vector<RunRecord>& runs) {
    LogLogPicture picture{"Domains of a van der Waals fluid",
                          {{"", "t", "area by length of the boundary", {}}},
                          1,
                          {},
                          "",
                          false};
    const auto add = [&picture](const std::string& title, const std::vector<double>& t,
                                const std::vector<double>& size, bool open) {
        picture.panels[0].curves.push_back({picture.key.size(), open, t, size});
        picture.key.push_back(title);
    };
    for (std::size_t k = 0; k < runs.size(); ++k)
        add(p.samples.value_or(1) > 1 ? fmt::format("seed {}", all[k].seed) : all[k].title,
            runs[k].history.column("t"), runs[k].history.column("domain_size"), false);
    const std::vector<double> t{growth_from, growth_until};
    add("exponent 2/3", t, {5.0, 5.0 * std::pow(growth_until / growth_from, 2.0 / 3.0)}, true);
    draw_log_log(session, "domains", picture);
}

void draw(Session& session, const Parameters& p, const std::vector<Quench>& all,
          const std::vector<RunRecord>& runs) {
    if (runs.size() < all.size()) return;
    draw_configurations_of(session, p, all);
    draw_growth(session, p, all, runs);
    if (p.isolated)
        draw_curves(session, "temperature", "Van der Waals fluid, isolated",
                    {over_time("", runs.front().history, "temperature",
                               {{"mean", "temperature"},
                                {"root mean square deviation", "temperature_deviation"}})});
    else if (p.damping > 0.0)
        draw_coexistence(session, p, all, runs);
}

}  // namespace

void refuse_stable(const Parameters& p) {
    p.refuse_one_phase();
    const auto [low, high] = spinodal(p.law());
    if (!(p.density > low && p.density < high))
        refuse(
            "density: a fluid of {:g} is stable at the temperature {:g}, and small disturbances die "
            "out; give a density "
            "between {:.3g} and {:.3g}",
            p.density, p.temperature, low, high);
}

void quench(Session& session, const Parameters& p) {
    std::vector<Quench> all;
    for (const double T : p.compare ? temperatures : std::vector{p.temperature})
        for (int sample = 0; sample < p.samples.value_or(1); ++sample) {
            all.push_back(make_quench(p, T, p.seed + sample, session.common().dry_run));
            if (p.compare) all.back().call(fmt::format("T_{:g}", T));
            if (p.samples.value_or(1) > 1) all.back().call(fmt::format("seed_{}", p.seed + sample));
        }
    const auto runs = run_all(session, all, [&](Quench& one) { return plan_of(session, p, one); });
    for (std::size_t k = 0; k < runs.size(); ++k) report(session, p, all[k], runs[k]);
    if (runs.size() > 1 && !p.compare) report_seeds(session, p, runs);
    if (session.plots()) draw(session, p, all, runs);
}

}  // namespace phase_separation
