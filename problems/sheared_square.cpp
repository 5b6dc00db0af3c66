// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a sheared elastic square is released: it vibrates and does not rotate, [HHM04] Fig. 2; 3 s
//
// The deformed unit square of [HHM04] V, Fig. 2.
//
//        o-----------o           A free square of n x n particles, sheared by u_x = gamma y, gamma =
//       /           /            1/4, is let go at rest with the stress of that strain,
//      /           /
//     o-----------o              sigma_xy = eta gamma,  sigma_xx = sigma_yy = 0.
//
// 'The resulting motion oscillates symmetrically and without any rotation about the center of mass':
// there is no torque, so that L = 0 for ever, and the rotation of the square, that of simple shear
// (-gamma/2 to first order), stays what it is to first order in gamma. The axis along which the
// square is long, at 41 degrees first, is near the other diagonal half a period later: it passes 0
// quickly, while the square is nearly one.
//
// The period follows from the free vibrations of an elastic square: nearly all of a uniform shear is
// one mode, u_x even in x and odd in y, u_y the other way round. Rayleigh and Ritz with polynomials
// find its frequency, 3.926 c_T/side; the square of particles is softer at its edges, and slower by
// that much the smaller it is.
#include "common.hpp"
#include "sheared_square/vibrations.hpp"
#include <spam/core/rigid_motion.hpp>
#include <spam/diagnostics/outline.hpp>

namespace {

using namespace spam;
using std::numbers::pi;

struct Parameters {
    int cells = 24;       // particles along a side, each owns a cell of it
    double shear = 0.25;  // gamma
};

const double eta = triangular_modulus;  // = lambda; density 1: mass 1, spacing 1
const double c_T = std::sqrt(eta);

// ---- elasticity: Rayleigh and Ritz ----

/// x^a y^b on the square [-1, 1]^2: integrals and derivatives.
struct Monomial {
    int a, b;
    double c = 1.0;
    Monomial dx() const { return {a - 1, b, c * a}; }
    Monomial dy() const { return {a, b - 1, c * b}; }
};
double integral(const Monomial& p, const Monomial& q) {
    const int a = p.a + q.a, b = p.b + q.b;
    if (p.c * q.c == 0.0 || a % 2 != 0 || b % 2 != 0) return 0.0;
    return p.c * q.c * 4.0 / ((a + 1.0) * (b + 1.0));
}

/// Angular frequency of the mode of a free square that a uniform shear sigma_xy is nearest to, in
/// units of c_T / side, lambda = eta. u_x even in x and odd in y, u_y the other way round.
double shear_mode_frequency(int degree) {
    std::vector<Monomial> x_modes, y_modes;
    for (int a = 0; a <= degree; a += 2)
        for (int b = 1; a + b <= degree; b += 2) {
            x_modes.push_back({a, b});
            y_modes.push_back({b, a});
        }
    const auto n = static_cast<Eigen::Index>(x_modes.size());
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * n, 2 * n), M = K;
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
            const auto k = static_cast<std::size_t>(i), l = static_cast<std::size_t>(j);
            const Monomial &p = x_modes[k], &q = x_modes[l], &r = y_modes[k], &s = y_modes[l];
            // lambda (div u)^2 + 2 eta e : e with lambda = eta = 1
            K(i, j) = 3.0 * integral(p.dx(), q.dx()) + integral(p.dy(), q.dy());
            K(n + i, n + j) = 3.0 * integral(r.dy(), s.dy()) + integral(r.dx(), s.dx());
            K(i, n + j) = integral(p.dx(), s.dy()) + integral(p.dy(), s.dx());
            K(n + j, i) = K(i, n + j);
            M(i, j) = integral(p, q);
            M(n + i, n + j) = integral(r, s);
        }
    const Vibrations modes = vibrations(K, M);
    // How much of u_x = y/2, u_y = x/2 is in each mode; rotation is one as well, of frequency 0.
    Eigen::VectorXd shear = Eigen::VectorXd::Zero(2 * n);
    shear[0] = shear[n] = 1.0;
    Eigen::Index best = 0;
    (modes.shapes.transpose() * (M * shear).eval()).cwiseAbs().maxCoeff(&best);
    return 2.0 * std::sqrt(modes.omega_squared[best]);  // a side of 2
}

// ---- particles ----

std::unique_ptr<SmoothParticleModel<2>> make_square(const Parameters& p, const Scheme& scheme) {
    Points<2> lattice = square_lattice<2>({p.cells, p.cells});
    lattice.array() -= 0.5 * (p.cells - 1);
    return std::make_unique<SmoothParticleModel<2>>(make_particles<2>(lattice, 1.0),
                                                    ElasticSolid{eta, eta}, scheme);
}

