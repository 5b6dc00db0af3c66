// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/processes/processes.hpp>

#include <mpi.h>

#include <array>
#include <cstdlib>
#include <cstring>

namespace spam {
namespace {

/// An exchange is one MPI_Alltoall of slots: the length of a message, and the message itself where it fits, as those of
/// sums and votes do. Longer ones follow by themselves, between those alone that have something to say.
class MpiProcesses final : public Parts {
  public:
    MpiProcesses(int count, int own)
        : Parts(static_cast<std::size_t>(count), static_cast<std::size_t>(own)),
          to_(this->count()),
          from_(this->count()) {}
    ~MpiProcesses() override { MPI_Finalize(); }
    MpiProcesses(const MpiProcesses&) = delete;
    MpiProcesses& operator=(const MpiProcesses&) = delete;

  private:
    struct Slot {
        std::uint64_t size;
        std::array<std::byte, 248> bytes;
    };
    static_assert(sizeof(Slot) == 256);
    /// What one MPI_Send takes: counts are int.
    static constexpr std::size_t most = std::size_t{1} << 30;

    std::vector<Bytes> transport(std::vector<Bytes> to, Content) override {
        for (std::size_t p = 0; p < count(); ++p) {
            to_[p].size = to[p].size();
            if (to[p].size() <= sizeof to_[p].bytes)
                std::memcpy(to_[p].bytes.data(), to[p].data(), to[p].size());
        }
        MPI_Alltoall(to_.data(), sizeof(Slot), MPI_BYTE, from_.data(), sizeof(Slot), MPI_BYTE,
                     MPI_COMM_WORLD);
        std::vector<Bytes> from(count());
        requests_.clear();
        for (std::size_t p = 0; p < count(); ++p) {
            from[p].resize(from_[p].size);
            if (p == own())
                from[p] = to[p];
            else if (from_[p].size <= sizeof from_[p].bytes)
                std::memcpy(from[p].data(), from_[p].bytes.data(), from_[p].size);
            else
                for_each_piece(from[p], [&](std::byte* piece, int size) {
                    MPI_Irecv(piece, size, MPI_BYTE, static_cast<int>(p), 0, MPI_COMM_WORLD,
                              next());
                });
        }
        for (std::size_t p = 0; p < count(); ++p)
            if (p != own() && to[p].size() > sizeof to_[p].bytes)
                for_each_piece(to[p], [&](std::byte* piece, int size) {
                    MPI_Isend(piece, size, MPI_BYTE, static_cast<int>(p), 0, MPI_COMM_WORLD,
                              next());
                });
        MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
        return from;
    }
    template <class Do>
    static void for_each_piece(Bytes& bytes, const Do& piece) {
        for (std::size_t at = 0; at < bytes.size(); at += most)
            piece(bytes.data() + at, static_cast<int>(std::min(most, bytes.size() - at)));
    }
    MPI_Request* next() { return &requests_.emplace_back(); }

    std::vector<Slot> to_, from_;
    std::vector<MPI_Request> requests_;
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
