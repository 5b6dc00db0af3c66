// SPDX-License-Identifier: GPL-3.0-or-later
// What is written to a checkpoint comes back bit for bit; what is no checkpoint is refused in one
// line; what cannot be written leaves the earlier file as it was.
#include "support/checkpoint.hpp"
#include "support/refusal.hpp"
#include <spam/core/error.hpp>

#include <boost/test/unit_test.hpp>
#include <hdf5.h>
#include <sys/stat.h>

#include <stdexcept>
#include <thread>

using namespace spam;
using namespace spam::test;
namespace fs = std::filesystem;

namespace {

void expect_refusal(const fs::path& path, const std::string& reason) {
    const std::string line = refusal([&] { CheckpointReader{path}; });
    BOOST_TEST(line.find(reason) != std::string::npos, "for '" << reason << "': " << line);
    BOOST_TEST(line.find(path.string()) != std::string::npos, line);
    BOOST_TEST(line.find('\n') == std::string::npos, line);
}

/// 64 bits, little-endian.
std::string number(std::uint64_t value) {
    std::string bytes;
    for (int k = 0; k < 8; ++k) bytes += static_cast<char>(value >> (8 * k));
    return bytes;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_kind_comes_back_bit_for_bit) {
    const Scratch folder;
    const Sample sample;
    sample.writer().save(folder / "a.h5");
    const CheckpointReader reader(folder / "a.h5");
    BOOST_TEST(sample.equals(reader));
    BOOST_TEST(!Sample(200, 2).equals(reader));  // the comparison can fail
    BOOST_TEST(reader.has("/state/counts"));
    BOOST_TEST(!reader.has("/state"));
    BOOST_TEST(!reader.has("/state/velocity"));
    BOOST_TEST(!reader.has("/stat/counts"));
    BOOST_TEST(!fs::exists(folder / "a.h5.tmp"));
}

BOOST_AUTO_TEST_CASE(large_arrays_come_back) {
    const Scratch folder;
    const Sample sample(700'000);  // 11 MB and 2 MB: several chunks, the last ones not full
    sample.writer().save(folder / "a.h5");
    BOOST_TEST(fs::file_size(folder / "a.h5") > 13'000'000U);
    BOOST_TEST(sample.equals(CheckpointReader(folder / "a.h5")));
}

BOOST_AUTO_TEST_CASE(what_is_not_there_or_of_another_kind_is_said) {
    const Scratch folder;
    Sample().writer().save(folder / "a.h5");
    const CheckpointReader reader(folder / "a.h5");
    BOOST_CHECK_THROW(reader.text("/state/velocity"), InputError);
    BOOST_CHECK_THROW(reader.text("/state/position"), InputError);
    BOOST_CHECK_THROW(reader.numbers("/case"), InputError);
    BOOST_CHECK_THROW(reader.numbers("/state/counts"), InputError);
    BOOST_CHECK_THROW(reader.columns("/state/counts"), InputError);
    BOOST_CHECK_THROW(reader.integers("/state/position"), InputError);
    BOOST_CHECK_THROW(reader.integers("/model/memory"), InputError);
    BOOST_CHECK_THROW(reader.bytes("/state/counts"), InputError);
    BOOST_CHECK_THROW(reader.bytes("/state"), InputError);
}

BOOST_AUTO_TEST_CASE(mistakes_of_the_program_are_logic_errors) {
    CheckpointWriter writer;
    const std::vector<double> three{1.0, 2.0, 3.0};
    writer.text("/a/b", "x");
    BOOST_CHECK_THROW(writer.text("/a/b", "x"), std::logic_error);
    BOOST_CHECK_THROW(writer.text("/a", "x"), std::logic_error);
    BOOST_CHECK_THROW(writer.text("/a/b/c", "x"), std::logic_error);
    for (const char* path : {"", "/", "a", "/a/"})
        BOOST_CHECK_THROW(writer.integers(path, {}), std::logic_error);
    BOOST_CHECK_THROW(writer.numbers("/c", three, 2), std::logic_error);
    BOOST_CHECK_THROW(writer.numbers("/c", three, 0), std::logic_error);
    writer.numbers("/c", three, 3);
}

BOOST_AUTO_TEST_CASE(equal_contents_make_equal_bytes) {
    const Scratch folder;
    const CheckpointWriter first = Sample().writer();
    first.save(folder / "a.h5");
    first.save(folder / "b.h5");
    // HDF5 dates things by the second.
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    Sample().writer().save(folder / "c.h5");
    Sample(200, 2).writer().save(folder / "d.h5");
    const std::string bytes = contents_of(folder / "a.h5");
    BOOST_TEST((contents_of(folder / "b.h5") == bytes));
    BOOST_TEST((contents_of(folder / "c.h5") == bytes));
    BOOST_TEST((contents_of(folder / "d.h5") != bytes));
}

BOOST_AUTO_TEST_CASE(threads_do_not_disturb_each_other) {
    const Scratch folder;
    const auto work = [&folder](unsigned seed) {
        const fs::path path = folder / std::to_string(seed);
        for (int k = 0; k < 20; ++k) {
            Sample(50, seed).writer().save(path);
            if (!Sample(50, seed).equals(CheckpointReader(path))) fs::remove(path);
        }
    };
    std::vector<std::thread> threads;
    for (unsigned seed = 0; seed < 4; ++seed) threads.emplace_back(work, seed);
    for (std::thread& thread : threads) thread.join();
    for (int seed = 0; seed < 4; ++seed) BOOST_TEST(fs::exists(folder / std::to_string(seed)));
}

BOOST_AUTO_TEST_CASE(what_hdf5_prints_elsewhere_is_left_as_it_was) {
    const auto print = [](hid_t, void*) -> herr_t { return 0; };
    H5Eset_auto2(H5E_DEFAULT, print, nullptr);
    const Scratch folder;
    Sample().writer().save(folder / "a.h5");
    BOOST_TEST(!CheckpointReader(folder / "a.h5").has("/nothing"));
    H5E_auto2_t now = nullptr;
    H5Eget_auto2(H5E_DEFAULT, &now, nullptr);
    BOOST_TEST((now == static_cast<H5E_auto2_t>(print)));
}

BOOST_AUTO_TEST_CASE(foreign_files_are_refused_in_one_line) {
    const Scratch folder;
    const std::string zeros(32, '\0');
    folder.write("empty", "");
    folder.write("text",
                 "It was a dark and stormy night; the rain fell in torrents - except at "
                 "occasional intervals.\n");
    const std::string begin = "SPAMckpt" + number(2);
    folder.write("huge", begin.substr(0, 1) + begin + number(~std::uint64_t{0}) + zeros);
    folder.write("bare", begin + number(0) + zeros);
    const hid_t plain =
        H5Fcreate((folder / "plain.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    BOOST_TEST_REQUIRE(plain >= 0);
    H5Fclose(plain);
    BOOST_TEST_REQUIRE(mkfifo((folder / "fifo").c_str(), 0600) == 0);
    fs::create_symlink("nowhere", folder / "dangling");
    fs::create_symlink("loop", folder / "loop");

    expect_refusal(folder / "absent", "No such file");
    expect_refusal(folder / "text/below", "Not a directory");
    expect_refusal(folder / "dangling", "No such file");
    expect_refusal(folder / "loop", "symbolic links");
    expect_refusal(folder.path(), "is a folder");
    expect_refusal(folder / "fifo", "not a regular file");
    expect_refusal("/dev/zero", "not a regular file");
    expect_refusal(folder / "empty", "not a SPAM checkpoint: 0 bytes");
    expect_refusal(folder / "text", "bears no seal");
    expect_refusal(folder / "plain.h5", "bears no seal");
    expect_refusal(folder / "huge", "damaged: 1 bytes where its seal says 18446744073709551615");
    expect_refusal(folder / "bare", "SHA-256");
    // root may read everything
    if (geteuid() != 0) {
        fs::permissions(folder / "text", fs::perms::none);
        expect_refusal(folder / "text", "Permission denied");
    }
}

BOOST_AUTO_TEST_CASE(other_formats_and_damage_are_told_apart) {
    const Scratch folder;
    Sample().writer().save(folder / "a.h5");
    const std::string whole = contents_of(folder / "a.h5");
    const std::size_t seal = whole.size() - 56;
    BOOST_TEST_REQUIRE(whole.substr(seal, 8) == "SPAMckpt");
    std::string changed = whole;
    changed[seal + 8] = 3;
    folder.write("later", changed);
    expect_refusal(folder / "later", "has format 3, and this version of SPAM reads format 2 only");
    changed = whole;
    changed[seal / 2] ^= 1;
    folder.write("flipped", changed);
    expect_refusal(folder / "flipped", "damaged: its SHA-256");
    folder.write("shorter", whole.substr(1));
    expect_refusal(folder / "shorter", "bytes where its seal says");
    folder.write("cut", whole.substr(0, whole.size() - 1));
    expect_refusal(folder / "cut", "cut short");
}

BOOST_AUTO_TEST_CASE(a_file_that_cannot_be_written_leaves_the_earlier_one) {
    const Scratch folder;
    const Sample earlier(200, 1), later(50'000, 2);
    earlier.writer().save(folder / "a.h5");
    folder.write("file", "");
    fs::create_directory(folder / "taken.h5");
    fs::create_directory(folder / "b.h5.tmp");
    const auto before = folder.listing();
    const auto expect_failure = [&](const fs::path& target, const std::string& reason) {
        try {
            later.writer().save(target);
            BOOST_ERROR("saved " << target);
        } catch (const OutputError& error) {
            const std::string line = error.what();
            BOOST_TEST(line.find(target.string()) != std::string::npos, line);
            BOOST_TEST(line.find(reason) != std::string::npos, line);
            BOOST_TEST(line.find('\n') == std::string::npos, line);
        }
        BOOST_TEST((folder.listing() == before));
    };
    expect_failure(folder / "file/a.h5", "Not a directory");
    expect_failure(folder / "absent/a.h5", "No such file");
    expect_failure(folder / "taken.h5", "Is a directory");
    expect_failure(folder / "b.h5", "File exists");
    expect_failure("/proc/a.h5", "");

    // A disk that is full after 4096, 70000, ... bytes. HDF5's own files crash at such an exit.
    for (const rlim_t limit : {rlim_t{0}, rlim_t{4096}, rlim_t{70'000}, rlim_t{500'000}}) {
        const int status = in_a_child([&] {
            std::signal(SIGXFSZ, SIG_IGN);
            const rlimit full{limit, limit};
            setrlimit(RLIMIT_FSIZE, &full);
            try {
                later.writer().save(folder / "a.h5");
            } catch (const OutputError& error) {
                return std::string(error.what()).find("File too large") != std::string::npos ? 7
                                                                                             : 8;
            }
            return 9;
        });
        BOOST_TEST(status == 7, "limit " << limit << ": " << status);
        BOOST_TEST((folder.listing() == before));
    }
    later.writer().save(folder / "a.h5");
    BOOST_TEST(later.equals(CheckpointReader(folder / "a.h5")));
}

BOOST_AUTO_TEST_CASE(what_a_killed_run_left_is_no_obstacle) {
    const Scratch folder;
    folder.write("outside", "precious");
    fs::create_symlink("outside", folder / "a.h5.tmp");
    BOOST_TEST_REQUIRE(mkfifo((folder / "b.h5.tmp").c_str(), 0600) == 0);
    Sample().writer().save(folder / "a.h5");
    Sample().writer().save(folder / "b.h5");
    BOOST_TEST(contents_of(folder / "outside") == "precious");
    BOOST_TEST(Sample().equals(CheckpointReader(folder / "b.h5")));
    BOOST_TEST(!fs::exists(fs::symlink_status(folder / "a.h5.tmp")));
}