/// Sheared, stressed, at rest; simple shear keeps the density.
std::vector<double> sheared_state(Model<2>& model, double gamma) {
    const double speed = c_T * gamma;  // its scale, for tolerances
    auto y = initial_state<2>(model, 1.0, eta * gamma,
                              [&](const Point<2>&) { return Point<2>(speed, 0.0); });
    const State<2> state(model.layout(), y);
    state.velocity().setZero();
    auto x = state.position();
    x.row(0) += gamma * x.row(1);
    state.stress().row(2).setConstant(eta * gamma);
    state.energy().setConstant(0.5 * eta * gamma * gamma);
    return y;
}

/// sum m r r about the centre of mass, divided by sum m y^2 of the square: 1 + gamma^2, gamma, 1 for
/// xx, xy, yy at the start.
Eigen::Matrix2d shape_tensor(const Model<2>& model, std::span<const double> y) {
    const Points<2> x = ConstState<2>(model.layout(), y).position();
    const Points<2> r = x.colwise() - Point<2>(x.rowwise().mean());
    return r * r.transpose() / model.particles().reference_position.row(1).squaredNorm();
}

double degrees(double angle) { return angle * 180.0 / pi; }

std::vector<Column<2>> columns() {
    return {
        {"shear", [](const Model<2>& model,
                     std::span<const double> y) { return shape_tensor(model, y)(0, 1); }},
        {"long_axis_degrees",
         [](const Model<2>& model, std::span<const double> y) {
             const auto S = shape_tensor(model, y);
             return degrees(0.5 * std::atan2(2.0 * S(0, 1), S(0, 0) - S(1, 1)));
         }},
        {"rotation_degrees",  // of the best rigid motion: simple shear is a turn by -gamma/2, too
         [](const Model<2>& model, std::span<const double> y) {
             const auto R = best_rigid_motion<2>(model.particles().reference_position,
                                                 ConstState<2>(model.layout(), y).position())
                                .rotation;
             return degrees(std::atan2(R(1, 0), R(0, 0)));
         }}};
}

/// From the first to the last zero of a column; NaN with fewer than two.
double measured_period(const History& history, const char* name) {
    const auto t = history.column("t"), value = history.column(name);
    std::vector<double> zeros;
    for (std::size_t k = 1; k < t.size(); ++k)
        if (value[k - 1] * value[k] < 0.0)
            zeros.push_back(t[k - 1] +
                            (t[k] - t[k - 1]) * value[k - 1] / (value[k - 1] - value[k]));
    if (zeros.size() < 2) return std::nan("");
    return 2.0 * (zeros.back() - zeros.front()) / static_cast<double>(zeros.size() - 1);
}

/// L against what as much motion could have, sqrt(2 K sum m r^2); 0 where nothing has moved yet.
double relative_angular_momentum(const History& history, const Model<2>& model) {
    const double I = model.particles().reference_position.squaredNorm();
    const double most = std::sqrt(2.0 * history.largest("kinetic") * I);
    return most > 1e-150 ? history.largest_change("angular_momentum") / most : 0.0;
}

// ---- what is claimed ----

/// What the paper says of the motion and what elasticity says of its period.
void check(Session& session, const Parameters& p, const Model<2>& model, const RunRecord& run,
           double elastic_period) {
    const Findings findings(session);
    const History& h = run.history;
    const double period = measured_period(h, "shear");
    const double turned = std::abs(h.at(period, "rotation_degrees") - h.first("rotation_degrees"));
    const double swing = -h.smallest("shear") / p.shear;
    const double L = relative_angular_momentum(h, model);
    findings.check_promises(run);
    findings.measure("period_by_elasticity", elastic_period);
    // Larger strains are beyond linear elasticity; plain velocities let the square clump. Within shorter ranges sums
    // are no integrals, and within longer ones most of a small square is edge.
    const bool claimed = run.complete && h.last("t") > 1.1 * elastic_period && p.cells >= 12 &&
                         p.shear <= 0.25 && session.scheme().transport != Transport::plain &&
                         session.scheme().kernel == Kernel::lucy &&
                         session.scheme().viscosity == 0.0 && resolves(h.column("t"), period) &&
                         session.scheme().range >= 2.0 && session.scheme().range <= 3.5;
    if (claimed) {
        findings.check("period_over_elasticity", period / elastic_period, 1.0, 1.5 / p.cells,
                       "free vibration of an elastic square; edges are softer");
        findings.check("swing", swing, 1.0, 0.25, "[HHM04] Fig. 2: oscillates symmetrically");
        findings.check("turned_in_a_period_degrees", turned, 0.0, 1.0,
                       "[HHM04] Fig. 2: without any rotation");
    }
    if (!claimed && std::isfinite(period)) {
        findings.measure("period_over_elasticity", period / elastic_period);
        findings.measure("swing", swing);
        findings.measure("turned_in_a_period_degrees", turned);
    }
    if (model.promises().angular_momentum == Promise::not_kept)
        findings.measure("angular_momentum", L);
    else
        findings.check("angular_momentum", L, 0.0, 1e-8, "[HHM04] V: vibration without L");
}

