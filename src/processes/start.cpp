// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/program.hpp>
#include <spam/core/threads.hpp>
#include <spam/processes/processes.hpp>

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace spam {
namespace {

constexpr const char* status_variable = "SPAM_STATUS_FILE";

std::atomic<pid_t> launcher = 0;
std::atomic<int> passed_on = 0;

/// The first signal lets the processes complete their results, as InterruptWatch says; a second one ends them.
extern "C" void pass_on(int signal) {
    const bool again = passed_on.exchange(signal) != 0;
    if (launcher > 0) kill(launcher, again ? SIGTERM : signal == SIGINT ? SIGUSR1 : SIGUSR2);
}

void set_unless_given(const char* name, const char* value) { setenv(name, value, 0); }

/// In a process group of its own: what a terminal sends on Ctrl-C comes to us alone. It ends with us.
[[noreturn]] void become_mpirun(std::size_t count, char** argv) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (usable_cores() < static_cast<int>(count))
        set_unless_given("OMPI_MCA_mpi_yield_when_idle", "1");
    // To look for faster networks than the memory of one machine takes a quarter of a second.
    bool of_a_queue = false;
    for (const char* job : {"SLURM_JOB_ID", "PBS_JOBID", "LSB_JOBID"})
        of_a_queue = of_a_queue || std::getenv(job) != nullptr;
    if (!of_a_queue) set_unless_given("OMPI_MCA_pml", "ob1");
    // Longer messages wait for two answers, each of which needs the core of another process.
    set_unless_given("OMPI_MCA_btl_vader_eager_limit", "65536");
    set_unless_given("OMPI_MCA_rmaps_base_oversubscribe", "1");
    if (geteuid() == 0) {  // a container, most often; mpirun would refuse
        set_unless_given("OMPI_ALLOW_RUN_AS_ROOT", "1");
        set_unless_given("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
    }
    const std::string n = std::to_string(count),
                      self = std::filesystem::read_symlink("/proc/self/exe");
    std::vector<const char*> words{"mpirun",    "-q",   "-n",        n.c_str(),
                                   "--bind-to", "none", self.c_str()};
    for (char** word = argv + 1; *word != nullptr; ++word) words.push_back(*word);
    words.push_back(nullptr);
    if (freopen("/dev/null", "r", stdin) == nullptr) _exit(127);
    execvp("mpirun", const_cast<char**>(words.data()));
    _exit(127);
}

}  // namespace

/// Open MPI, and those whose processes are started by the protocol of MPICH.
bool started_with_others() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
        if (const char* size = std::getenv(name); size != nullptr && std::atoi(size) > 1)
            return true;
    return false;
}

std::size_t ranks_asked_for(int argc, const char* const* argv) {
    for (int k = 1; k < argc; ++k) {
        const std::string word = argv[k];
        std::string number;
        if (word == "--ranks" && k + 1 < argc) number = argv[k + 1];
        if (word.rfind("--ranks=", 0) == 0) number = word.substr(std::strlen("--ranks="));
        std::size_t count = 0;
        const auto [end, error] =
            std::from_chars(number.data(), number.data() + number.size(), count);
        if (!number.empty() && error == std::errc() && end == number.data() + number.size() &&
            count <= 1024)
            return count;
    }
    return 1;
}

int start_processes(std::size_t count, char** argv) {
    if (find_program("mpirun").empty())
        throw InputError(
            "ranks: there is no mpirun on PATH, which starts them; install it (Debian: openmpi-bin), "
            "or leave --ranks out");
    const std::filesystem::path folder = make_temporary_folder("spam-status"),
                                name = folder / "status";
    setenv(status_variable, name.c_str(), 1);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        if (std::signal(signal, pass_on) == SIG_IGN) std::signal(signal, SIG_IGN);
    // A signal waits until it is known which process to pass it on to.
    sigset_t signals, before;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
    sigprocmask(SIG_BLOCK, &signals, &before);
    const pid_t child = fork();
    if (child == 0) {
        sigprocmask(SIG_SETMASK, &before, nullptr);
        become_mpirun(count, argv);
    }
    const int refused = errno;
    launcher = child;
    sigprocmask(SIG_SETMASK, &before, nullptr);
    std::error_code ignored;
    if (child < 0) {
        std::filesystem::remove_all(folder, ignored);
        throw OutputError(fmt::format(
            "ranks: no process can be started ({}); raise the limit on processes (ulimit -u)",
            std::strerror(refused)));
    }
    int ended = 0;
    while (waitpid(child, &ended, 0) < 0 && errno == EINTR) {
    }
    int status = -1;
    std::ifstream(name) >> status;
    std::filesystem::remove_all(folder, ignored);
    if (status >= 0) return status;
    // It has not come to its end: a signal at once, or a process that was killed, of which mpirun -q says nothing.
    if (passed_on != 0) return 128 + passed_on;
    const std::string report = fmt::format(
        "{}: ranks: a process ended without saying why; it may have been killed, for want of memory for instance. If "
        "the result folder has a checkpoint, --restart goes on from it\n",
        std::filesystem::path(argv[0]).filename().string());
    std::fputs(report.c_str(), stderr);
    return WIFEXITED(ended) && WEXITSTATUS(ended) != 0 ? WEXITSTATUS(ended) : 4;
}

int report_status(int status) {
    const char* name = std::getenv(status_variable);
    if (name == nullptr) return status;
    std::ofstream(name) << status;
    return 0;
}

}  // namespace spam
