// SPDX-License-Identifier: GPL-3.0-or-later
// A damaged checkpoint is never read: a thousand kinds of damage, each refused in one line. Without
// the digest HDF5 takes some of them for contents.
#include "support/checkpoint.hpp"
#include "support/effort.hpp"
#include <spam/core/error.hpp>

#include <boost/test/unit_test.hpp>
#include <nettle/sha2.h>
#include <nettle/version.h>

#include <cstdio>

using namespace spam;
using namespace spam::test;

/// Asked for by the leak sanitizer. A forged file can keep HDF5 from closing when a program ends ("infinite
/// loop closing library"): what it then has not freed is its own, out of our reach. Linked as an
/// archive it has no name but those of its functions.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5\nleak:H5"; }

namespace {

constexpr std::size_t seal_size = 56, digest_size = 32;

/// Damages that disks, networks and careless programs do.
class Vandal {
  public:
    explicit Vandal(unsigned seed) : random_(seed) {}

    /// Never the same bytes.
    std::string damage(const std::string& whole) {
        std::string bytes = whole;
        while (bytes == whole) once(bytes);
        return bytes;
    }
    /// Of the same length, with a seal that agrees: what a reader without the digest would see.
    std::string damage_and_seal(const std::string& whole) {
        std::string bytes = whole;
        const std::size_t sealed = whole.size() - seal_size;
        while (bytes.substr(0, sealed) == whole.substr(0, sealed)) {
            bytes = whole;
            overwrite(bytes, below(4), sealed);
        }
        seal(bytes);
        return bytes;
    }
    static void seal(std::string& bytes) {
        const std::size_t end = bytes.size() - digest_size;
        sha256_ctx context;
        sha256_init(&context);
        sha256_update(&context, end, reinterpret_cast<const std::uint8_t*>(bytes.data()));
        auto* const digest = reinterpret_cast<std::uint8_t*>(&bytes[end]);
#if NETTLE_VERSION_MAJOR >= 4
        sha256_digest(&context, digest);
#else
        sha256_digest(&context, digest_size, digest);
#endif
    }

  private:
    std::size_t below(std::size_t n) {
        return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
    }
    void once(std::string& bytes) {
        const std::size_t kind = below(7);
        if (kind < 4) overwrite(bytes, kind, bytes.size());
        if (kind == 4) bytes.resize(below(bytes.size()));
        if (kind == 5)
            for (std::size_t k = 1 + below(600); k > 0; --k) bytes += static_cast<char>(random_());
        if (kind == 6) bytes.erase(below(bytes.size()), 1 + below(512));
    }
    void overwrite(std::string& bytes, std::size_t kind, std::size_t size) {
        const std::size_t block = std::min<std::size_t>(1 + below(512), size / 2);
        const std::size_t a = below(size - block), b = below(size - block);
        if (kind == 0) bytes[below(size)] ^= static_cast<char>(1U << below(8));
        if (kind == 1)
            for (std::size_t k = 0; k < 8; ++k) bytes[below(size)] = static_cast<char>(random_());
        if (kind == 2) std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(a), block, '\0');
        if (kind == 3)
            for (std::size_t k = 0; k < block; ++k) std::swap(bytes[a + k], bytes[b + k]);
    }
    std::mt19937 random_;
};

/// As statuses of children nothing else ends with: sanitizers, say, do with 1 or 23.
enum Verdict { refused = 40, accepted_equal, accepted_changed };

Verdict verdict(const std::filesystem::path& path, const Sample& sample) {
    try {
        return sample.equals(CheckpointReader(path)) ? accepted_equal : accepted_changed;
    } catch (const InputError& error) {
        const std::string line = error.what();
        BOOST_TEST(line.find('\n') == std::string::npos, line);
        return refused;
    }
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_thousand_damaged_files_are_refused) {
    const Scratch folder;
    const Sample sample;
    sample.writer().save(folder / "whole.h5");
    const std::string whole = contents_of(folder / "whole.h5");
    Vandal vandal(7);
    int read = 0;
    for (int k = 0; k < 1000; ++k) {
        folder.write("damaged.h5", vandal.damage(whole));
        read += verdict(folder / "damaged.h5", sample) != refused;
    }
    BOOST_TEST(read == 0);
    folder.write("damaged.h5", whole);
    BOOST_TEST(verdict(folder / "damaged.h5", sample) == accepted_equal);
}

// The law that makes the test above fail: the same damages under a digest that agrees, which is no
// digest at all. In children, as HDF5 may crash.
BOOST_AUTO_TEST_CASE(without_the_digest_damage_is_read) {
    const Scratch folder;
    const Sample sample;
    sample.writer().save(folder / "whole.h5");
    const std::string whole = contents_of(folder / "whole.h5");
    Vandal vandal(7);
    int read_wrong = 0, read_right = 0, refusals = 0, crashed = 0;
    constexpr int all = 200;
    for (int k = 0; k < all; ++k) {
        folder.write("damaged.h5", vandal.damage_and_seal(whole));
        const int status = in_a_child([&] {
            if (std::freopen((folder / "said").c_str(), "a", stderr) == nullptr) return 1;
            return static_cast<int>(verdict(folder / "damaged.h5", sample));
        });
        read_right += status == accepted_equal;
        read_wrong += status == accepted_changed;
        refusals += status == refused;
        crashed += status < 0;
    }
    BOOST_TEST(read_right + read_wrong + refusals + crashed == all);
    BOOST_TEST_MESSAGE("of " << all << " read with other contents: " << read_wrong
                             << ", unharmed: " << read_right << ", crashed: " << crashed);
    BOOST_TEST(read_right + read_wrong > 0);
    BOOST_TEST(read_wrong > 0);
    // Not even where it cannot close what it has opened.
    BOOST_TEST(contents_of(folder / "said").find("HDF5") == std::string::npos);
}

/// Each byte under a digest that agrees: HDF5 believes what is said of chunks, and would read past the end of what it
/// holds. Other numbers may be read; without the digest nothing says that they are.
BOOST_AUTO_TEST_CASE(no_byte_lets_an_array_be_read_past_its_end) {
    const Scratch folder;
    CheckpointWriter writer;
    writer.numbers("/a", std::vector<double>(30, 1.0), 2);
    writer.save(folder / "whole.h5");
    const std::string whole = contents_of(folder / "whole.h5");
    const int status = in_a_child([&] {
        if (std::freopen((folder / "said").c_str(), "a", stderr) == nullptr) return 1;
        std::size_t refusals = 0;
        const std::size_t each = effort<std::size_t>(1, 7);
        for (std::size_t at = 0; at + seal_size < whole.size(); at += each) {
            std::string bytes = whole;
            bytes[at] = static_cast<char>(bytes[at] ^ '\x80');
            Vandal::seal(bytes);
            folder.write("damaged.h5", bytes);
            try {
                CheckpointReader(folder / "damaged.h5").numbers("/a");
            } catch (const InputError&) {
                ++refusals;
            }
        }
        return refusals > 100 / each ? 0 : 3;
    });
    BOOST_TEST(status == 0);
}
