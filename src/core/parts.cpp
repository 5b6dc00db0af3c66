// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/parts.hpp>

#include <algorithm>
#include <chrono>
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

/// The first byte of every message says whether its sender goes on.
constexpr std::byte goes_on{0}, has_given_up{1}, has_left{2};

}  // namespace

Parts& Parts::alone_here() {
    thread_local Alone alone;
    return alone;
}

Parts& Parts::here() { return parts_here != nullptr ? *parts_here : alone_here(); }

Parts::Here::Here(Parts& parts) : before_(std::exchange(parts_here, &parts)) {}
Parts::Here::~Here() { parts_here = before_; }

std::vector<Parts::Bytes> Parts::exchange(std::vector<Bytes> to, Content content) {
    to.resize(count_);
    if (alone()) return to;
    if (left_) throw PartLeft(*left_);
    for (Bytes& bytes : to) bytes.insert(bytes.begin(), goes_on);
    ++traffic_.exchanges;
    for (std::size_t p = 0; p < count_; ++p)
        if (p != own_) traffic_.bytes += to[p].size();
    const auto begin = std::chrono::steady_clock::now();
    std::vector<Bytes> from = transport(std::move(to), content);
    traffic_.seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    for (const std::byte how : {has_left, has_given_up})
        for (const Bytes& bytes : from) {
            if (bytes.front() != how) continue;
            const std::string why(reinterpret_cast<const char*>(bytes.data()) + 1,
                                  bytes.size() - 1);
            if (how == has_left) throw PartLeft(*(left_ = why));
            throw PartGaveUp(why);
        }
    for (Bytes& bytes : from) bytes.erase(bytes.begin());
    return from;
}

void Parts::end(std::byte how, const std::string& reason) {
    if (alone() || left_) return;
    if (how == has_left) left_ = reason;
    Bytes bytes = bytes_of(std::span<const char>(reason));
    bytes.insert(bytes.begin(), how);
    transport(std::vector<Bytes>(count_, bytes), Content::others);
}

void Parts::give_up(const std::string& reason) { end(has_given_up, reason); }
void Parts::leave(const std::string& reason) { end(has_left, reason); }

std::string Parts::first_of(const std::string& own) {
    if (alone()) return own;
    for (const auto& of_part : gather(std::span<const char>(own)))
        if (!of_part.empty()) return {of_part.begin(), of_part.end()};
    return {};
}

double Parts::most(double own) {
    if (alone()) return own;
    double most = own;
    for (const auto& of_part : gather(std::span<const double>(&own, 1)))
        most = std::max(most, of_part.front());
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
