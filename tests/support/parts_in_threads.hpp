// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of a run in one process: a thread each, and messages through memory.
#pragma once

#include <spam/core/exact_sum.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/parts.hpp>

#include <atomic>
#include <barrier>
#include <exception>
#include <functional>
#include <map>
#include <thread>

namespace spam::test {

/// What is done wrongly.
enum class Wrong {
    nothing,
    images,  ///< are not refreshed: the last ones are given again
    sums,    ///< of parts are rounded before they are added
};

class PartsInThreads {
    using Bytes = Parts::Bytes;

  public:
    /// work() in each of `count` threads, whose Parts::here() these parts are. Throws what the first of them throws.
    static void run(std::size_t count, const std::function<void()>& work,
                    Wrong wrong = Wrong::nothing) {
        PartsInThreads all(count);
        std::vector<std::exception_ptr> thrown(count);
        std::vector<std::thread> threads;
        for (std::size_t p = 0; p < count; ++p)
            threads.emplace_back([&, p] {
                set_threads(1);
                Part part(all, p, wrong);
                const Parts::Here here(part);
                try {
                    work();
                } catch (const PartGaveUp&) {  // what the other one has thrown tells more
                } catch (...) {
                    thrown[p] = std::current_exception();
                    part.give_up("thrown in part " + std::to_string(p));
                }
                all.barrier_.arrive_and_drop();
            });
        for (auto& thread : threads) thread.join();
        for (const auto& exception : thrown)
            if (exception) std::rethrow_exception(exception);
    }

  private:
    explicit PartsInThreads(std::size_t count)
        : barrier_(static_cast<std::ptrdiff_t>(count)),
          message_(count, std::vector<Bytes>(count)) {}

    class Part final : public Parts {
      public:
        Part(PartsInThreads& all, std::size_t own, Wrong wrong)
            : Parts(all.message_.size(), own),
              all_(all),
              wrong_(wrong) {}

      private:
        std::vector<Bytes> transport(std::vector<Bytes> to, Content content) override {
            if (wrong_ == Wrong::images && content == Content::images) {
                before_.resize(count());
                for (std::size_t p = 0; p < count(); ++p) {
                    // As long as the last ones of the same kind, where no list has been built since.
                    Bytes& before = before_[p][to[p].size()];
                    const Bytes now = to[p];
                    if (!before.empty()) to[p] = before;
                    before = now;
                }
            }
            for (std::size_t p = 0; p < count(); ++p) {
                if (wrong_ == Wrong::sums && content == Content::sums) round(to[p]);
                all_.message_[own()][p] = std::move(to[p]);
            }
            all_.barrier_.arrive_and_wait();
            std::vector<Bytes> from(count());
            for (std::size_t p = 0; p < count(); ++p) from[p] = std::move(all_.message_[p][own()]);
            all_.barrier_.arrive_and_wait();
            return from;
        }
        static void round(Bytes& message) {
            const Bytes sums(message.begin() + 1, message.end());
            auto values = values_of<ExactSum>(sums);
            for (ExactSum& sum : values) {
                const double rounded = sum;
                sum = {};
                sum += rounded;
            }
            const Bytes bytes = bytes_of(std::span<const ExactSum>(values));
            std::copy(bytes.begin(), bytes.end(), message.begin() + 1);
        }

        PartsInThreads& all_;
        Wrong wrong_;
        std::vector<std::map<std::size_t, Bytes>> before_;  ///< by size
    };

    std::barrier<> barrier_;
    std::vector<std::vector<Bytes>> message_;  ///< [from][to]
};

}  // namespace spam::test
