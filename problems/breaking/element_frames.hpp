// SPDX-License-Identifier: GPL-3.0-or-later
// Frames of bodies of elements, coloured by plastic strain.
#pragma once

#include <spam/material/plastic_fields.hpp>
#include <spam/picture/draw.hpp>
#include <spam/problem/observer.hpp>

#include <cmath>

namespace breaking {

using namespace spam;

/// Of the snapshots of a run, the one nearest to a wanted time.
struct ElementFrame {
    double wanted;
    double t = -1.0;       ///< of what is kept; below 0 before there is anything
    Points<2> position{};  ///< of the nodes
    std::vector<double> plastic_strain{},
        broken{};  ///< of the elements; `broken` empty where none can

    bool there() const { return t >= 0.0; }
    bool nearer(double other) const {
        return !there() || std::abs(other - wanted) <= std::abs(t - wanted);
    }
    void remember(Archive& archive) { archive(t, position, plastic_strain, broken); }
    void take(double now, const Model<2>& model, std::span<const double> y) {
        const ConstState<2> state(model.layout(), y), elements = state.elements();
        const std::size_t n = model.quadrilaterals().size();
        const double* const strain = elements.find(field_kind::plastic_strain);
        const double* const gone = elements.find(field_kind::broken);
        t = now;
        position = state.position();
        plastic_strain.assign(strain, strain + n);
        broken.clear();
        if (gone != nullptr) broken.assign(gone, gone + n);
    }
};

/// Keeps frames at snapshots, and in checkpoints; a restarted run may want other times. `frames` must outlive
/// the run.
inline Observer<2> keep_frames(std::vector<ElementFrame>& frames) {
    const auto keep = [&frames](double t, const Model<2>& model, std::span<const double> y) {
        for (ElementFrame& frame : frames)
            if (frame.nearer(t)) frame.take(t, model, y);
    };
    const auto memory = [&frames](Archive& archive) {
        auto kept = archive.reading() ? std::vector<ElementFrame>{} : frames;
        std::size_t count = kept.size();
        archive(count);
        kept.resize(count, ElementFrame{0.0});
        for (ElementFrame& frame : kept) archive(frame);
        if (!archive.reading()) return;
        for (ElementFrame& frame : frames)
            for (const ElementFrame& other : kept)
                if (other.there() && frame.nearer(other.t)) {
                    const double wanted = frame.wanted;
                    frame = other;
                    frame.wanted = wanted;
                }
    };
    return {.on_snapshot = keep, .memory = memory};
}

/// What has not broken, and the nodes of that: those that are left alone fly far. Precondition: frame.there().
inline ConfigurationPanel strain_panel(const std::string& title, const Model<2>& model,
                                       const ElementFrame& frame) {
    ConfigurationPanel panel{title, {}, {}, {}, {}};
    std::vector<std::int64_t> place(model.particles().size(), -1);
    std::vector<Eigen::Index> nodes;
    for (std::size_t k = 0; k < model.quadrilaterals().size(); ++k) {
        if (!frame.broken.empty() && frame.broken[k] != 0.0) continue;
        Quadrilateral corners = model.quadrilaterals()[k];
        for (std::uint32_t& i : corners) {
            if (place[i] < 0) {
                place[i] = static_cast<std::int64_t>(nodes.size());
                nodes.push_back(i);
            }
            i = static_cast<std::uint32_t>(place[i]);
        }
        panel.colour.push_back(frame.plastic_strain[k]);
        panel.elements.push_back(corners);
    }
    panel.position = frame.position(Eigen::all, nodes);
    return panel;
}

}  // namespace breaking
