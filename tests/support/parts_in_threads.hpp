// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of a run in one process: a thread each, and messages through memory.
#pragma once

#include <spam/core/exact_sum.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/parts.hpp>

#include <atomic>
#include <barrier>
#include <cstring>
#include <exception>
#include <functional>
#include <map>
#include <stdexcept>
#include <thread>

namespace spam::test {

/// What is done wrongly.
enum class Wrong {
    nothing,
    images,  ///< are not refreshed: the last ones are given again
    sums,    ///< of parts are rounded before they are added
    order,   ///< images of other parts are entered last
    calls,   ///< one part leaves out an exchange, as where it returns a reason before it
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
          message_(count, std::vector<Bytes>(count)),
          content_(count) {}

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
            if (wrong_ == Wrong::calls && own() == 1 && content == Content::images &&
                ++images_ == 20)
                return std::vector<Bytes>(count(), Bytes(trailer));
            for (std::size_t p = 0; p < count(); ++p) {
                if (wrong_ == Wrong::sums && content == Content::sums) round(to[p]);
                if (wrong_ == Wrong::order && content == Content::others) enter_last(to[p]);
                all_.message_[own()][p] = std::move(to[p]);
            }
            all_.content_[own()] = content;
            all_.barrier_.arrive_and_wait();
            std::vector<Bytes> from(count());
            bool all_go_on = true, same = true, all_there = true;
            for (std::size_t p = 0; p < count(); ++p) {
                from[p] = std::move(all_.message_[p][own()]);
                all_there = all_there && !from[p].empty();
                all_go_on = all_go_on && all_there && from[p].back() == std::byte{0};
                same = same && all_.content_[p] == content;
            }
            all_.barrier_.arrive_and_wait();
            // A part that gives up says so whatever the others are at.
            if (!all_there || (all_go_on && !same))
                throw std::logic_error("parts are not at the same exchange");
            return from;
        }
        /// Where these are places of images (ghosts.cpp): of 2 + Dim words, the second half of the second one 0.
        static void enter_last(Bytes& message) {
            for (const std::size_t size : {32U, 40U}) {
                bool places = message.size() > trailer && (message.size() - trailer) % size == 0;
                const auto word = [&](std::size_t at) {
                    std::uint32_t value = 0;
                    std::memcpy(&value, message.data() + at, sizeof value);
                    return value;
                };
                for (std::size_t k = 0; places && k + trailer < message.size(); k += size)
                    places = word(k + 12) == 0 && word(k) < 10000 && word(k + 4) < 10000;
                for (std::size_t k = 0; places && k + trailer < message.size(); k += size) {
                    const std::uint32_t last = word(k + 4) + 10000;
                    std::memcpy(message.data() + k + 4, &last, sizeof last);
                }
            }
        }
        static void round(Bytes& message) {
            const Bytes sums(message.begin(), message.end() - std::ptrdiff_t{trailer});
            auto values = values_of<ExactSum>(sums);
            for (ExactSum& sum : values) {
                const double rounded = sum;
                sum = {};
                sum += rounded;
            }
            const Bytes bytes = bytes_of(std::span<const ExactSum>(values));
            std::copy(bytes.begin(), bytes.end(), message.begin());
        }

        PartsInThreads& all_;
        Wrong wrong_;
        int images_ = 0;
        std::vector<std::map<std::size_t, Bytes>> before_;  ///< by size
    };

    std::barrier<> barrier_;
    std::vector<std::vector<Bytes>> message_;  ///< [from][to]
    std::vector<Parts::Content> content_;      ///< of what each is at
};

}  // namespace spam::test
