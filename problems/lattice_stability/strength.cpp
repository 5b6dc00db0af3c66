// SPDX-License-Identifier: GPL-3.0-or-later
#include "strength.hpp"

namespace lattice_stability {
namespace {

/// Waves of a block of cells x cells (an even number) that are the same as those with -k: homomorphisms
/// of its translations to 1 and -1. On the triangular one rows are shifted: half as many, unless half the
/// number of cells is even too.
int self_conjugate_waves(LatticeKind lattice, int cells) {
    return lattice == LatticeKind::square || cells % 4 == 0 ? 4 : 2;
}

/// Corners of the zone, where three neighbours in turn move alike and the odd sums over grad w vanish too.
int corner_waves(LatticeKind lattice, int cells) {
    return lattice == LatticeKind::triangular && cells % 3 == 0 ? 2 : 0;
}

/// How many modes symmetry leaves free (tests/physics/lattice_strength.cpp says why).
int expected_zero_modes(const Parameters& p, LatticeKind lattice, Acting acting) {
    const int s = self_conjugate_waves(lattice, p.cells);
    return acting == Acting::density     ? p.cells * p.cells + s + corner_waves(lattice, p.cells)
           : acting == Acting::curvature ? 2 * s
                                         : 2;
}

/// "1e-17", or 0 for what must not be drawn.
double visible(double eigenvalue, double largest) {
    const double part = eigenvalue / largest;
    return std::abs(part) > LatticeSpectrum::threshold ? std::abs(part) : 0.0;
}

std::vector<double> ranges_of(const std::vector<Analysed>& all) {
    std::vector<double> ranges;
    for (const auto& one : all)
        if (std::find(ranges.begin(), ranges.end(), one.range) == ranges.end())
            ranges.push_back(one.range);
    return ranges;
}

}  // namespace

void refuse_meaningless(const Parameters& p, LatticeKind lattice, Acting acting, double range) {
    elastic_moduli(p.potentials(lattice, acting, range), vectors_of(lattice));
    refuse_narrow("cells", lattice, p.cells, range);
}

Analysed analyse(const Parameters& p, LatticeKind lattice, Acting acting, double range) {
    const DensityPotentials potentials = p.potentials(lattice, acting, range);
    return {lattice, acting, range,
            LatticeSpectrum(
                hessian(potentials, positions_of(lattice, p.cells), box_of(lattice, p.cells))),
            elastic_moduli(potentials, vectors_of(lattice))};
}

std::vector<Analysed> analyse_all(const Parameters& p, const std::vector<double>& ranges) {
    std::vector<Analysed> all;
    for (const Acting acting : all_potentials)
        for (const auto lattice : {LatticeKind::triangular, LatticeKind::square})
            for (const double h : ranges) all.push_back(analyse(p, lattice, acting, h));
    return all;
}

void report(Session& session, const Parameters& p, const Analysed& one, const std::string& prefix) {
    const Findings findings(session, prefix);
    // Where neighbours hardly reach each other all of it is rounding.
    const bool known = p.misfit == 1.0 && one.range >= 1.5 && p.kernel != Kernel::w2,
               w5 = p.kernel == Kernel::w5;
    // Another weight may lose a mode by accident, where a sum over neighbours passes through zero.
    findings.claim("zero_modes", double(one.spectrum.zero),
                   expected_zero_modes(p, one.lattice, one.acting), 0.0,
                   "[HH07] 8, counted by symmetry", known && (one.acting == Acting::density || w5));
    findings.claim("negative_modes", double(one.spectrum.negative), 0.0, 0.0,
                   "sums of squares that vanish on the lattice", known);
    if (!has_curvature(one.acting))
        findings.claim("shear_modulus", one.moduli.shear, 0.0, 1e-8, "[HH07] 8: G = C44 = 0",
                       known);
    else
        findings.claim("shear_modulus", one.moduli.shear, 0.94928 * p.strength, 1e-4 * p.strength,
                       "lattice sum of the curvature's change under shear",
                       known && w5 && one.lattice == LatticeKind::triangular && one.range == 2.5);
}

void print_table(Session& session, const std::vector<Analysed>& all) {
    session.terminal().say("");
    session.terminal().say(fmt::format("{:<11}{:<11}{:>6}{:>5}{:>9}{:>9}{:>12}{:>13}{:>9}{:>8}",
                                       "potentials", "lattice", "range", "zero", "negative",
                                       "up to", "others from", "(C11-C12)/2", "C44", "bulk"));
    const auto tidy = [](double G) { return std::abs(G) < 1e-8 ? 0.0 : G; };
    for (const auto& one : all)
        session.terminal().say(fmt::format(
            "{:<11}{:<11}{:>6g}{:>5}{:>9}{:>9.0e}{:>12.0e}{:>13.5f}{:>9.5f}{:>8.4f}",
            to_string(one.acting), to_string(one.lattice), one.range, one.spectrum.zero,
            one.spectrum.negative, one.spectrum.largest_zero, one.spectrum.smallest_other,
            tidy(one.moduli.shear), tidy(one.moduli.diagonal_shear), one.moduli.bulk));
    session.terminal().say(
        fmt::format("eigenvalues in parts of the largest; below {:g} they count as zero",
                    LatticeSpectrum::threshold));
}

void write_spectra(const RunFolder& folder, const std::vector<Analysed>& all) {
    std::vector<std::string> names{"number"};
    for (const auto& one : all)
        names.push_back(
            fmt::format("{}_{}_h{:g}", to_string(one.acting), to_string(one.lattice), one.range));
    CsvWriter csv(folder / "spectra.csv", names);
    for (std::size_t k = 0; k < all.front().spectrum.eigenvalue.size(); ++k) {
        std::vector<double> row{double(k + 1)};
        for (const auto& one : all) row.push_back(one.spectrum.eigenvalue[k]);
        csv.add(row);
    }
}

void draw_modes(Session& session, const Parameters& p, const std::vector<Analysed>& all) {
    HeatMap map{{{"potentials", {}}}, {{"lattice", {}}, {"range h", {}}}, {}, {}, "", true};
    map.value_label = "modes without energy";
    for (const Acting acting : all_potentials) map.rows[0].values.push_back(title_of(acting));
    map.columns[0].values = {"triangular", "square"};
    for (const double h : ranges_of(all)) map.columns[1].values.push_back(fmt::format("{:g}", h));
    for (const auto& one : all) {
        map.value.push_back(one.spectrum.zero);
        const double G = one.moduli.shear / p.strength;
        const int negative = one.spectrum.negative;
        map.text.push_back(
            fmt::format("{}{}\nG {:.2g}", one.spectrum.zero,
                        negative == 0 ? std::string{} : fmt::format(", {} < 0", negative),
                        std::abs(G) < 1e-7 ? 0.0 : G));
    }
    draw_heat_map(session, "zero_modes",
                  fmt::format("Modes without energy of {0} × {0} particles, of "
                              "{1}, and shear modulus G (unit: strength)",
                              p.cells, 2 * p.cells * p.cells),
                  map);
}

void draw_spectra(Session& session, const Parameters& p, const std::vector<Analysed>& all,
                  double range) {
    std::vector<CurvePanel> panels;
    for (const auto lattice : {LatticeKind::triangular, LatticeKind::square}) {
        CurvePanel panel{fmt::format("{} lattice", to_string(lattice)),
                         "mode",
                         "eigenvalue / largest",
                         true,
                         {}};
        for (const auto& one : all) {
            if (one.lattice != lattice || one.range != range) continue;
            Curve curve{title_of(one.acting), {}, {}, Mark::line, style_of(one.acting)};
            const auto& values = one.spectrum.eigenvalue;
            for (std::size_t k = 0; k < values.size(); ++k)
                add_point(curve, double(k + 1), visible(values[k], values.back()));
            panel.curves.push_back(std::move(curve));
        }
        if (!panel.curves.empty()) panels.push_back(std::move(panel));
    }
    draw_curves(
        session, "spectra",
        fmt::format("Second derivatives of the energy without their zeros, {0} × {0} particles, "
                    "{1}, h = {2:g}",
                    p.cells, spam::to_string(p.kernel), range),
        panels);
}

}  // namespace lattice_stability
