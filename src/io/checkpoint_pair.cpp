// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/io/checkpoint_pair.hpp>

#include <span>
#include <utility>

namespace spam {
namespace {

constexpr const char* number_path = "/sequence";

std::int64_t sequence_of(const std::filesystem::path& path) {
    try {
        const auto number = CheckpointReader(path).integers(number_path);
        return number.size() == 1 && number[0] > 0 ? number[0] : 0;
    } catch (const InputError&) {
        return 0;
    }
}

}  // namespace

CheckpointPair::CheckpointPair(const std::filesystem::path& folder)
    : paths_{folder / "checkpoint_0.h5", folder / "checkpoint_1.h5"},
      sequences_{sequence_of(paths_[0]), sequence_of(paths_[1])} {}

std::size_t CheckpointPair::last() const { return sequences_[0] >= sequences_[1] ? 0 : 1; }

std::int64_t CheckpointPair::sequence() const { return sequences_[last()]; }

std::optional<std::filesystem::path> CheckpointPair::newest() const {
    if (sequence() == 0) return {};
    return paths_[last()];
}

const std::filesystem::path& CheckpointPair::next() const {
    return paths_[sequence() == 0 ? 0 : 1 - last()];
}

void CheckpointPair::save(CheckpointWriter checkpoint) {
    const std::int64_t number = sequence() + 1;
    checkpoint.integers(number_path, std::span(&number, 1));
    checkpoint.save(next());
    sequences_[sequence() == 0 ? 0 : 1 - last()] = number;
}

}  // namespace spam
