// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace spam {

/// What a run must remember to go on later, as bytes: written and read by the same code, so that both
/// agree. What takes part has a member `void remember(Archive& archive)` that calls
///     archive(first, second, ...);
/// with numbers, enumerations, strings, vectors, arrays, pairs, optionals, plain Eigen matrices or
/// others that remember. Bytes are those of this machine; a checkpoint names its version.
class Archive {
  public:
    Archive() = default;  ///< writes
    /// Reads; `bytes` must outlive it.
    explicit Archive(std::span<const std::byte> bytes) : source_(bytes), reading_(true) {}

    bool reading() const { return reading_; }

    /// Writes the values, or replaces them by those read. Throws InputError where the bytes end early
    /// or are not what was written.
    template <class... Values>
    void operator()(Values&... values) {
        (pass(values), ...);
    }

    const std::vector<std::byte>& bytes() const { return written_; }
    /// What was written, handed over: there may be a kilobyte for every particle.
    std::vector<std::byte> take() { return std::exchange(written_, {}); }
    /// Throws InputError where bytes are left over after reading.
    void expect_end() const;

  private:
    void raw(void* value, std::size_t size);
    /// Number of elements, read ones no more than the bytes left can hold.
    std::size_t count(std::size_t size, std::size_t bytes_each);

    template <class T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T>
    void pass(T& value) { raw(&value, sizeof value); }
    void pass(std::string& text) {
        text.resize(count(text.size(), 1));
        raw(text.data(), text.size());
    }
    template <class T>
    void pass(std::vector<T>& values) {
        constexpr bool plain = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;
        values.resize(count(values.size(), plain ? sizeof(T) : 1));
        if constexpr (plain)
            raw(values.data(), values.size() * sizeof(T));
        else
            for (T& value : values) pass(value);
    }
    template <class T, std::size_t N>
    void pass(std::array<T, N>& values) {
        for (T& value : values) pass(value);
    }
    template <class A, class B>
    void pass(std::pair<A, B>& both) {
        pass(both.first);
        pass(both.second);
    }
    template <class T>
    void pass(std::optional<T>& value) {
        bool has = value.has_value();
        pass(has);
        if (!has) return value.reset();
        if (!value) value.emplace();
        pass(*value);
    }
    template <int Rows, int Columns>
    void pass(Eigen::Matrix<double, Rows, Columns>& values) {
        const std::size_t rows = count(static_cast<std::size_t>(values.rows()), 0);
        const std::size_t columns = count(static_cast<std::size_t>(values.cols()), sizeof(double));
        shape(rows, columns, Rows, Columns);
        values.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
        raw(values.data(), rows * columns * sizeof(double));
    }
    template <class T>
    requires requires(T& value, Archive& archive) { value.remember(archive); }
    void pass(T& value) { value.remember(*this); }
    /// Throws InputError where a matrix of that size is not one of the type (-1: any).
    void shape(std::size_t rows, std::size_t columns, int fixed_rows, int fixed_columns) const;

    std::vector<std::byte> written_;
    std::span<const std::byte> source_;
    std::size_t at_ = 0;
    bool reading_ = false;
};

}  // namespace spam
