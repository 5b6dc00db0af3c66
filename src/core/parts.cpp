// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/parts.hpp>

#include <algorithm>
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
constexpr std::byte goes_on{0}, has_given_up{1};

}  // namespace

Parts& Parts::here() {
    thread_local Alone alone;
    return parts_here != nullptr ? *parts_here : alone;
}

Parts::Here::Here(Parts& parts) : before_(std::exchange(parts_here, &parts)) {}
Parts::Here::~Here() { parts_here = before_; }

std::vector<Parts::Bytes> Parts::exchange(std::vector<Bytes> to, Content content) {
    to.resize(count_);
    if (alone()) return to;
    for (Bytes& bytes : to) bytes.insert(bytes.begin(), goes_on);
    std::vector<Bytes> from = transport(std::move(to), content);
    for (const Bytes& bytes : from)
        if (bytes.front() == has_given_up)
            throw PartGaveUp(
                std::string(reinterpret_cast<const char*>(bytes.data()) + 1, bytes.size() - 1));
    for (Bytes& bytes : from) bytes.erase(bytes.begin());
    return from;
}

void Parts::give_up(const std::string& reason) {
    if (alone()) return;
    Bytes bytes = bytes_of(std::span<const char>(reason));
    bytes.insert(bytes.begin(), has_given_up);
    transport(std::vector<Bytes>(count_, bytes), Content::others);
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
