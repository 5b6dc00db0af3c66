// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace spam {

/// Some part cannot go on (Parts::give_up): thrown in all others, with its reason.
struct PartGaveUp : std::runtime_error {
    PartGaveUp(const std::string& reason, std::uint64_t of_turn)
        : std::runtime_error(reason),
          turn(of_turn) {}
    std::uint64_t turn;  ///< as that part has said
};

/// Some part makes no more calls at all (Parts::leave): thrown in all others. Their runs end as well.
struct PartLeft : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The parts into which the particles of one run are cut. Each is a model of its own particles, in a thread or a
/// process of its own, which makes the same calls in the same order as the others. Sums over particles (exact_sum.hpp),
/// decisions that all must share, and the neighbours that belong to other parts (neighbors/ghosts.hpp) are found by
/// exchanges; laws have a line for it only where they find a count or a largest value of their own particles. Nothing
/// of what a part finds depends on how particles are parted, to the last bit (tests/rhs/parts.cpp).
///
/// exchange() and what is made of it (agree, any, most, total, gather) are calls that all parts must make together.
class Parts {
  public:
    /// Those that this thread works for: one that is alone and exchanges nothing, unless there is a Here.
    static Parts& here();
    /// One that is alone, whatever here() is: for what is looked at as a whole.
    static Parts& alone_here();
    /// Makes parts those of this thread, as long as it lives.
    class Here {
      public:
        explicit Here(Parts& parts);
        ~Here();
        Here(const Here&) = delete;
        Here& operator=(const Here&) = delete;

      private:
        Parts* before_;
    };

    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;
    virtual ~Parts() = default;

    std::size_t count() const { return count_; }
    std::size_t own() const { return own_; }
    bool alone() const { return count_ == 1; }

    /// Which particles of the whole run this part's are, ascending. Where it is alone these are 0, 1, ... and the
    /// list is empty.
    std::span<const std::uint32_t> numbers() const { return numbers_; }
    void set_numbers(std::vector<std::uint32_t> numbers) {
        numbers_ = std::move(numbers);
        elements_.clear();
    }
    std::uint32_t number(std::size_t i) const {
        return numbers_.empty() ? static_cast<std::uint32_t>(i) : numbers_[first_ + i];
    }
    /// Likewise which elements between particles are this part's; empty where there are none. Laws that have some tell.
    std::span<const std::uint32_t> elements() const { return elements_; }
    void set_elements(std::vector<std::uint32_t> elements) { elements_ = std::move(elements); }
    /// As long as it lives number(i) is that of this part's particle first + i: for laws among some of them.
    class Among {
      public:
        Among(Parts& parts, std::size_t first)
            : parts_(parts),
              before_(std::exchange(parts.first_, first)) {}
        ~Among() { parts_.first_ = before_; }
        Among(const Among&) = delete;
        Among& operator=(const Among&) = delete;

      private:
        Parts& parts_;
        std::size_t before_;
    };
    /// How many entries at the end of y every part has a copy of (accounts of the whole run).
    std::size_t copies = 0;

    using Bytes = std::vector<std::byte>;
    /// What is exchanged.
    enum class Content { sums, images, others };
    /// Gives to[p] to part p; what part p has given to this one is then in [p]. Throws PartGaveUp, PartLeft.
    std::vector<Bytes> exchange(std::vector<Bytes> to, Content content = Content::others);
    /// What this part has sent so far, and how long exchanges took it.
    struct Traffic {
        std::size_t exchanges = 0, bytes = 0;
        double seconds = 0.0;
    };
    const Traffic& traffic() const { return traffic_; }
    /// For this part alone: it makes no more of the calls that others are at, which end there with this reason. `turn`
    /// says at which of its calls, where the others may be at the next one already.
    void give_up(const std::string& reason, std::uint64_t turn = 0);
    /// The same for good: its last call.
    void leave(const std::string& reason);
    /// Waits for the others, so that what has been found counts only where none has given up.
    void agree() {
        if (!alone()) exchange({});
    }
    /// As long as it lives models' rates do not agree: a caller of them makes another exchange in any case, before
    /// anything of theirs counts, gives up itself where they have a failure(), and takes PartGaveUp for another part's.
    class AgreesLater {
      public:
        explicit AgreesLater(Parts& parts)
            : parts_(parts),
              before_(std::exchange(parts.later_, true)) {}
        ~AgreesLater() { parts_.later_ = before_; }
        AgreesLater(const AgreesLater&) = delete;
        AgreesLater& operator=(const AgreesLater&) = delete;

