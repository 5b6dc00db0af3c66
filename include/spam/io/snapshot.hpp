// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/unit_names.hpp>
#include <spam/io/run_folder.hpp>
#include <spam/rhs/model.hpp>

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spam {

/// Writes NAME.pvd, a list of files and the times they show, for ParaView. Throws OutputError.
void write_file_series(const RunFolder& folder, std::string_view name,
                       const std::vector<std::pair<double, std::string>>& files);

/// A number of every particle that no field has, as it is shown: "leading_share".
struct ParticleNumbers {
    std::string_view name;
    std::span<const double> values;  ///< in the order of y
};

/// Configurations for ParaView: one PolyData file per time, snapshot_0000.vtp, ... (raw appended
/// data, little endian) and snapshots.pvd, the list of them with their times, complete after every
/// snapshot. Points are inside the box where it is periodic (those of y are not). Point arrays: id (no two
/// alike), body, mass, particle_spacing, velocity (3), and where the model has them density, stress
/// (3 x 3 tensor) and energy. Elements are polygons between the points, with all their fields as cell arrays and
/// `element`, their number (below 0 for a particle that is no corner of any); where some are of a fluid also density,
/// stress and energy as they follow from the corners. Field data: TimeValue, box_low, box_high,
/// periodic (3 each): the box ends at its walls, and where a side is open with the last particle. Where they are
/// declared the text `units` says them, and where they have names arrays carry theirs as VTK has it (UNITS_LABEL).
template <int Dim>
class SnapshotSeries {
  public:
    SnapshotSeries(const RunFolder& folder, const Model<Dim>& model, UnitNames units = {})
        : folder_(folder),
          model_(&model),
          units_(std::move(units)) {}

    /// Goes on after earlier ones at these times; removes what an earlier run left after them. Throws
    /// OutputError.
    void resume(const std::vector<double>& times);
    /// Names of the files so far.
    std::vector<std::string> names() const;

    /// Further ones are of a model of other particles.
    void go_on_with(const Model<Dim>& model) { model_ = &model; }

    /// `more`: shown beside the fields. Throws OutputError.
    void add(double t, std::span<const double> y, std::span<const ParticleNumbers> more = {});

  private:
    RunFolder folder_;
    const Model<Dim>* model_;
    UnitNames units_;
    std::vector<std::pair<double, std::string>> files_;
};

SPAM_COMPILED(extern template class SnapshotSeries);

}  // namespace spam
