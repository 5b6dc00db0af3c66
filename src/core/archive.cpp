// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/archive.hpp>
#include <spam/core/error.hpp>

#include <cstdint>
#include <cstring>

namespace spam {
namespace {

[[noreturn]] void refuse() {
    throw InputError("what was remembered is not what this version remembers");
}

}  // namespace

void Archive::raw(void* value, std::size_t size) {
    if (size == 0) return;
    if (!reading_) {
        const std::size_t before = written_.size();
        // Grows by an eighth, not to the double of what may be a kilobyte for every particle.
        if (before + size > written_.capacity()) written_.reserve(before + size + before / 8);
        written_.resize(before + size);
        std::memcpy(&written_[before], value, size);
        return;
    }
    if (source_.size() - at_ < size) refuse();
    std::memcpy(value, &source_[at_], size);
    at_ += size;
}

std::size_t Archive::count(std::size_t size, std::size_t bytes_each) {
    auto number = static_cast<std::uint64_t>(size);
    raw(&number, sizeof number);
    if (reading_ && bytes_each > 0 && number > (source_.size() - at_) / bytes_each) refuse();
    return static_cast<std::size_t>(number);
}

void Archive::shape(std::size_t rows, std::size_t columns, int fixed_rows,
                    int fixed_columns) const {
    if (!reading_) return;
    const bool fits = (fixed_rows < 0 || rows == static_cast<std::size_t>(fixed_rows)) &&
                      (fixed_columns < 0 || columns == static_cast<std::size_t>(fixed_columns));
    const std::size_t room = (source_.size() - at_) / sizeof(double);
    if (!fits || (columns > 0 && rows > room / columns)) refuse();
}

void Archive::expect_end() const {
    if (reading_ && at_ != source_.size()) refuse();
}

}  // namespace spam
