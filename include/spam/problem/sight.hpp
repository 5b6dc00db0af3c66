// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/picture/draw.hpp>
#include <spam/rhs/model.hpp>

namespace spam {

/// A plane configuration worth drawing: of the snapshots it is shown, the one nearest to a wanted
/// time.
struct Sight {
    double wanted;
    double t = -1.0;  ///< of the configuration kept; below 0 before any was shown
    Points<2> position{};
    std::vector<double> speed{};

    void remember(Archive& archive) { archive(t, position, speed); }
    void look(double now, const Model<2>& model, std::span<const double> y);

    /// Particles coloured by speed, the body's outline drawn.
    ConfigurationPanel panel(const std::string& title, const Particles<2>& particles) const;
};

/// For Plan::memory. A run that is restarted to a later end may want other times: each sight then takes
/// the nearest of the configurations kept.
void remember(Archive& archive, std::vector<Sight>& sights);

}  // namespace spam
