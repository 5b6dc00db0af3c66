// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/threads.hpp>
#include <spam/processes/processes.hpp>

#include <mpi.h>
#include <semaphore.h>
#include <sys/prctl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <new>
#include <thread>

namespace spam {
namespace {

/// In memory that all processes of one machine share. A process that waits for messages sleeps until the last one of an
/// exchange is under way: where there are fewer cores than processes the others need its core, and looks or naps by a
/// timer, some for every message, cost them most of it.
class Bells {
  public:
    Bells(int count, int own)
        : others_(static_cast<std::uint64_t>(count) - 1),
          looks_(usable_cores() < count ? 0 : 10000) {
        MPI_Comm machine;
        MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, own, MPI_INFO_NULL, &machine);
        int here = 0;
        MPI_Comm_size(machine, &here);
        if (here == count) {
            void* memory = nullptr;
            MPI_Win_allocate_shared(sizeof(Bell), 1, MPI_INFO_NULL, machine, &memory, &window_);
            own_ = new (memory) Bell;
            sem_init(&own_->last, 1, 0);
            MPI_Barrier(machine);
            for (int p = 0; p < count; ++p) {
                MPI_Aint size = 0;
                int unit = 0;
                MPI_Win_shared_query(window_, p, &size, &unit, &memory);
                all_.push_back(static_cast<Bell*>(memory));
            }
        }
        MPI_Comm_free(&machine);
    }
    ~Bells() {
        if (own_ != nullptr) MPI_Win_free(&window_);
    }
    Bells(const Bells&) = delete;
    Bells& operator=(const Bells&) = delete;

    bool reach_all() const { return own_ != nullptr; }
    /// After a message to p.
    void ring(int p) {
        if (own_ == nullptr) return;
        Bell& bell = *all_[static_cast<std::size_t>(p)];
        if (++bell.arrived[turn_] % others_ == 0) sem_post(&bell.last);
    }
    /// After messages to all others: until all of theirs are under way.
    void wait() {
        if (own_ == nullptr) return;
        int look = 0;
        while ((look++ < looks_ ? sem_trywait(&own_->last) : sem_wait(&own_->last)) != 0) {
        }
        turn_ = 1 - turn_;
    }

  private:
    struct Bell {
        /// Of every other exchange: a process may be one ahead, but not two.
        std::array<std::atomic<std::uint64_t>, 2> arrived{};
        sem_t last;
    };
    std::uint64_t others_;
    int looks_;  ///< before it sleeps, which takes longer than most messages
    std::size_t turn_ = 0;
    Bell* own_ = nullptr;  ///< null where there are several machines
    std::vector<Bell*> all_;
    MPI_Win window_{};
};

/// An exchange is one message to every other process, whose length is asked for where it arrives.
class MpiProcesses final : public Parts {
  public:
    /// `ours`: whether MPI ends with it.
    MpiProcesses(int count, int own, bool ours)
        : Parts(static_cast<std::size_t>(count), static_cast<std::size_t>(own)),
          ours_(ours),
          answered_(largest_without_an_answer()),
          bells_(std::make_unique<Bells>(count, own)) {
        prctl(PR_SET_TIMERSLACK, 1000UL);  // nanoseconds, or each moment takes 50 us more
    }
    ~MpiProcesses() override {
        // The first one still writes: MPI itself would look for it without a rest.
        for (std::size_t p = 0; p < count(); ++p)
            if (p != own()) bells_->ring(static_cast<int>(p));
        if (!alone()) bells_->wait();
        finish_sending();
        bells_.reset();
        if (ours_) MPI_Finalize();
    }
    MpiProcesses(const MpiProcesses&) = delete;
    MpiProcesses& operator=(const MpiProcesses&) = delete;

  private:
    /// Counts of MPI are int.
    static int length(std::size_t bytes) {
        if (bytes > static_cast<std::size_t>(std::numeric_limits<int>::max()))
            throw OutputError("ranks: more than 2 GiB for one other rank; use more ranks");
        return static_cast<int>(bytes);
    }

    /// Bytes; a longer message arrives only after its receiver has asked for it, and the sender has looked.
    static std::size_t largest_without_an_answer() {
        const char* set = std::getenv("OMPI_MCA_btl_vader_eager_limit");
        constexpr std::size_t of_the_library = 4096, header = 256;
        const std::size_t limit = set != nullptr ? std::strtoul(set, nullptr, 10) : of_the_library;
        return limit > header ? limit - header : 0;
    }

    /// What is on its way belongs to the library until the receiver has copied it. To wait for that at once would
    /// take as long as the receiver takes to get a core; at the end of the next exchange it has been copied, since
    /// the receiver has sent its part of that one. Only a message that needs an answer, or another machine, is
    /// waited for where it is sent.
    void finish_sending() {
        until([&] {
            int done = 0;
            MPI_Testall(static_cast<int>(requests_.size()), requests_.data(), &done,
                        MPI_STATUSES_IGNORE);
            return done != 0;
        });
    }

    std::vector<Bytes> transport(std::vector<Bytes> to, Content) override {
        std::vector<Bytes> from(count());
        std::vector<MPI_Request> sent;
        std::vector<int> awaited;
        std::size_t longest = 0;
        for (const Bytes& bytes : to) {  // all are sent, or none
            length(bytes.size());
            longest = std::max(longest, bytes.size());
        }
        for (std::size_t p = 0; p < count(); ++p) {
            if (p == own()) continue;
            awaited.push_back(static_cast<int>(p));
            MPI_Isend(to[p].data(), length(to[p].size()), MPI_BYTE, awaited.back(), 0,
                      MPI_COMM_WORLD, &sent.emplace_back());
            bells_->ring(awaited.back());
        }
        bells_->wait();
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
        from[own()] = std::move(to[own()]);
        finish_sending();
        sent_ = std::move(to);
        requests_ = std::move(sent);
        if (longest > answered_ || !bells_->reach_all()) {
            finish_sending();
            sent_.clear();
        }
        return from;
    }

    template <class Done>
    static void until(const Done& done) {
        constexpr int looks = 20;
        for (int look = 0; !done(); ++look)
            if (look > looks) std::this_thread::sleep_for(std::chrono::microseconds(1));
    }

    bool ours_;
    std::size_t answered_;
    std::unique_ptr<Bells> bells_;
    std::vector<Bytes> sent_;            ///< in the last exchange
    std::vector<MPI_Request> requests_;  ///< of these
};

}  // namespace

std::string why_one_process() { return {}; }

std::unique_ptr<Parts> join_processes() {
    int there = 0, provided = 0, count = 1, own = 0;
    MPI_Initialized(&there);  // by a package of Python, perhaps
    if (there == 0) MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_size(MPI_COMM_WORLD, &count);
    MPI_Comm_rank(MPI_COMM_WORLD, &own);
    return std::make_unique<MpiProcesses>(count, own, there == 0);
}

}  // namespace spam
