// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "process.hpp"
#include <spam/io/checkpoint_file.hpp>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace spam::test {

/// Something of every kind, some of it random.
struct Sample {
    explicit Sample(std::size_t particles = 200, unsigned seed = 1) {
        std::mt19937_64 random(seed);
        // Bits of any kind, NaNs with payloads among them.
        for (std::size_t k = 0; k < 2 * particles; ++k)
            position.push_back(std::bit_cast<double>(random()));
        position[0] = std::bit_cast<double>(std::uint64_t{0x7ff4dead0000beef});  // signalling
        position[1] = -0.0;
        for (std::size_t k = 0; k < 3 * particles; ++k)
            memory.push_back(static_cast<std::byte>(random()));
    }

    CheckpointWriter writer() const {
        CheckpointWriter checkpoint;
        checkpoint.text("/case", text);
        checkpoint.text("/note", "");
        checkpoint.numbers("/state/position", position, 2);
        checkpoint.numbers("/state/none", {}, 3);
        checkpoint.integers("/state/counts", counts);
        checkpoint.integers("/state/no_counts", {});
        checkpoint.bytes("/model/memory", memory);
        checkpoint.bytes("/model/deep/er/nothing", {});
        return checkpoint;
    }

    /// Bit for bit.
    bool equals(const CheckpointReader& reader) const {
        const auto bits = [](const std::vector<double>& values) {
            std::vector<std::uint64_t> all;
            for (const double x : values) all.push_back(std::bit_cast<std::uint64_t>(x));
            return all;
        };
        return reader.text("/case") == text && reader.text("/note").empty() &&
               bits(reader.numbers("/state/position")) == bits(position) &&
               reader.columns("/state/position") == 2 && reader.numbers("/state/none").empty() &&
               reader.columns("/state/none") == 3 && reader.integers("/state/counts") == counts &&
               reader.integers("/state/no_counts").empty() &&
               reader.bytes("/model/memory") == memory &&
               reader.bytes("/model/deep/er/nothing").empty();
    }

    std::string text = std::string("umlauts \xc3\xa4, a zero \0 and a newline\n", 35);
    std::vector<double> position;
    std::vector<std::int64_t> counts{0, -1, std::numeric_limits<std::int64_t>::min(),
                                     std::numeric_limits<std::int64_t>::max()};
    std::vector<std::byte> memory;
};

/// What a forked child made of `body`: its status, or -signal. It ends by exit(), so that what
/// libraries do at exit is tried too.
inline int in_a_child(const std::function<int()>& body) {
    std::signal(SIGCHLD, SIG_DFL);
    std::cout.flush();  // or the child would print it again
    const pid_t child = fork();
    if (child == 0) {
        const rlimit none{0, 0};
        setrlimit(RLIMIT_CORE, &none);
        for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGALRM})
            std::signal(signal, SIG_DFL);
        alarm(20);
        std::exit(body());
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace spam::test
