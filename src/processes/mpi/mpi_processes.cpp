// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/processes/processes.hpp>

#include <mpi.h>
#include <sys/prctl.h>

#include <chrono>
#include <cstdlib>
#include <limits>
#include <thread>

namespace spam {
namespace {

/// An exchange is one message to every other process, whose length is asked for where it arrives. A process that
/// waits looks for a while and then sleeps for moments: where there are fewer cores than processes the others need its core.
class MpiProcesses final : public Parts {
  public:
    MpiProcesses(int count, int own)
        : Parts(static_cast<std::size_t>(count), static_cast<std::size_t>(own)) {
        prctl(PR_SET_TIMERSLACK, 1000UL);  // nanoseconds, or each moment takes 50 us more
    }
    ~MpiProcesses() override { MPI_Finalize(); }
    MpiProcesses(const MpiProcesses&) = delete;
    MpiProcesses& operator=(const MpiProcesses&) = delete;

  private:
    /// Counts of MPI are int.
    static int length(std::size_t bytes) {
        if (bytes > static_cast<std::size_t>(std::numeric_limits<int>::max()))
            throw OutputError("ranks: more than 2 GiB for one other rank; use more ranks");
        return static_cast<int>(bytes);
    }

    std::vector<Bytes> transport(std::vector<Bytes> to, Content) override {
        std::vector<Bytes> from(count());
        std::vector<MPI_Request> sent;
        std::vector<int> awaited;
        for (std::size_t p = 0; p < count(); ++p) {
            if (p == own()) continue;
            awaited.push_back(static_cast<int>(p));
            MPI_Isend(to[p].data(), length(to[p].size()), MPI_BYTE, awaited.back(), 0,
                      MPI_COMM_WORLD, &sent.emplace_back());
        }
        const auto arrived = [&](int p) {
            int there = 0, size = 0;
            MPI_Message message;
            MPI_Status status;
            MPI_Improbe(p, 0, MPI_COMM_WORLD, &there, &message, &status);
            if (there == 0) return false;
            MPI_Get_count(&status, MPI_BYTE, &size);
            Bytes& bytes = from[static_cast<std::size_t>(p)];
            bytes.resize(static_cast<std::size_t>(size));
            MPI_Mrecv(bytes.data(), size, MPI_BYTE, &message, &status);
            return true;
        };
        until([&] {
            std::erase_if(awaited, arrived);
            return awaited.empty();
        });
        until([&] {
            int done = 0;
            MPI_Testall(static_cast<int>(sent.size()), sent.data(), &done, MPI_STATUSES_IGNORE);
            return done != 0;
        });
        from[own()] = std::move(to[own()]);
        return from;
    }

    template <class Done>
    static void until(const Done& done) {
        constexpr int looks = 20;
        for (int look = 0; !done(); ++look)
            if (look > looks) std::this_thread::sleep_for(std::chrono::microseconds(1));
    }
};

}  // namespace

std::string why_one_process() { return {}; }

/// Open MPI, and those whose processes are started by the protocol of MPICH.
bool started_with_others() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
        if (const char* size = std::getenv(name); size != nullptr && std::atoi(size) > 1)
            return true;
    return false;
}

std::unique_ptr<Parts> join_processes() {
    int provided = 0, count = 1, own = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_size(MPI_COMM_WORLD, &count);
    MPI_Comm_rank(MPI_COMM_WORLD, &own);
    return std::make_unique<MpiProcesses>(count, own);
}

}  // namespace spam
