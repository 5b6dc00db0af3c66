// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "results.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace spam::view {

/// How many bytes the numbers of particles take. Fields are what is neither position nor velocity.
struct Thinning {
    int bytes = 4;        ///< 4: single precision; 2: whole numbers of 16 bits between the extremes
    int field_bytes = 4;  ///< likewise, and 1
    std::size_t every = 1;  ///< of the snapshots, beside the last

    /// One sentence for the page.
    std::string in_words() const;
};

/// What a page holds beside its program: a description, and blocks of numbers that it names.
struct Payload {
    nlohmann::json description;
    std::vector<std::string> blocks;  ///< base64
    Thinning thinning;
};

/// Bytes that the numbers take in a page, estimated without making them (an array that does not change is
/// counted once).
std::size_t bytes_in_page(const Results& results, const Thinning& thinning);

/// Bytes that names, checks and options take in a page.
std::size_t bytes_of_text(const Results& results);

/// The first of these that fits into `most` bytes: single precision (in small pages only), 16 bits, 8 bits
/// for fields, every 2nd, 3rd, ... snapshot. Throws InputError where two snapshots are too much.
Thinning thinned_to(const Results& results, std::size_t most);

Payload make_payload(const Results& results, const Thinning& thinning);

/// A value as it stands in a page. Between the tags of an element nothing may look like the end of it. What is
/// not UTF-8 (the name of a folder may be anything) is replaced.
std::string in_page(const nlohmann::json& value);

std::string base64(const std::string& bytes);

}  // namespace spam::view
