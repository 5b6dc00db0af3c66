// SPDX-License-Identifier: GPL-3.0-or-later
// How arrays of a checkpoint are cut into chunks, which have checksums.
#pragma once

#include "hdf5_handle.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace spam::hdf5 {

inline constexpr hsize_t checksum_bytes = 4;  ///< Fletcher's, behind each chunk

/// At most 1 MiB, the size of HDF5's cache, and as equal as rows allow: the last is filled up. `shape` has a row at
/// least, `element` is the size of one number in bytes.
inline std::vector<hsize_t> chunk_of(std::span<const hsize_t> shape, hsize_t element) {
    std::vector<hsize_t> chunk(shape.begin(), shape.end());
    hsize_t row = element;
    for (const hsize_t n : shape.subspan(1)) row *= n;
    const hsize_t most = std::max<hsize_t>(1, (1 << 20) / std::max<hsize_t>(1, row));
    const hsize_t chunks = (shape[0] + most - 1) / most;
    chunk[0] = (shape[0] + chunks - 1) / chunks;
    return chunk;
}

/// Whether a dataset has the chunks that a run writes, and is as long in the file as these take. HDF5 1.10 believes
/// what a damaged file says of its chunks, and reads past the end of those that are shorter.
inline bool has_written_chunks(hid_t dataset, hid_t space, hsize_t element) {
    const Properties creation(H5Dget_create_plist(dataset));
    if (H5Pget_layout(creation) != H5D_CHUNKED) return true;
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank < 1) return false;
    std::vector<hsize_t> shape(static_cast<std::size_t>(rank)), chunk(shape.size());
    H5Sget_simple_extent_dims(space, shape.data(), nullptr);
    if (shape[0] == 0 || H5Pget_chunk(creation, rank, chunk.data()) != rank ||
        chunk != chunk_of(shape, element))
        return false;
    hsize_t bytes = element;
    for (const hsize_t n : chunk) bytes *= n;
    return H5Dget_storage_size(dataset) ==
           (shape[0] + chunk[0] - 1) / chunk[0] * (bytes + checksum_bytes);
}

}  // namespace spam::hdf5