      private:
        Parts& parts_;
        bool before_;
    };
    bool agrees_later() const { return later_; }
    /// A small number that goes with this part's messages from now on, and the largest that any part has sent so far:
    /// in all parts the same, without an exchange for it (a signal).
    void tell(unsigned char own) { tells_ = std::byte{own}; }
    unsigned char told() const { return std::to_integer<unsigned char>(told_); }

    /// Whether it is so in any part.
    bool any(bool own) { return alone() ? own : most(own ? 1.0 : 0.0) > 0.0; }
    /// The largest.
    double most(double own);
    /// The sum.
    std::size_t total(std::size_t own);
    /// Of the first part that has one; empty where none has.
    std::string first_of(const std::string& own);

    /// The same values for all parts; what each has given, in the order of the parts.
    template <class Value>
    std::vector<std::vector<Value>> gather(std::span<const Value> own,
                                           Content content = Content::others) {
        static_assert(std::is_trivially_copyable_v<Value>);
        std::vector<std::vector<Value>> all;
        for (const Bytes& bytes : exchange(std::vector<Bytes>(count_, bytes_of(own)), content))
            all.push_back(values_of<Value>(bytes));
        return all;
    }

    /// `components` values of each of our particles, put in order with those of the others: of all, by number.
    template <class Value>
    std::vector<Value> by_number(std::span<const Value> own, std::size_t components = 1) {
        return by_number(own, components, numbers_);
    }
    /// The same of what else has numbers 0, 1, ... in the whole run.
    template <class Value>
    std::vector<Value> by_number(std::span<const Value> own, std::size_t components,
                                 std::span<const std::uint32_t> numbers) {
        if (alone()) return {own.begin(), own.end()};
        const auto theirs = gather(numbers);
        const auto values = gather(own);
        std::size_t n = 0;
        for (const auto& one : theirs) n += one.size();
        std::vector<Value> all(n * components);
        for (std::size_t p = 0; p < count_; ++p)
            for (std::size_t k = 0; k < theirs[p].size(); ++k)
                std::copy_n(values[p].begin() + static_cast<std::ptrdiff_t>(k * components),
                            components,
                            all.begin() + static_cast<std::ptrdiff_t>(theirs[p][k] * components));
        return all;
    }
    /// The other way round.
    template <class Value>
    std::vector<Value> own_of(std::span<const Value> all, std::size_t components,
                              std::span<const std::uint32_t> numbers) const {
        if (alone()) return {all.begin(), all.end()};
        std::vector<Value> own;
        own.reserve(numbers.size() * components);
        for (const std::uint32_t i : numbers)
            for (std::size_t c = 0; c < components; ++c) own.push_back(all[i * components + c]);
        return own;
    }

    /// So many bytes, to which exchange() adds its own without another copy.
    static Bytes room_for(std::size_t size) {
        Bytes bytes(size + trailer);
        bytes.resize(size);
        return bytes;
    }
    template <class Value>
    static Bytes bytes_of(std::span<const Value> values) {
        Bytes bytes = room_for(values.size_bytes());
        if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
        return bytes;
    }
    template <class Value>
    static std::vector<Value> values_of(const Bytes& bytes) {
        std::vector<Value> values(bytes.size() / sizeof(Value));
        if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }

  protected:
    Parts(std::size_t count, std::size_t own) : count_(count), own_(own) {}
    /// Bytes behind what transport() brings: what the sender tells, and last whether it goes on (0).
    static constexpr std::size_t trailer = 2;

  private:
    void end(std::byte how, std::uint64_t turn, const std::string& reason);
    std::vector<Bytes> send(std::vector<Bytes> to, std::byte how, Content content);
    /// exchange() of bytes as they are; never called where a part is alone.
    virtual std::vector<Bytes> transport(std::vector<Bytes> to, Content content) = 0;

    std::size_t count_, own_;
    std::vector<std::uint32_t> numbers_, elements_;
    std::size_t first_ = 0;  ///< Among
    bool later_ = false;     ///< AgreesLater
    std::byte tells_{0}, told_{0};
    Traffic traffic_;
    std::optional<std::string> left_;  ///< why there are no more calls
};

}  // namespace spam
