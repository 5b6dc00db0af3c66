// SPDX-License-Identifier: GPL-3.0-or-later
#include "block.hpp"
#include <spam/analysis/material_point.hpp>
#include <spam/diagnostics/convergence.hpp>
#include <spam/diagnostics/total_energy.hpp>
#include <spam/integrate/interrupt.hpp>
#include <spam/material/smooth_yield.hpp>
#include <spam/material/yielding_solid.hpp>
#include <spam/problem/motion.hpp>

#include <map>
#include <mutex>

namespace plastic_block {
namespace {

constexpr double t_end = 20.0, fine_dt = 1.0 / 128.0;
constexpr std::array steps{1.0, 0.5, 0.25, 0.125, 0.0625};
constexpr std::array tolerances{1e-4, 1e-6, 1e-8};
constexpr const char* adaptive = "arkode:DORMAND_PRINCE_7_4_5";

struct Form {
    std::string name, title;
    Formulation formulation;
    Yielding yielding;
    std::array<double, steps.size()> known;  ///< errors of an independent computation; 0: none
};

constexpr auto tl = Formulation::total_lagrangian, ul = Formulation::updated;
constexpr auto after = Yielding::after_steps, stages = Yielding::in_stages,
               by_rates = Yielding::smooth;
const std::vector<Form> forms{
    {"tl_after",
     "total Lagrangian, returned after steps",
     tl,
     after,
     {0.29, 0.16, 0.087, 0.045, 0.023}},
    {"tl_return",
     "total Lagrangian, in stages",
     tl,
     stages,
     {0.023, 0.0136, 0.0072, 0.0037, 0.0019}},
    {"tl_smooth", "total Lagrangian, smooth", tl, by_rates, {0.0, 0.0, 0.057, 0.008, 0.0}},
    {"ul_after", "updated, returned after steps", ul, after, {0.0, 0.120, 0.063, 0.032, 0.016}},
    {"ul_return", "updated, in stages", ul, stages, {0.0, 0.0035, 0.0018, 0.0009, 0.0004}},
    {"ul_smooth", "updated, smooth", ul, by_rates, {}},
};

struct End {
    Points<2> position;
    double energy_change = 0.0, work = 0.0, strain = 0.0;
    Integrator::Statistics statistics;
};

End run(Parameters p, const Form& form, const IntegratorOptions& options, double end) {
    p.formulation = form.formulation;
    p.yielding = form.yielding;
    const Block block = make_block(p);
    const double before = total_energy(*block.model, block.y0);
    Motion<2> motion(*block.model, block.y0, options);
    motion.advance_to(end);
    double strain = 0.0;
    for (const double one : plastic_strains(*block.model, motion.y()))
        strain = std::max(strain, one);
    return {motion.state().position(), total_energy(*block.model, motion.y()) / before - 1.0,
            plastic_work(*block.model, motion.y()), strain, motion.statistics()};
}

/// With steps so short that the return in stages serves as the answer to both sharp forms; smooth ones have
/// limits of their own.
class References {
  public:
    References(const Parameters& p, double end) : p_(p), end_(end) {}
    const Points<2>& of(const Form& form, bool sharp) {
        const std::lock_guard lock(mutex_);
        Form reference = form;
        if (sharp) reference.yielding = Yielding::in_stages;
        auto& place = found_[{reference.formulation, reference.yielding}];
        if (place.size() == 0) {
            IntegratorOptions options;
            options.dt = fine_dt;
            place = run(p_, reference, options, end_).position;
        }
        return place;
    }

