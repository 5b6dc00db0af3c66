// SPDX-License-Identifier: GPL-3.0-or-later
// At rest: modes and moduli of lattices, as a table and as pictures.
#pragma once

#include "lattice.hpp"

namespace lattice_stability {

/// One lattice under some of the potentials, analysed.
struct Analysed {
    LatticeKind lattice;
    Acting acting;
    double range;
    LatticeSpectrum spectrum;
    ElasticModuli moduli;
};

/// Throws InputError, before anything is computed, where one of the cases cannot be.
void refuse_meaningless(const Parameters& p, LatticeKind lattice, Acting acting, double range);

Analysed analyse(const Parameters& p, LatticeKind lattice, Acting acting, double range);

/// Both lattices, all potentials and ranges.
std::vector<Analysed> analyse_all(const Parameters& p, const std::vector<double>& ranges);

/// `prefix`zero_modes, negative_modes and shear_modulus, with what is known of them.
void report(Session& session, const Parameters& p, const Analysed& one, const std::string& prefix);

/// A line for each, and spectra.csv.
void print_table(Session& session, const std::vector<Analysed>& all);
void write_spectra(const RunFolder& folder, const std::vector<Analysed>& all);

/// Numbers of modes of all that were analysed.
void draw_modes(Session& session, const Parameters& p, const std::vector<Analysed>& all);
/// Eigenvalues in order, of those of one range.
void draw_spectra(Session& session, const Parameters& p, const std::vector<Analysed>& all,
                  double range);

}  // namespace lattice_stability