// ---- pictures ----

struct Snapshot {
    double t;
    Points<2> position;
    std::vector<double> shear_stress;

    void remember(Archive& archive) { archive(t, position, shear_stress); }
};

/// The square's outline through particles at these positions.
Points<2> outline_of(const Model<2>& model, const Points<2>& position) {
    const auto ring = outline(model.particles().reference_position, 1.0);
    return position(Eigen::all, ring);
}

/// (a) as let go, and then a period in quarters, over the outline of the square without stress.
void draw_configurations_of(Session& session, const Parameters& p, const Model<2>& model,
                            const std::vector<Snapshot>& snapshots, double period) {
    const char* titles[] = {"(a) let go", "(b) a quarter of a period", "half a period",
                            "three quarters", "a period"};
    std::vector<ConfigurationPanel> panels;
    for (int quarter = 0; quarter <= 4; ++quarter) {
        const auto off = [&](const Snapshot& s) { return std::abs(s.t - 0.25 * quarter * period); };
        const auto nearest =
            std::min_element(snapshots.begin(), snapshots.end(),
                             [&](const auto& a, const auto& b) { return off(a) < off(b); });
        panels.push_back({titles[quarter],
                          nearest->position,
                          nearest->shear_stress,
                          {outline_of(model, nearest->position),
                           outline_of(model, model.particles().reference_position)}});
    }
    draw_configurations(session, "configurations",
                        fmt::format("[HHM04] Fig. 2: sheared square, u_x = {:g} y, {} particles",
                                    p.shear, model.particles().size()),
                        panels, 5, "σ_xy / η γ");
}

void draw_motion(Session& session, const Parameters& p, const RunRecord& run,
                 double elastic_period) {
    const History& h = run.history;
    const auto t = h.column("t"), periods = divided(t, elastic_period);
    auto elastic = t;
    for (double& value : elastic) value = std::cos(2.0 * pi * value / elastic_period);
    const std::string x_label = "t / period of the elastic square";
    CurvePanel motion = frame("shear", x_label, "shear / γ"),
               turning = frame("rotation", x_label, "degrees"),
               energy = frame("energy", x_label, "energy");
    motion.curves = {{"particles", periods, divided(h.column("shear"), p.shear)},
                     {"elasticity, lowest mode", periods, elastic}};
    turning.curves = {{"long axis", periods, h.column("long_axis_degrees"), Mark::points},
                      {"square", periods, h.column("rotation_degrees")}};
    energy.curves = {{"kinetic", periods, h.column("kinetic")},
                     {"internal", periods, h.column("internal")},
                     {"total", periods, h.column("energy")}};
    draw_curves(session, "motion", "Sheared elastic square", {motion, turning, energy});
}

}  // namespace

int main(int argc, char** argv) {
    Problem problem("sheared_square",
                    "a sheared elastic square vibrates and does not rotate, [HHM04] Fig. 2");
    problem.units(lattice_units());
    Parameters p;
    auto& options = problem.options();
    options.integer("cells", p.cells, "particles along a side", between(6, 2000));
    options.number("shear", p.shear, "gamma of the initial displacement u_x = gamma y",
                   between(1e-6, 0.5));
    Scheme standard;
    standard.transport = Transport::monaghan;
    standard.angular_momentum = AngularMomentum::torque_pair;
    problem.use_scheme(standard);

    return problem.main(argc, argv, [&](Session& session) {
        session.smoke_default("cells", p.cells, 12);
        const auto model = make_square(p, session.scheme());
        const double period = 2.0 * pi * p.cells / (shear_mode_frequency(11) * c_T);
        std::vector<Snapshot> snapshots;
        Plan<2> plan;
        plan.t_end = 2.0 * period;
        plan.output_every = period / 120.0;
        plan.snapshot_every = period / 24.0;
        plan.record(columns());
        const auto keep = [&](double t, const Model<2>& m, std::span<const double> y) {
            if (t > 1.2 * period) return;
            const ConstState<2> state(m.layout(), y);
            const Eigen::VectorXd stress = state.stress().row(2) / (eta * p.shear);
            snapshots.push_back({t, state.position(), {stress.begin(), stress.end()}});
        };
        plan.observe({.on_snapshot = keep,
                      .memory = [&snapshots](Archive& archive) { archive(snapshots); }});
        const auto run = session.run(*model, sheared_state(*model, p.shear), std::move(plan));
        check(session, p, *model, run, period);
        if (!session.plots()) return;
        const double measured = measured_period(run.history, "shear");
        draw_configurations_of(session, p, *model, snapshots,
                               std::isfinite(measured) ? measured : period);
        draw_motion(session, p, run, period);
    });
}
