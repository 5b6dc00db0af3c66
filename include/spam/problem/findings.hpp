// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/problem/session.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace spam {

/// What was found, for result.json: the measurements and checks of a session whose names begin alike. Of a problem
/// with several cases there is one for each.
class Findings {
  public:
    /// `prefix`: what every name begins with. The session must outlive it.
    explicit Findings(Session& session, std::string prefix = "")
        : session_(session),
          prefix_(std::move(prefix)) {}

    /// Session::measure().
    void measure(const std::string& name, double value, std::string source = "measured") const {
        session_.measure(prefix_ + name, value, std::move(source));
    }
    /// The last values of these columns.
    void measure_last(const History& h, const std::vector<std::string>& columns,
                      const std::string& source = "measured") const {
        for (const auto& name : columns) measure(name, h.last(name), source);
    }
    /// |value - expected| <= tolerance must hold, where something is expected.
    void check(const std::string& name, double value, std::optional<double> expected,
               double tolerance, std::string source) const {
        session_.check({prefix_ + name, value, expected, tolerance, std::move(source)});
    }
    /// The same where `known`, else only measured.
    void claim(const std::string& name, double value, double expected, double tolerance,
               std::string source, bool known) const {
        session_.claim({prefix_ + name, value, expected, tolerance, std::move(source)}, known);
    }
    /// Session::check_promises().
    void check_promises(const RunRecord& run) const { session_.check_promises(run, prefix_); }

    /// Orders of convergence between sizes, each twice the one before it: order_A_to_B, the A and B their labels.
    /// `error`: as many as labels, or fewer where runs were stopped.
    void measure_orders(const std::vector<std::string>& labels, const std::vector<double>& error,
                        const std::string& source, const std::string& name = "order") const;

  private:
    Session& session_;
    std::string prefix_;
};

}  // namespace spam
