// SPDX-License-Identifier: GPL-3.0-or-later
#include "checkpoint_chunks.hpp"
#include "hdf5_image.hpp"
#include "sealed_file.hpp"
#include <spam/core/error.hpp>
#include <spam/io/checkpoint_file.hpp>

#include <fmt/format.h>

namespace spam {
namespace {

using namespace hdf5;

File open_image(FixedImage& bytes, const std::filesystem::path& path) {
    const Silence silence;
    const Properties access = bytes.access();
    File file(access ? H5Fopen(no_file().c_str(), H5F_ACC_RDONLY, access) : -1);
    if (!file)
        throw InputError(fmt::format(
            "checkpoint '{}' is whole, but HDF5 cannot open it (a newer HDF5's, or no memory)",
            path.string()));
    return file;
}

}  // namespace

struct CheckpointReader::Image {
    explicit Image(const std::filesystem::path& path)
        : name(path.string()),
          bytes(read_sealed(path)),
          file(open_image(bytes, path)) {}

    /// What is at `path`, of that class, size of elements (0: any) and rank.
    Dataset find(std::string_view path, const char* kind, H5T_class_t type_class, std::size_t size,
                 int rank) const {
        Dataset dataset(H5Dopen2(file, std::string(path).c_str(), H5P_DEFAULT));
        if (!dataset)
            throw InputError(
                fmt::format("checkpoint '{}' holds no '{}'; use the version of SPAM that wrote it",
                            name, path));
        const Type type(H5Dget_type(dataset));
        const Space space(H5Dget_space(dataset));
        if (H5Tget_class(type) != type_class || (size > 0 && H5Tget_size(type) != size) ||
            H5Sget_simple_extent_ndims(space) != rank ||
            !has_written_chunks(dataset, space, H5Tget_size(type)))
            throw InputError(
                fmt::format("checkpoint '{}' holds '{}', but not as {}; use the version of SPAM "
                            "that wrote it",
                            name, path, kind));
        return dataset;
    }

    template <class T>
    std::vector<T> read(const Dataset& dataset, hid_t type, std::string_view path) const {
        const Space space(H5Dget_space(dataset));
        std::vector<T> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
        read_into(dataset, type, values.data(), values.empty(), path);
        return values;
    }

    void read_into(const Dataset& dataset, hid_t type, void* values, bool nothing,
                   std::string_view path) const {
        if (!nothing && H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
            throw InputError(
                fmt::format("checkpoint '{}' is whole, but HDF5 cannot read '{}'", name, path));
    }

    std::string name;
    FixedImage bytes;
    File file;
};

CheckpointReader::CheckpointReader(const std::filesystem::path& path)
    : image_(std::make_unique<Image>(path)) {}
CheckpointReader::~CheckpointReader() {
    const Silence silence;
    image_.reset();
}

bool CheckpointReader::has(std::string_view path) const {
    const Silence silence;
    return static_cast<bool>(
        Dataset(H5Dopen2(image_->file, std::string(path).c_str(), H5P_DEFAULT)));
}

std::string CheckpointReader::text(std::string_view path) const {
    const Silence silence;
    const Dataset dataset = image_->find(path, "a text", H5T_STRING, 0, 0);
    const Type type(H5Dget_type(dataset));
    std::string value(H5Tget_size(type), '\0');
    image_->read_into(dataset, type, value.data(), false, path);
    value.pop_back();  // the final zero
    return value;
}

std::vector<double> CheckpointReader::numbers(std::string_view path) const {
    const Silence silence;
    const Dataset dataset = image_->find(path, "numbers", H5T_FLOAT, sizeof(double), 2);
    return image_->read<double>(dataset, H5T_NATIVE_DOUBLE, path);
}

std::size_t CheckpointReader::columns(std::string_view path) const {
    const Silence silence;
    const Dataset dataset = image_->find(path, "numbers", H5T_FLOAT, sizeof(double), 2);
    hsize_t shape[2] = {0, 0};
    H5Sget_simple_extent_dims(Space(H5Dget_space(dataset)), shape, nullptr);
    return static_cast<std::size_t>(shape[1]);
}

std::vector<std::int64_t> CheckpointReader::integers(std::string_view path) const {
    const Silence silence;
    const Dataset dataset = image_->find(path, "integers", H5T_INTEGER, sizeof(std::int64_t), 1);
    return image_->read<std::int64_t>(dataset, H5T_NATIVE_INT64, path);
}

std::vector<std::byte> CheckpointReader::bytes(std::string_view path) const {
    const Silence silence;
    const Dataset dataset = image_->find(path, "bytes", H5T_INTEGER, 1, 1);
    return image_->read<std::byte>(dataset, H5T_NATIVE_UINT8, path);
}

}  // namespace spam
