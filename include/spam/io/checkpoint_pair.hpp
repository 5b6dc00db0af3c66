// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/io/checkpoint_file.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace spam {

/// The checkpoints of a run: checkpoint_0.h5 and checkpoint_1.h5 in its folder, overwritten in
/// turn, so that the newest but one outlives whatever happens to the newest. Each holds its number
/// at /sequence, from 1 on; a file that cannot be read counts as the oldest.
class CheckpointPair {
  public:
    explicit CheckpointPair(const std::filesystem::path& folder);

    /// The newest complete checkpoint, if any.
    std::optional<std::filesystem::path> newest() const;
    /// The file that save() will overwrite.
    const std::filesystem::path& next() const;
    /// Of the newest checkpoint, 0 when there is none.
    std::int64_t sequence() const;

    /// Numbers the checkpoint and saves it as next(). Throws OutputError; the pair is then as it
    /// was.
    void save(CheckpointWriter checkpoint);

  private:
    std::size_t last() const;  ///< place of the newest
    std::array<std::filesystem::path, 2> paths_;
    std::array<std::int64_t, 2> sequences_;  ///< 0: not there or not to be read
};

/// The newest complete checkpoint of a CheckpointPair in that folder, if any.
inline std::optional<std::filesystem::path> newest_checkpoint(const std::filesystem::path& folder) {
    return CheckpointPair(folder).newest();
}

}  // namespace spam
