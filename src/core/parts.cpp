// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/parts.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace spam {
namespace {

class Alone final : public Parts {
  public:
    Alone() : Parts(1, 0) {}

  private:
    std::vector<Bytes> transport(std::vector<Bytes> to, Content) override { return to; }
};

thread_local Parts* parts_here = nullptr;

/// The last byte of every message, behind what its sender tells, says whether it goes on.
constexpr std::byte goes_on{0}, has_given_up{1}, has_left{2};

/// What a part that does not go on has told: at which of its calls, and why.
std::pair<std::uint64_t, std::string> told_by(const Parts::Bytes& bytes, std::size_t trailer) {
    std::uint64_t turn = 0;
    std::memcpy(&turn, bytes.data(), sizeof(turn));
    const auto* const words = reinterpret_cast<const char*>(bytes.data());
    return {turn, {words + sizeof(turn), bytes.size() - trailer - sizeof(turn)}};
}

}  // namespace

Parts& Parts::alone_here() {
    thread_local Alone alone;
    return alone;
}

Parts& Parts::here() { return parts_here != nullptr ? *parts_here : alone_here(); }

Parts::Here::Here(Parts& parts) : before_(std::exchange(parts_here, &parts)) {}
Parts::Here::~Here() { parts_here = before_; }

std::vector<Parts::Bytes> Parts::send(std::vector<Bytes> to, std::byte how, Content content) {
    for (Bytes& bytes : to) bytes.insert(bytes.end(), {tells_, how});
    std::vector<Bytes> from = transport(std::move(to), content);
    for (const Bytes& bytes : from) told_ = std::max(told_, bytes[bytes.size() - trailer]);
    return from;
}

std::vector<Parts::Bytes> Parts::exchange(std::vector<Bytes> to, Content content) {
    to.resize(count_);
    if (alone()) return to;
    if (left_) throw PartLeft(*left_);
    ++traffic_.exchanges;
    for (std::size_t p = 0; p < count_; ++p)
        if (p != own_) traffic_.bytes += to[p].size() + trailer;
    const auto begin = std::chrono::steady_clock::now();
    std::vector<Bytes> from = send(std::move(to), goes_on, content);
    traffic_.seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    for (const std::byte how : {has_left, has_given_up})
        for (const Bytes& bytes : from) {
            if (bytes.back() != how) continue;
            const auto [turn, why] = told_by(bytes, trailer);
            if (how == has_left) throw PartLeft(*(left_ = why));
            throw PartGaveUp(why, turn);
        }
    for (Bytes& bytes : from) bytes.resize(bytes.size() - trailer);
    return from;
}

void Parts::end(std::byte how, std::uint64_t turn, const std::string& reason) {
    if (alone() || left_) return;
    if (how == has_left) left_ = reason;
    Bytes bytes = bytes_of(std::span<const std::uint64_t>(&turn, 1));
    const Bytes words = bytes_of(std::span<const char>(reason));
    bytes.insert(bytes.end(), words.begin(), words.end());
    // Another one may leave at the same exchange, and makes no further one.
    for (const Bytes& from : send(std::vector<Bytes>(count_, bytes), how, Content::others))
        if (from.back() == has_left && !left_) left_ = told_by(from, trailer).second;
}

void Parts::give_up(const std::string& reason, std::uint64_t turn) {
    end(has_given_up, turn, reason);
}
void Parts::leave(const std::string& reason) { end(has_left, 0, reason); }

std::string Parts::first_of(const std::string& own) {
    if (alone()) return own;
    for (const auto& of_part : gather(std::span<const char>(own)))
        if (!of_part.empty()) return {of_part.begin(), of_part.end()};
    return {};
}

double Parts::most(double own) {
    if (alone()) return own;
    double most = own;
    for (const auto& of_part : gather(std::span<const double>(&own, 1)))  // NaN stays, in all parts
        if (!(of_part.front() <= most) && !std::isnan(most)) most = of_part.front();
    return most;
}

std::size_t Parts::total(std::size_t own) {
    if (alone()) return own;
    std::size_t sum = 0;
    for (const auto& of_part : gather(std::span<const std::size_t>(&own, 1)))
        sum += of_part.front();
    return sum;
}

}  // namespace spam
