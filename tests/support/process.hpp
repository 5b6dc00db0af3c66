// SPDX-License-Identifier: GPL-3.0-or-later
// Programs run by black-box tests, as a user runs them: from a folder, through pipes or on a
// terminal, with signals. Link nothing beyond the C library.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/statvfs.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace spam::test {

inline std::string contents_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error("cannot read " + file.string());
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Where folders of tests lie: in memory, where there is enough of it and programs may be started from there. Runs wait
/// until what they have written is on the disk, two thirds of the time of a short one. TMPDIR says where else.
inline std::filesystem::path scratch_root() {
    constexpr const char* in_memory = "/dev/shm";
    constexpr double enough = 2e9;  // bytes
    struct statvfs room {};
    const bool there = std::getenv("TMPDIR") == nullptr && access(in_memory, W_OK) == 0 &&
                       statvfs(in_memory, &room) == 0 && (room.f_flag & ST_NOEXEC) == 0;
    const double bytes = static_cast<double>(room.f_bavail) * static_cast<double>(room.f_frsize);
    return there && bytes > enough ? in_memory : std::filesystem::temp_directory_path();
}

/// A folder of its own, gone at the end.
class Scratch {
  public:
    Scratch() {
        std::string name = (scratch_root() / "spam-test-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot create " + name);
        path_ = name;
    }
    ~Scratch() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    void write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << text;
    }

    /// Everything below: path to contents, "/" for folders. Equal maps: nothing was touched.
    std::map<std::string, std::string> listing() const {
        std::map<std::string, std::string> all;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(path_))
            all[entry.path().lexically_relative(path_).string()] =
                entry.is_regular_file() ? contents_of(entry.path()) : "/";
        return all;
    }

  private:
    std::filesystem::path path_;
};

/// How a program ended and what it printed.
struct Outcome {
    int status = -1;  ///< exit status; -1 when a signal ended it
    int signal = 0;   ///< the signal that ended it
    std::string out;  ///< on a terminal: everything
    std::string err;
};

struct Launch {
    std::filesystem::path folder = ".";           ///< working directory
    unsigned short columns = 0;                   ///< above 0: on a terminal as wide as this
    std::function<void()> before_exec = nullptr;  ///< in the child: limits, environment
};

class Child {
  public:
    using Seconds = std::chrono::duration<double>;

    Child(std::vector<std::string> command, const Launch& launch = {}) {
        // Boost.Test takes every child that ends with a status other than 0 for a failure.
        std::signal(SIGCHLD, SIG_DFL);
        int err_pipe[2], out_pipe[2] = {-1, -1};
        winsize size{40, launch.columns, 0, 0};
        const bool terminal = launch.columns > 0;
        if (pipe2(err_pipe, O_CLOEXEC) != 0 || (!terminal && pipe2(out_pipe, O_CLOEXEC) != 0))
            throw std::runtime_error("no pipe");
        pid_ = terminal ? forkpty(&out_, nullptr, nullptr, &size) : fork();
        if (pid_ < 0) throw std::runtime_error("cannot fork");
        if (pid_ == 0) {
            if (!terminal) {
                dup2(out_pipe[1], STDOUT_FILENO);
                dup2(err_pipe[1], STDERR_FILENO);
            }
            become(command, launch);
        }
        if (!terminal) {
            close(out_pipe[1]);
            out_ = out_pipe[0];
        }
        close(err_pipe[1]);
        err_ = err_pipe[0];
    }
    ~Child() {
        close_if_open(out_);
        close_if_open(err_);
        if (reaped_) return;
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    void send(int signal) const { kill(pid_, signal); }
    /// Keys typed on its terminal; "\x03" is Ctrl-C.
    bool type(const std::string& keys) const {
        return write(out_, keys.data(), keys.size()) == static_cast<ssize_t>(keys.size());
    }

    /// Reads what it prints until the condition holds; false when it ends or time is up before.
    bool wait_for(const std::function<bool(const Outcome&)>& condition,
                  Seconds limit = Seconds(60)) {
        const auto end = std::chrono::steady_clock::now() + limit;
        while (!condition(outcome_)) {
            if ((out_ < 0 && err_ < 0) || std::chrono::steady_clock::now() > end) return false;
            read_for(10);
        }
        return true;
    }

    /// Waits for the end; throws when that takes longer than the limit.
    Outcome finish(Seconds limit = Seconds(60)) {
        const auto end = std::chrono::steady_clock::now() + limit;
        int status = 0;
        while (out_ >= 0 || err_ >= 0 || waitpid(pid_, &status, WNOHANG) != pid_) {
            if (std::chrono::steady_clock::now() > end)
                throw std::runtime_error("still running after the time limit; it printed:\n" +
                                         outcome_.out + outcome_.err);
            read_for(10);
        }
        reaped_ = true;
        if (WIFEXITED(status)) outcome_.status = WEXITSTATUS(status);
        if (WIFSIGNALED(status)) outcome_.signal = WTERMSIG(status);
        return outcome_;
    }

  private:
    [[noreturn]] static void become(const std::vector<std::string>& command, const Launch& launch) {
        for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGCHLD}) std::signal(signal, SIG_DFL);
        std::vector<char*> argv;
        for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
        argv.push_back(nullptr);
        if (chdir(launch.folder.c_str()) != 0) _exit(127);
        if (launch.before_exec) launch.before_exec();
        execvp(argv[0], argv.data());
        _exit(127);
    }
    static void close_if_open(int& fd) {
        if (fd >= 0) close(fd);
        fd = -1;
    }
    void read_for(int milliseconds) {
        pollfd ready[2] = {{out_, POLLIN, 0}, {err_, POLLIN, 0}};  // negative ones are ignored
        poll(ready, 2, milliseconds);
        take(out_, ready[0].revents, outcome_.out);
        take(err_, ready[1].revents, outcome_.err);
    }
    static void take(int& fd, short events, std::string& text) {
        if (events == 0) return;
        char buffer[4096];
        const ssize_t n = read(fd, buffer, sizeof buffer);
        if (n > 0) text.append(buffer, static_cast<std::size_t>(n));
        if (n == 0 || (n < 0 && errno != EINTR)) close_if_open(fd);  // a closed terminal gives EIO
    }

    pid_t pid_ = -1;
    int out_ = -1, err_ = -1;
    bool reaped_ = false;
    Outcome outcome_;
};

#ifdef SPAM_PROBLEMS  // spam_problem_test() says where they are
/// A problem executable of this build with its arguments.
inline std::vector<std::string> problem(const std::string& name,
                                        const std::vector<std::string>& arguments) {
    std::vector<std::string> command{std::string(SPAM_PROBLEMS) + "/" + name};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return command;
}
#endif

inline Outcome run(const std::vector<std::string>& command, const Launch& launch = {}) {
    return Child(command, launch).finish();
}

/// Whether there is a gnuplot that starts.
inline bool have_gnuplot() { return std::system("gnuplot --version >/dev/null 2>&1") == 0; }

/// Empty files by the names of the libraries that a program loads: one that looks for them in its working folder
/// cannot start there.
inline void put_false_libraries(const std::string& program, const Scratch& folder) {
    std::istringstream lines(run({"ldd", program}).out);
    for (std::string line; std::getline(lines, line);)
        if (const auto end = line.find(" => "); end != std::string::npos)
            folder.write(line.substr(line.find_first_not_of(" \t"), end - 1), "");
}

}  // namespace spam::test
