// SPDX-License-Identifier: GPL-3.0-or-later
#include "target.hpp"

#include "../common.hpp"

namespace spam {

Points<2> Target::positions(double gap) const {
    const Points<2> bar = centred<2>(triangular_block(columns, rows));
    Points<2> ball = triangular_hexagon(projectile);
    ball.row(0).array() += bar.row(0).minCoeff() - projectile - gap;
    ball.row(1).array() += offset;
    Points<2> all(2, bar.cols() + ball.cols());
    all << bar, ball;
    return all;
}

std::vector<double> Target::start(Model<2>& model) const {
    auto y0 = lattice_state(model, at_rest<2>());
    const State<2> state(model.layout(), y0);
    for (std::size_t i = 0; i < model.particles().size(); ++i)
        if (model.particles().id[i] >= of_bar())
            state.velocity()(0, static_cast<Eigen::Index>(i)) = speed;
    return y0;
}

void add_target_options(Options& options, Target& target) {
    options.integer("columns", target.columns, "particles across the bar", between(2, 200));
    options.integer("rows", target.rows, "particles along the bar", between(4, 2000));
    options.integer("projectile", target.projectile, "size n of the hexagonal projectile",
                    between(1, 100));
    options.number("speed", target.speed, "speed of the projectile (the speed of sound is 1.06)",
                   between(1e-3, 1e6));
    options.number("offset", target.offset, "height of the impact above the middle of the bar",
                   between(-1e6, 1e6));
}

void make_small(const Session& session, Target& target) {
    session.smoke_default("columns", target.columns, 4);
    session.smoke_default("rows", target.rows, 16);
    session.smoke_default("projectile", target.projectile, 2);
    session.smoke_default("offset", target.offset, std::min(target.offset, 2.0));
}

void refuse_tunnelling(const Session& session, const Target& target, double range,
                       double row_interval) {
    const auto check = [&](const char* name, double interval, const char* what) {
        if (target.speed * interval <= range) return;
        refuse(
            "speed: at {:g} the projectile moves {:.3g} in {} {} = {:g}, more than the range {:g}, "
            "and would pass through the bar; lower it, or choose --{} below {:.2g}",
            target.speed, target.speed * interval, what, name, interval, range, name,
            range / target.speed);
    };
    if (session.integrator().dt) check("dt", *session.integrator().dt, "a step");
    check("output-every", row_interval, "the time between two searches for bodies,");
}

}  // namespace spam