  private:
    Parameters p_;
    double end_;
    std::mutex mutex_;
    std::map<std::pair<Formulation, Yielding>, Points<2>> found_;
};

double largest_distance(const Points<2>& one, const Points<2>& other) {
    return (one - other).colwise().norm().maxCoeff();
}

const std::vector<std::string> columns{"case",
                                       "right_hand_sides",
                                       "position_error",
                                       "energy_change",
                                       "plastic_work",
                                       "largest_plastic_strain",
                                       "end"};

std::vector<std::string> row_of(const Parameters& p, const Form& form,
                                const IntegratorOptions& options, double end,
                                References& references) {
    try {
        const Points<2>& reference = references.of(form, form.yielding != Yielding::smooth);
        const End found = run(p, form, options, end);
        return {fmt::format("{}", found.statistics.rhs_evaluations),
                fmt::format("{:.6g}", largest_distance(found.position, reference)),
                fmt::format("{:.4g}", found.energy_change),
                fmt::format("{:.6g}", found.work),
                fmt::format("{:.6g}", found.strain),
                "complete"};
    } catch (const GuardStop& stop) {  // a step that is too long for the form
        return {"0", "inf", "inf", "inf", "inf", fmt::format("stopped: {}", stop.what())};
    }
}

struct Point {
    double dt, calls, error, energy;
};

/// What a material point shows of the laws alone under a strain rate that turns, slowly enough for it to yield
/// all the time: where it unloads and yields again, rates have kinks.
double order_at_a_point(const Material<2>& solid, double yield_stress, double coarse) {
    const auto turning = [yield_stress](double t) {
        const double d = 2.5 * yield_stress * std::cos(2.0 * t),
                     xy = 2.5 * yield_stress * std::sin(2.0 * t);
        Mat<2> g;
        g.c = {d, xy - 0.1, xy + 0.1, -d};
        return g;
    };
    const auto at = [&](double dt) {
        IntegratorOptions options;
        options.dt = dt;
        MaterialPoint<2> point(solid, turning, options);
        point.advance_to(6.0);
        return point.stress().c;
    };
    const auto fine = at(coarse / 64.0);
    std::vector<double> dts, errors;
    for (const double dt : {coarse, coarse / 2.0, coarse / 4.0}) {
        const auto found = at(dt);
        dts.push_back(dt);
        errors.push_back(std::hypot(found[0] - fine[0], found[1] - fine[1], found[2] - fine[2]));
    }
    return std::log(errors.front() / errors.back()) / std::log(dts.front() / dts.back());
}

void report_material_point(Session& session, const Parameters& p) {
    const Findings findings(session);
    const PlaneVonMises surface{triangular_modulus, triangular_modulus};
    const LinearHardening flow{p.yield_stress, p.hardening};
    const bool known = session.when_default({"yield-stress", "hardening", "yield-width"});
    const double sharp =
        order_at_a_point(YieldingSolid<PlaneVonMises>(surface, flow), p.yield_stress, 1.0 / 64.0);
    const double smooth = order_at_a_point(SmoothYield<PlaneVonMises>(surface, flow, p.width),
                                           p.yield_stress, 1.0 / 64.0);
    findings.claim("order_of_return_at_a_point", sharp, 1.0, 0.1, "a strain rate that turns",
                   known);
    findings.claim("order_of_smooth_at_a_point", smooth, 4.0, 0.4, "that of RK4", known);
}

void draw(Session& session, const std::map<std::string, std::vector<Point>>& fixed,
          const std::map<std::string, std::vector<Point>>& free) {
    LogLogPicture picture;
    picture.title = "Yielding block: error of positions against work";
    for (const auto formulation : {Formulation::updated, Formulation::total_lagrangian}) {
        LogLogPanel panel{formulation == Formulation::updated ? "updated" : "total Lagrangian",
                          "right-hand sides",
                          "largest error of a position / spacing",
                          {}};
        std::size_t key = 0;
        for (const Form& form : forms) {
            if (form.formulation != formulation) continue;
            for (const auto* points : {&fixed, &free}) {
                LogLogCurve curve{key, points == &free, {}, {}};
                for (const Point& point : points->at(form.name))
                    add_point(curve, point.calls, point.error);
                panel.curves.push_back(std::move(curve));
            }
            ++key;
        }
        picture.panels.push_back(std::move(panel));
    }
    picture.key = {"returned after steps only", "returned in every stage", "smooth rates"};
    picture.note = "full: RK4 with fixed steps; open: Dormand-Prince, tolerances 1e-4 to 1e-8";
    draw_log_log(session, "work_precision", picture);
}

}  // namespace

void compare(Session& session, const Parameters& p) {
    const Findings findings(session);
    const double end = session.common().smoke ? 2.0 : t_end;
    References references(p, end);
    struct Case {
        const Form* form;
        double dt, rtol;
    };
    std::map<std::string, Case> cases;
    std::vector<StudyTask> tasks;
    const auto add = [&](const Form& form, double dt, double rtol) {
        IntegratorOptions options;
        const std::string name = dt > 0.0 ? fmt::format("{}_dt{:g}", form.name, dt)
                                          : fmt::format("{}_rtol{:g}", form.name, rtol);
        if (dt > 0.0)
            options.dt = dt;
        else {
            options.method = adaptive;
            options.rtol = rtol;
            options.atol = rtol * 1e-2;
        }
        cases[name] = {&form, dt, rtol};
        tasks.push_back({name, [&form, &p, &references, options, end] {
                             return row_of(p, form, options, end, references);
                         }});
    };
    for (const Form& form : forms) {
        for (const double dt : steps) add(form, dt, 0.0);
        for (const double rtol : tolerances) add(form, 0.0, rtol);
    }
    StudyTable table = session.begin_study(
        "comparison", columns,
        {fmt::format("{} runs of a block of {} particles to t = {:g}, {} at a time", tasks.size(),
                     p.columns * p.rows, end, p.jobs)},
        true);
    if (!session.run_study(table, tasks, p.jobs)) return;

    const bool standard =
        session.when_default({"columns", "rows", "amplitude", "spin", "yield-stress", "hardening",
                              "yield-width", "range", "penalty", "transport"});
    std::map<std::string, std::vector<Point>> fixed, free;
    for (const auto& row : table.rows(tasks)) {
        const Case& one = cases.at(row.front());
        const Point point{one.dt, number_in_cell(row, 1), number_in_cell(row, 2),
                          number_in_cell(row, 3)};
        (one.dt > 0.0 ? fixed : free)[one.form->name].push_back(point);
        if (!std::isfinite(point.error)) continue;
        double known = 0.0;
        for (std::size_t k = 0; k < steps.size(); ++k)
            if (one.dt == steps[k]) known = one.form->known[k];
        // Within a fifth, of numbers known to 0.5e-4.
        findings.claim(row.front() + "_error", point.error, known, 0.2 * known + 0.6e-4,
                       "an independent computation", standard && known > 0.0);
        if (one.rtol > 0.0)
            findings.measure(row.front() + "_error_by_tolerance", point.error / one.rtol,
                             one.form->yielding == Yielding::smooth
                                 ? "controlled by the steps"
                                 : "of first order in the step, which its estimate does not see");
        findings.measure(row.front() + "_energy_change", point.energy);
    }
    for (const Form& form : forms)
        if (form.yielding == Yielding::smooth)
            findings.measure(
                form.name + "_from_return",
                largest_distance(references.of(form, false), references.of(form, true)),
                "limits of the two, largest distance of a particle");
    for (const char* name : {"tl", "ul"}) {
        const auto& late = fixed.at(std::string(name) + "_after");
        const auto& returned = fixed.at(std::string(name) + "_return");
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 1; k < steps.size(); ++k)
            least = std::min(least, late[k].error / returned[k].error);
        findings.claim(std::string(name) + "_return_by_after", 1.0 / least, 0.0, 0.1,
                       "a tenth of the error, at every step", standard);
    }
    report_material_point(session, p);
    if (session.plots()) draw(session, fixed, free);
}

}  // namespace plastic_block
