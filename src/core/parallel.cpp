// SPDX-License-Identifier: GPL-3.0-or-later
// A team of threads that waits shortly and then sleeps. Those of OpenMP spin for milliseconds, in which a core that
// another program needs as well does nothing: there two threads took more than twice as long as one.
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/threads.hpp>

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

namespace spam {
namespace {

/// Ranges in the share of a thread: so many are left to others where it is late.
constexpr std::size_t ranges_each = 4;

/// Looks, a pause each, before a thread sleeps: 14 microseconds on an EPYC. With fewer, loops that follow each other
/// wait until threads are awake; with more, other programs wait for the core.
constexpr int looks = 500;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    asm volatile("yield");
#endif
}

/// Until it is no longer `old`: what it is then.
std::uint32_t changed(const std::atomic<std::uint32_t>& value, std::uint32_t old) {
    for (int look = 0; look < looks; ++look) {
        if (const auto now = value.load(); now != old) return now;
        pause();
    }
    value.wait(old);
    return value.load();
}

class Team {
  public:
    /// Of this process: after a fork a new one, because threads stay in the parent.
    static Team& here() {
        static const int followed = [] {
            team_ = new Team;
            return pthread_atfork(nullptr, nullptr, [] { team_ = new Team; });
        }();
        static_cast<void>(followed);
        return *team_;
    }

    /// Has so many threads besides the one that calls it, if it can: else why not.
    std::string grow(std::size_t others) {
        if (busy_.test_and_set()) return {};
        std::string reason;
        try {
            make_room(others);
        } catch (const std::exception& error) {
            reason = fmt::format("only {} ({})", threads_ + 1, error.what());
        }
        busy_.clear();
        return reason;
    }

    /// False where it works on another loop already.
    bool share(std::size_t n, const SharedLoop& loop, std::size_t threads) {
        if (busy_.test_and_set(std::memory_order_acquire)) return false;
        try {
            make_room(threads - 1);
        } catch (const std::exception&) {  // fewer do it as well
        }
        if (threads_ == 0) {
            busy_.clear();
            return false;
        }
        n_ = n;
        shares_ = std::min(threads, threads_ + 1);
        ranges_ = std::min(n, ranges_each * shares_);
        for (std::size_t k = 0; k < shares_; ++k) {
            share_[k].next = k * ranges_ / shares_;
            share_[k].end = (k + 1) * ranges_ / shares_;
        }
        // Threads say that they are inside before they look for the loop: either they find none when it has ended, or
        // this one finds them inside.
        loop_ = &loop;
        ++begun_;
        begun_.notify_all();
        take(0, loop);
        loop_ = nullptr;
        for (std::uint32_t inside = inside_; inside != 0;) inside = changed(inside_, inside);
        const std::exception_ptr thrown = std::exchange(thrown_, nullptr);
        failed_.clear();
        busy_.clear(std::memory_order_release);
        if (thrown) std::rethrow_exception(thrown);
        return true;
    }

  private:
    /// On a cache line of its own, which its thread alone writes most of the time.
    struct alignas(64) Share {
        std::atomic<std::size_t> next = 0;
        std::size_t end = 0;
    };

    /// Not within a loop. Throws std::system_error where the system gives no more threads: what it has given stays.
    void make_room(std::size_t others) {
        if (others <= threads_) return;
        share_ = std::make_unique<Share[]>(others + 1);
        for (; threads_ < others; ++threads_)
            std::thread([this, own = threads_ + 1, begun = begun_.load()] {
                work(own, begun);
            }).detach();
    }

    [[noreturn]] void work(std::size_t own, std::uint32_t begun) {
        for (;;) {
            begun = changed(begun_, begun);
            ++inside_;
            if (const SharedLoop* loop = loop_; loop != nullptr && own < shares_) take(own, *loop);
            if (--inside_ == 0) inside_.notify_one();
        }
    }

    void take(std::size_t own, const SharedLoop& loop) {
        for (std::size_t k = 0; k < shares_; ++k) {
            Share& share = share_[(own + k) % shares_];
            for (std::size_t r;
                 (r = share.next.fetch_add(1, std::memory_order_relaxed)) < share.end;)
                try {
                    loop.run(r * n_ / ranges_, (r + 1) * n_ / ranges_);
                } catch (...) {
                    if (!failed_.test_and_set()) thrown_ = std::current_exception();
                }
        }
    }

    static Team* team_;  ///< never destroyed: its threads wait in it until the process ends

    std::atomic_flag busy_;
    std::atomic<const SharedLoop*> loop_ = nullptr;
    std::atomic<std::uint32_t> begun_ = 0;   ///< loops
    std::atomic<std::uint32_t> inside_ = 0;  ///< threads that may look at the loop
    std::size_t n_ = 0, ranges_ = 0, shares_ = 0;
    std::unique_ptr<Share[]> share_;
    std::size_t threads_ = 0;  ///< besides those that call
    std::atomic_flag failed_;
    std::exception_ptr thrown_;
};

Team* Team::team_ = nullptr;

thread_local int asked_threads = 0;

int threads_here() {
    static const int usable = usable_cores();
    return asked_threads > 0 ? asked_threads : usable;
}

}  // namespace

void share(std::size_t n, const SharedLoop& loop) {
    const int threads = threads_here();
    if (threads == 1 || n < 2 || !Team::here().share(n, loop, static_cast<std::size_t>(threads)))
        loop.run(0, n);
}

int set_threads(int threads) {
    if (threads > 0) asked_threads = threads;
    return threads_here();
}

void start_threads(int threads) {
    set_threads(threads);
    const std::string why_not = Team::here().grow(static_cast<std::size_t>(threads - 1));
    if (why_not.empty()) return;
    throw InputError(fmt::format(
        "threads: {} cannot be started, {}; give fewer, or raise the limits on processes and "
        "memory (ulimit -u, -v)",
        threads, why_not));
}

}  // namespace spam
