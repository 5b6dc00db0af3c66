// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.hpp"

#include <spam/core/error.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace spam::python {
namespace {

std::string shape_words(const std::vector<py::ssize_t>& shape) {
    std::string words = "(";
    for (std::size_t k = 0; k < shape.size(); ++k)
        words += (k > 0 ? ", " : "") + (shape[k] < 0 ? "n" : std::to_string(shape[k]));
    return words + (shape.size() == 1 ? ",)" : ")");
}

}  // namespace

std::string shape_of(const py::array& array) {
    return shape_words({array.shape(), array.shape() + array.ndim()});
}

Doubles doubles_of(const py::handle& given, const std::string& name) {
    const py::array any = py::array::ensure(given);
    if (!any) {
        PyErr_Clear();
        throw InputError(fmt::format("{}: is no array of numbers", name));
    }
    const char kind = any.dtype().kind();
    if (kind != 'f' && kind != 'i' && kind != 'u')
        throw InputError(fmt::format("{}: its numbers are {}; use real numbers (float64)", name,
                                     std::string(py::str(any.dtype()))));
    auto result = Doubles::ensure(any);
    if (!result) throw py::error_already_set();
    const double* const data = result.data();
    const auto bad =
        std::find_if(data, data + result.size(), [](double x) { return !std::isfinite(x); });
    if (bad != data + result.size())
        throw InputError(
            fmt::format("{}: entry {} is {}; all must be finite", name, bad - data, *bad));
    return result;
}

void expect_shape(const py::array& array, const std::vector<py::ssize_t>& shape,
                  const std::string& name) {
    bool same = array.ndim() == static_cast<py::ssize_t>(shape.size());
    for (std::size_t k = 0; same && k < shape.size(); ++k)
        same = shape[k] < 0 || array.shape(static_cast<py::ssize_t>(k)) == shape[k];
    if (!same)
        throw InputError(fmt::format("{}: has the shape {}, and should have {}", name,
                                     shape_of(array), shape_words(shape)));
}

template <int Dim>
Points<Dim> points_of(const py::handle& given, const std::string& name) {
    const Doubles array = doubles_of(given, name);
    expect_shape(array, {-1, Dim}, name);
    return Eigen::Map<const Points<Dim>>(array.data(), Dim, array.shape(0));
}

template <int Dim>
Doubles array_of(const Points<Dim>& points) {
    Doubles array({points.cols(), Eigen::Index{Dim}});
    std::copy_n(points.data(), points.size(), array.mutable_data());
    return array;
}

Doubles array_of(std::span<const double> numbers) {
    Doubles array(static_cast<py::ssize_t>(numbers.size()));
    std::copy(numbers.begin(), numbers.end(), array.mutable_data());
    return array;
}

int dimensions_of(const Doubles& positions, const std::string& name) {
    if (positions.ndim() != 2 || positions.shape(1) < 1 || positions.shape(1) > 3)
        throw InputError(
            fmt::format("{}: has the shape {}, and should have (n, 1), (n, 2) or (n, 3)", name,
                        shape_of(positions)));
    if (positions.shape(0) == 0)
        throw InputError(fmt::format("{}: is empty; give one particle at least", name));
    return static_cast<int>(positions.shape(1));
}

py::array view_of(const double* data, std::size_t n, std::size_t components, bool scalar,
                  const py::object& owner, bool writable) {
    std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(n)};
    if (!scalar) shape.push_back(static_cast<py::ssize_t>(components));
    py::array view(py::dtype::of<double>(), shape, data, owner);
    if (!writable)
        py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return view;
}

template Points<1> points_of<1>(const py::handle&, const std::string&);
template Points<2> points_of<2>(const py::handle&, const std::string&);
template Points<3> points_of<3>(const py::handle&, const std::string&);
template Doubles array_of<1>(const Points<1>&);
template Doubles array_of<2>(const Points<2>&);
template Doubles array_of<3>(const Points<3>&);

}  // namespace spam::python
