// SPDX-License-Identifier: GPL-3.0-or-later
#include "checkpoint_chunks.hpp"
#include "file_descriptor.hpp"
#include "hdf5_image.hpp"
#include "sealed_file.hpp"
#include <spam/core/error.hpp>
#include <spam/io/checkpoint_file.hpp>

#include <fmt/format.h>

#include <new>
#include <optional>
#include <stdexcept>

namespace spam {
namespace {

using namespace hdf5;

File empty_file(const Properties& access) {
    const Silence silence;
    File file(H5Fcreate(no_file().c_str(), H5F_ACC_TRUNC, timeless(H5P_FILE_CREATE), access));
    if (!file) throw std::bad_alloc();
    return file;
}

[[noreturn]] void cannot_hold(std::string_view path) {
    throw OutputError(fmt::format("checkpoint: HDF5 cannot hold '{}' (no memory?)", path));
}

/// Makes the groups above `path`, whose name must be free.
void make_way(hid_t file, const std::string& path) {
    if (path.size() < 2 || path.front() != '/' || path.back() == '/')
        throw std::logic_error(fmt::format("checkpoint: '{}' is no path like '/a/b'", path));
    for (std::size_t end = path.find('/', 1); end != std::string::npos;
         end = path.find('/', end + 1)) {
        const std::string above = path.substr(0, end);
        if (H5Group(H5Gopen2(file, above.c_str(), H5P_DEFAULT))) continue;
        const Properties creation = timeless(H5P_GROUP_CREATE);
        if (!H5Group(H5Gcreate2(file, above.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT)))
            throw std::logic_error(
                fmt::format("checkpoint: '{}' cannot be above '{}'", above, path));
    }
    if (H5Lexists(file, path.c_str(), H5P_DEFAULT) > 0)
        throw std::logic_error(fmt::format("checkpoint: '{}' is given twice", path));
}

void set_chunks(hid_t creation, std::span<const hsize_t> shape, std::size_t element) {
    H5Pset_chunk(creation, static_cast<int>(shape.size()), chunk_of(shape, element).data());
    H5Pset_fletcher32(creation);
}

/// An array of `type` in the file as `stored`.
void store(hid_t file, std::string_view path, hid_t type, hid_t stored, const void* values,
           std::span<const hsize_t> shape) {
    const std::string name(path);
    make_way(file, name);
    const Properties creation = timeless(H5P_DATASET_CREATE);
    const bool empty = shape[0] == 0;  // then there are no chunks
    if (!empty) set_chunks(creation, shape, H5Tget_size(stored));
    const Space space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr));
    const Dataset dataset(
        H5Dcreate2(file, name.c_str(), stored, space, H5P_DEFAULT, creation, H5P_DEFAULT));
    if (!dataset) cannot_hold(path);
    // What integers of another size pass through on their way; of the usual 1 MiB every page would be zeroed.
    const Properties transfer(H5Pcreate(H5P_DATASET_XFER));
    H5Pset_buffer(transfer, 1 << 14, nullptr, nullptr);
    if (!empty && H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, transfer, values) < 0)
        cannot_hold(path);
}

}  // namespace

struct CheckpointWriter::Image {
    explicit Image(std::size_t reserve) : bytes_(reserve), file_(empty_file(bytes_.access())) {}

    hid_t file() const {
        if (!file_) throw std::logic_error("checkpoint: nothing can be added after it was saved");
        return *file_;
    }
    /// What HDF5 would have left on a disk. Closed, as it would otherwise bear a mark that a process is
    /// writing.
    std::span<const std::byte> contents() {
        const Silence silence;
        if (file_) {
            const bool flushed = H5Fflush(*file_, H5F_SCOPE_LOCAL) >= 0;
            const ssize_t size = flushed ? H5Fget_file_image(*file_, nullptr, 0) : -1;
            size_ = size > 0 ? static_cast<std::size_t>(size) : 0;
            file_.reset();
        }
        return bytes_.first(size_);
    }

  private:
    GrowingImage bytes_;
    std::optional<File> file_;
    std::size_t size_ = 0;
};

/// Groups and the heads of arrays take a few KB, checksums and chunks that are not full a little.
CheckpointWriter::CheckpointWriter(std::size_t expected)
    : image_(std::make_unique<Image>(expected == 0 ? 0 : expected + expected / 64 + (1 << 20))) {}
CheckpointWriter::~CheckpointWriter() {
    const Silence silence;
    image_.reset();
}
CheckpointWriter::CheckpointWriter(CheckpointWriter&&) noexcept = default;

void CheckpointWriter::text(std::string_view path, std::string_view value) {
    const Silence silence;
    const std::string name(path), terminated(value);
    make_way(image_->file(), name);
    const Type type(H5Tcopy(H5T_C_S1));
    H5Tset_size(type, terminated.size() + 1);
    H5Tset_cset(type, H5T_CSET_UTF8);
    const Space space(H5Screate(H5S_SCALAR));
    const Properties creation = timeless(H5P_DATASET_CREATE);
    const Dataset dataset(
        H5Dcreate2(image_->file(), name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT));
    if (!dataset || H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, terminated.c_str()) < 0)
        cannot_hold(path);
}

void CheckpointWriter::numbers(std::string_view path, std::span<const double> values,
                               std::size_t columns) {
    if (columns == 0 || values.size() % columns != 0)
        throw std::logic_error(fmt::format("checkpoint: '{}' has {} values in {} columns", path,
                                           values.size(), columns));
    const Silence silence;
    const hsize_t shape[] = {values.size() / columns, columns};
    store(image_->file(), path, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, values.data(), shape);
}

void CheckpointWriter::integers(std::string_view path, std::span<const std::int64_t> values) {
    const Silence silence;
    const hsize_t shape[] = {values.size()};
    store(image_->file(), path, H5T_NATIVE_INT64, H5T_STD_I64LE, values.data(), shape);
}

void CheckpointWriter::integers32(std::string_view path, std::span<const std::int32_t> values) {
    const Silence silence;
    const hsize_t shape[] = {values.size()};
    store(image_->file(), path, H5T_NATIVE_INT32, H5T_STD_I64LE, values.data(), shape);
}

void CheckpointWriter::bytes(std::string_view path, std::span<const std::byte> values) {
    const Silence silence;
    const hsize_t shape[] = {values.size()};
    store(image_->file(), path, H5T_NATIVE_UINT8, H5T_STD_U8LE, values.data(), shape);
}

void CheckpointWriter::save(const std::filesystem::path& target) const {
    const std::span<const std::byte> contents = image_->contents();
    if (contents.empty())
        throw OutputError(
            fmt::format("cannot write '{}': HDF5 gives no image (no memory?)", target.string()));
    const Seal seal = seal_of(contents);
    replace_file(target, {contents, seal});
}

}  // namespace spam
