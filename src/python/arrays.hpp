// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>

#include <pybind11/numpy.h>

#include <span>
#include <string>
#include <vector>

/// Arrays on their way between numpy and the library. What comes in is checked and copied where it must outlive
/// the call; what goes out is a view that keeps its owner, or an array of its own.
namespace spam::python {

namespace py = pybind11;

/// Doubles in C order; whole numbers become doubles, anything else is refused by doubles_of().
using Doubles = py::array_t<double, py::array::c_style>;

/// Any array-like of real numbers as finite doubles. Throws InputError: "<name>: ..." with what was given.
Doubles doubles_of(const py::handle& given, const std::string& name);

/// The shape as Python writes it: "(7, 2)".
std::string shape_of(const py::array& array);

/// Throws InputError unless the shape is this one; -1 stands for any number, shown as `n` in the message.
void expect_shape(const py::array& array, const std::vector<py::ssize_t>& shape,
                  const std::string& name);

/// (N, Dim) as Dim x N. Throws InputError.
template <int Dim>
Points<Dim> points_of(const py::handle& given, const std::string& name);

/// (N, Dim) of Dim x N, an array of its own.
template <int Dim>
Doubles array_of(const Points<Dim>& points);

/// (n) numbers, an array of its own.
Doubles array_of(std::span<const double> numbers);

/// The number of columns of an (N, 1 to 3) array. Throws InputError.
int dimensions_of(const Doubles& positions, const std::string& name);

/// A view of numbers that `owner` keeps: (n, components), or (n) where there is one. Read only unless `writable`.
py::array view_of(const double* data, std::size_t n, std::size_t components, bool scalar,
                  const py::object& owner, bool writable = false);

}  // namespace spam::python
