// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of rotating_hexagon share.
#pragma once

#include "../common.hpp"
#include <spam/rhs/material_vectors.hpp>

namespace rotating_hexagon {

using namespace spam;

enum class ModelKind { spam, md };
inline std::string_view to_string(ModelKind kind) {
    return kind == ModelKind::spam ? "spam" : "md";
}

struct Parameters {
    int size = 8;        // n: corners are n spacings from the centre
    double speed = 0.1;  // of the corners
    std::optional<double> turns;
    std::optional<double> figure;  // of [HHM04], 4 to 7
    ModelKind model = ModelKind::spam;
    Formulation formulation = Formulation::updated;
    std::optional<double> penalty;  // kappa of the solids that remember
    bool torques = false;           // record their distribution

    double omega() const { return speed / size; }
    double turn() const {  // nominal: the hexagon's own turn is slower
        return 2.0 * std::numbers::pi / omega();
    }
    bool md() const { return model == ModelKind::md; }
    bool lagrangian() const { return !md() && formulation == Formulation::total_lagrangian; }
    bool material_vectors() const { return !md() && formulation == Formulation::material_vectors; }
    bool remembers() const { return lagrangian() || material_vectors(); }
    double kappa() const {
        return penalty.value_or(lagrangian() ? 0.1 : MaterialVectorScheme::default_penalty);
    }
};

using Hexagon = Variant<2, Model<2>>;

Hexagon make_hexagon(const Parameters& p, ModelKind kind, const Scheme& scheme,
                     const std::string& label);

// ---- figures.cpp: the figures of the paper ----

/// Nominal turns that a figure shows.
double turns_of_figure(int figure);
/// The hexagons of a figure, in the order of its letters.
std::vector<Hexagon> hexagons_of_figure(const Parameters& p, const Scheme& standard);
/// What the paper's text says of the figure, and what it reports in passing.
void check_figure(Session& session, const Parameters& p, const std::vector<RunRecord>& runs);
void draw_figure(Session& session, const Parameters& p, const std::vector<Hexagon>& hexagons,
                 const std::vector<RunRecord>& runs);

// ---- pictures.cpp: of one case or the comparison ----

void draw(Session& session, const Parameters& p, const std::vector<Hexagon>& hexagons,
          const std::vector<RunRecord>& runs);
/// The curves of the comparison side by side, for one's own plots.
void write_comparison(const RunFolder& folder, const std::vector<RunRecord>& runs);

}  // namespace rotating_hexagon
