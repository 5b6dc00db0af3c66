// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes of a file that HDF5 believes to be on a disk. It takes and returns them by callbacks, made
// for this (H5Pset_file_image_callbacks), so that there is one copy of them and it is ours.
#pragma once

#include "hdf5_handle.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

namespace spam::hdf5 {

/// Where HDF5 asks for memory. The same one for all copies of a list of properties.
inline H5FD_file_image_callbacks_t callbacks_of(void* image) {
    H5FD_file_image_callbacks_t calls{};
    calls.udata_copy = [](void* data) { return data; };
    calls.udata_free = [](void*) -> herr_t { return 0; };
    calls.udata = image;
    return calls;
}

/// A file that grows while it is written. What is reserved is taken from the system only as it is used.
class GrowingImage {
  public:
    explicit GrowingImage(std::size_t reserve) : reserve_(reserve) {}
    ~GrowingImage() { std::free(bytes_); }
    GrowingImage(const GrowingImage&) = delete;
    GrowingImage& operator=(const GrowingImage&) = delete;

    Properties access() {
        Properties properties = in_memory();
        auto calls = callbacks_of(this);
        calls.image_realloc = [](void*, std::size_t size, H5FD_file_image_op_t, void* image) {
            return static_cast<GrowingImage*>(image)->resize(size);
        };
        calls.image_free = [](void*, H5FD_file_image_op_t, void*) -> herr_t { return 0; };
        H5Pset_file_image_callbacks(properties, &calls);
        return properties;
    }
    /// The first `size` bytes; valid until the file grows.
    std::span<const std::byte> first(std::size_t size) const {
        return std::span<const std::byte>(bytes_, size_).first(std::min(size, size_));
    }

  private:
    void* resize(std::size_t size) {
        if (size > capacity_) {
            void* const more = std::realloc(bytes_, std::max(size, reserve_));
            if (more == nullptr) return nullptr;
            bytes_ = static_cast<std::byte*>(more);
            capacity_ = std::max(size, reserve_);
        }
        size_ = size;
        return bytes_;
    }

    std::byte* bytes_ = nullptr;
    std::size_t size_ = 0, capacity_ = 0, reserve_;
};

/// A file that is only read: these bytes, not a copy.
class FixedImage {
  public:
    explicit FixedImage(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}
    FixedImage(const FixedImage&) = delete;
    FixedImage& operator=(const FixedImage&) = delete;

    /// Negative where HDF5 does not take it.
    Properties access() {
        Properties properties = in_memory();
        auto calls = callbacks_of(this);
        calls.image_malloc = [](std::size_t size, H5FD_file_image_op_t, void* image) -> void* {
            auto& bytes = static_cast<FixedImage*>(image)->bytes_;
            return size == bytes.size() ? bytes.data() : nullptr;
        };
        calls.image_memcpy = [](void* to, const void* from, std::size_t, H5FD_file_image_op_t,
                                void*) { return to == from ? to : nullptr; };
        calls.image_free = [](void*, H5FD_file_image_op_t, void*) -> herr_t { return 0; };
        const bool taken = H5Pset_file_image_callbacks(properties, &calls) >= 0 &&
                           H5Pset_file_image(properties, bytes_.data(), bytes_.size()) >= 0;
        return taken ? std::move(properties) : Properties(-1);
    }

  private:
    std::vector<std::byte> bytes_;
};

}  // namespace spam::hdf5
