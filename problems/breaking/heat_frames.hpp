// SPDX-License-Identifier: GPL-3.0-or-later
// Frames of bodies of a solid with material vectors, coloured by the heat of their flow.
#pragma once

#include <spam/picture/draw.hpp>
#include <spam/problem/observer.hpp>
#include <spam/rhs/material_vectors.hpp>

#include <cmath>

namespace breaking {

using namespace spam;

/// Of the snapshots of a run, the one nearest to a wanted time.
struct HeatFrame {
    double wanted;
    double t = -1.0;  ///< of what is kept; below 0 before there is anything
    Points<2> position{};
    std::vector<double> heat{};  ///< of each particle

    bool there() const { return t >= 0.0; }
    bool nearer(double other) const {
        return !there() || std::abs(other - wanted) <= std::abs(t - wanted);
    }
    void remember(Archive& archive) { archive(t, position, heat); }
};

/// Keeps frames at snapshots, and in checkpoints; a restarted run may want other times. `frames` and `law` must
/// outlive the run.
inline Observer<2> keep_frames(std::vector<HeatFrame>& frames, const MaterialVectors<2>& law) {
    const auto keep = [&frames, &law](double t, const Model<2>& model, std::span<const double> y) {
        for (HeatFrame& frame : frames)
            if (frame.nearer(t))
                frame = {frame.wanted, t, ConstState<2>(model.layout(), y).position(),
                         law.heat_of_particles()};
    };
    const auto memory = [&frames](Archive& archive) {
        auto kept = archive.reading() ? std::vector<HeatFrame>{} : frames;
        std::size_t count = kept.size();
        archive(count);
        kept.resize(count, HeatFrame{0.0});
        for (HeatFrame& frame : kept) archive(frame);
        if (!archive.reading()) return;
        for (HeatFrame& frame : frames)
            for (const HeatFrame& other : kept)
                if (other.there() && frame.nearer(other.t))
                    frame = {frame.wanted, other.t, other.position, other.heat};
    };
    return {.on_snapshot = keep, .memory = memory};
}

}  // namespace breaking
