// SPDX-License-Identifier: GPL-3.0-or-later
// Room physics: the choices of a scheme, by the words of the programs' options.
#include "bindings.hpp"
#include "choices.hpp"
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>
#include <spam/physics/scheme.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>

#include <algorithm>

namespace spam::python {

template <class Enum>
Enum value_of(const std::string& word, const std::vector<Enum>& values, const std::string& option) {
    std::vector<std::string> words;
    for (const Enum value : values) {
        if (to_string(value) == word) return value;
        words.emplace_back(to_string(value));
    }
    std::string end = suggestion(word, words);
    if (end == ".") end.clear();
    throw InputError(fmt::format("{}: '{}' is not known; use {}{}", option, one_line(word),
                                 fmt::join(words, ", "), end));
}

namespace {

SchemeChoice scheme_of(const std::string& density, const std::string& transport,
                       const std::string& mean_density, const std::string& angular_momentum,
                       const std::string& balance, const std::string& gauss_singular,
                       const std::string& work, double viscosity, double shifting,
                       double closest_approach, const std::string& kernel,
                       std::optional<double> range) {
    Scheme s;
    s.density = value_of<Density>(
        density, {Density::continuity, Density::summed, Density::chain_rule}, "density");
    s.transport = value_of<Transport>(
        transport, {Transport::plain, Transport::average, Transport::monaghan, Transport::shifting},
        "transport");
    s.mean_density = value_of<MeanDensityKind>(
        mean_density, {MeanDensityKind::arithmetic, MeanDensityKind::geometric}, "mean_density");
    s.angular_momentum =
        value_of<AngularMomentum>(angular_momentum,
                                  {AngularMomentum::free, AngularMomentum::gauss,
                                   AngularMomentum::torque_particle, AngularMomentum::torque_pair},
                                  "angular_momentum");
    s.balance = value_of<Balance>(balance, {Balance::body, Balance::global}, "balance");
    s.gauss_singular = value_of<GaussSingular>(
        gauss_singular, {GaussSingular::skip, GaussSingular::stop}, "gauss_singular");
    s.work = value_of<Work>(work, {Work::mean, Work::own}, "work");
    s.viscosity = viscosity;
    s.shifting = shifting;
    s.closest_approach = closest_approach;
    s.kernel = value_of<Kernel>(kernel, all_kernels(), "kernel");
    return {s, range};
}

}  // namespace

void bind_scheme(py::module_& module) {
    using namespace py::literals;
    const Scheme standard;
    const auto word = [](auto value) { return std::string(to_string(value)); };
    py::class_<SchemeChoice>(
        module, "Scheme",
        "The choices of a scheme, [HHM04] IX, by the words of the programs' options:\n\n"
        "density           continuity, summed, chain_rule\n"
        "transport         plain, average, monaghan, shifting: what moves the particles\n"
        "mean_density      arithmetic, geometric\n"
        "angular_momentum  free, gauss, torque_particle, torque_pair\n"
        "balance           body, global: what keeps an angular momentum of its own\n"
        "gauss_singular    skip, stop\n"
        "work              mean, own: whose pressure does the work that changes a particle's energy\n"
        "viscosity         alpha of the artificial viscosity, 0 without\n"
        "shifting          coefficient of transport='shifting'\n"
        "closest_approach  distance at which pairs are reflected, 0: never (length)\n"
        "kernel            lucy, monaghan, w2 to w8\n"
        "range             where the weight vanishes (length); default 3 spacings of the particles\n\n"
        "Raises InputError for an unknown word. What makes no sense together is refused by the model.")
        .def(py::init(&scheme_of), py::kw_only(), "density"_a = word(standard.density),
             "transport"_a = word(standard.transport),
             "mean_density"_a = word(standard.mean_density),
             "angular_momentum"_a = word(standard.angular_momentum),
             "balance"_a = word(standard.balance),
             "gauss_singular"_a = word(standard.gauss_singular), "work"_a = word(standard.work),
             "viscosity"_a = standard.viscosity, "shifting"_a = standard.shifting,
             "closest_approach"_a = standard.closest_approach, "kernel"_a = word(standard.kernel),
             "range"_a = py::none())
        .def_readonly("range", &SchemeChoice::range,
                      "Where the weight vanishes (length); None: at 3 spacings.")
        .def("__eq__", [](const SchemeChoice& a, const SchemeChoice& b) { return a == b; })
        .def("__repr__", [](const SchemeChoice& choice) {
            return "<Scheme: " + choice.of(1.0).describe() +
                   (choice.range ? ">" : " (in spacings)>");
        });
}

}  // namespace spam::python
