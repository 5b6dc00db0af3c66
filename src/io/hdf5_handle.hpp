// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <hdf5.h>

#include <atomic>
#include <cstdlib>
#include <mutex>
#include <string>
#include <utility>

namespace spam::hdf5 {

/// Around every use of HDF5: one thread at a time, since it need not be built for more, and without
/// its own printing of errors, which is put back as it was.
class Silence {
  public:
    Silence() : lock_(mutex()) {
        [[maybe_unused]] static const bool once = also_at_exit();
        H5Eget_auto2(H5E_DEFAULT, &print_, &argument_);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    ~Silence() { H5Eset_auto2(H5E_DEFAULT, print_, argument_); }
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;

  private:
    /// A damaged file can keep HDF5 from closing all it has opened, which it says when the program ends. Called
    /// before that, because registered after it.
    static bool also_at_exit() {
        H5open();
        return std::atexit([] { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }) == 0;
    }
    static std::recursive_mutex& mutex() {
        static std::recursive_mutex the_one;
        return the_one;
    }
    std::lock_guard<std::recursive_mutex> lock_;
    H5E_auto2_t print_ = nullptr;
    void* argument_ = nullptr;
};

/// An identifier of HDF5 that closes itself; negative: the call that should have made it failed.
template <herr_t (*Close)(hid_t)>
class Handle {
  public:
    explicit Handle(hid_t id) : id_(id) {}
    ~Handle() {
        if (id_ >= 0) Close(id_);
    }
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;

    operator hid_t() const { return id_; }
    explicit operator bool() const { return id_ >= 0; }

  private:
    hid_t id_;
};

using File = Handle<H5Fclose>;
using H5Group = Handle<H5Gclose>;  // Group is one of particles (external/external.hpp)
using Dataset = Handle<H5Dclose>;
using Space = Handle<H5Sclose>;
using Type = Handle<H5Tclose>;
using Properties = Handle<H5Pclose>;

/// Properties of something to be made; equal contents shall make equal bytes, so no times.
inline Properties timeless(hid_t kind) {
    Properties properties(H5Pcreate(kind));
    H5Pset_obj_track_times(properties, false);
    return properties;
}

/// Properties of access to a file in memory only, which grows by 64 KiB: HDF5 fills what it grows by with
/// zeros, and most checkpoints are small.
inline Properties in_memory() {
    Properties properties(H5Pcreate(H5P_FILE_ACCESS));
    H5Pset_fapl_core(properties, 1 << 16, false);
    return properties;
}

/// HDF5 knows files in memory by their names, and first looks on the disk for one: each gets a
/// name of its own that no file can have.
inline std::string no_file() {
    static std::atomic<unsigned long> count{0};
    return "/dev/null/spam-" + std::to_string(++count);
}

}  // namespace spam::hdf5
