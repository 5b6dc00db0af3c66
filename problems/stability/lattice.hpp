// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of stability share.
#pragma once

#include "../lattice_choice.hpp"
#include <spam/analysis/bonded_lattice.hpp>
#include <spam/analysis/wave_vectors.hpp>

namespace stability {

using namespace spam;

struct Parameters {
    double stress = 0.02, shear_stress = 0.0;
    int cells = 24;
    Formulation formulation = Formulation::updated;
    std::optional<double> penalty;
    bool memoryless = false;
    int dimension = 2;
    CubicLattice lattice = CubicLattice::sc;

    bool vectors() const { return formulation == Formulation::material_vectors; }
};

/// What the analysis says at some wave vectors, given as those of the lattice free of strain.
struct Spectrum {
    Points<2> k;
    std::vector<double> growth, low_frequency, high_frequency;

    std::size_t fastest() const;
};

/// What answers for one lattice; wave vectors are those of the strained one, F^-t times those of the free one.
struct Waves {
    std::function<double(const Point<2>& k)> growth_rate;
    std::function<std::vector<double>(const Point<2>& k)> frequencies;
    std::function<double(const Point<2>& k, const Point<2>& direction)> frequency;
    Eigen::Matrix2d strained = Eigen::Matrix2d::Identity();  ///< F^-t
    double noise;                                            ///< rates below are round-off
};

struct Analysed {
    std::string label, title;
    std::string row;          ///< in the table
    std::string description;  ///< of the scheme
    bool stable = false;      ///< whether nothing is known to grow
    bool elastic;             ///< whether long waves are known to be those of linear elasticity
    std::function<Waves(RunStatistics&)> analyse;
    Spectrum path{}, sample{};
    double transverse_speed = 0.0, longitudinal_speed = 0.0;  // of long waves
    double lowest =
        0.0;  ///< smallest frequency of the sample by that of an elastic transverse wave
    double noise = 0.0;
};

/// Plain SPAM and its averages, or the scheme of the options.
std::vector<Analysed> smooth_particles(const Parameters& p, const Scheme& scheme, bool single);

/// Material vectors with several penalties and without a memory, or those of the options.
std::vector<Analysed> material_vectors(const Parameters& p, double range, bool single);

/// Cubic lattices in space, without options of the scheme (`single`) two of them; with --stress one, else two stresses.
void analyse_in_space(Session& session, const Parameters& p, bool single);

// ---- report.cpp ----

void write_spectrum(const RunFolder& folder, const std::string& name, const Spectrum& spectrum,
                    const std::vector<double>& distance);
void report(Session& session, const Parameters& p, const Analysed& one);
void print_table(Session& session, const Parameters& p, const std::vector<Analysed>& all);
void draw(Session& session, const Parameters& p, const WavePath& path,
          const std::vector<Analysed>& all);

}  // namespace stability
