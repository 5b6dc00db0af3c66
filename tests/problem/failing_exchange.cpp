// SPDX-License-Identifier: GPL-3.0-or-later
// Linked into a problem, whose processes then exchange by way of this: before the exchange SPAM_FAIL_AT of process
// SPAM_FAIL_IN, counted from 1, there is an exception, as if the code since the one before had thrown it. The linker
// puts it in the place of join_processes() (--wrap).
#include <spam/processes/processes.hpp>

#include <cstdlib>
#include <memory>
#include <stdexcept>

namespace {

std::size_t setting(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? 0 : std::strtoul(value, nullptr, 10);
}

class FailingProcesses final : public spam::Parts {
  public:
    explicit FailingProcesses(std::unique_ptr<Parts> real)
        : Parts(real->count(), real->own()),
          real_(std::move(real)),
          place_(own() == setting("SPAM_FAIL_IN") ? setting("SPAM_FAIL_AT") : 0) {}

  private:
    std::vector<Bytes> transport(std::vector<Bytes> to, Content content) override {
        if (++exchanges_ == place_) throw std::runtime_error("thrown by a test");
        return real_->exchange(std::move(to), content);
    }
    std::unique_ptr<Parts> real_;
    std::size_t place_, exchanges_ = 0;
};

}  // namespace

// spam::join_processes() by its name in objects: the library's, and the one that is called in its place.
std::unique_ptr<spam::Parts> real_processes() __asm__("__real__ZN4spam14join_processesEv");
std::unique_ptr<spam::Parts> failing_processes() __asm__("__wrap__ZN4spam14join_processesEv");
std::unique_ptr<spam::Parts> failing_processes() {
    return std::make_unique<FailingProcesses>(real_processes());
}
