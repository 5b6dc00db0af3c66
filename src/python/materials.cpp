// SPDX-License-Identifier: GPL-3.0-or-later
// Room material: solids, gases and laws of one's own.
#include "bindings.hpp"
#include "choices.hpp"
#include <spam/core/error.hpp>
#include <spam/material/cavitation.hpp>
#include <spam/material/gamma_gas.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/material/isentropic_gas.hpp>
#include <spam/material/lucy_gas.hpp>
#include <spam/material/van_der_waals_isotherm.hpp>
#include <spam/material/von_mises.hpp>
#include <spam/material/yielding_solid.hpp>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>

namespace spam::python {
namespace {

using namespace py::literals;

void expect(bool holds, const char* option, double value, const char* allowed) {
    if (!holds || !std::isfinite(value))
        throw InputError(fmt::format("{}: {} is not allowed; use {}", option, value, allowed));
}

ElasticSolid elastic(double lam, double eta) {
    expect(eta > 0.0, "eta", eta, "a shear modulus above 0");
    expect(lam + eta > 0.0, "lam", lam, "more than -eta");
    return {lam, eta};
}

/// None, a number, or a function of the density.
using SpeedChoice = std::variant<std::monostate, double, py::function>;

OwnLaw own(const SpeedChoice& speed, double modulus) {
    expect(modulus > 0.0, "modulus", modulus, "a typical modulus above 0");
    OwnLaw law{nullptr, 0, std::nullopt, modulus};
    if (const auto* number = std::get_if<double>(&speed)) {
        expect(*number > 0.0, "sound_speed", *number, "a number above 0");
        law.speed = SoundSpeed{*number};
    } else if (const auto* f = std::get_if<py::function>(&speed)) {
        law.speed = SoundSpeed{0.0, function_of(*f)};
    }
    return law;
}

template <int Dim, bool sounds>
Material<Dim> own_material(const OwnLaw& law, const SharedPending& pending) {
    const SoundSpeed speed = law.speed.value_or(SoundSpeed{});
    if (law.f) return FunctionLaw<Dim, sounds>{law.f, pending, speed};
    return AddressLaw<Dim, sounds>{reinterpret_cast<StressFunction>(law.address), speed};
}

template <class Law>
std::string shown(const Law& law) {
    return "<" + law.describe() + ">";
}

void bind_solids(py::module_& module) {
    py::class_<ElasticSolid>(
        module, "ElasticSolid",
        "Isotropic linear elasticity with co-rotation, [HHM04] II; Lame's constants `lam` and `eta` (stress).")
        .def(py::init(&elastic), "lam"_a, "eta"_a)
        .def_static("triangular_lattice", &ElasticSolid::triangular_lattice, "kappa"_a = 1.0,
                    "The constants of the triangular lattice of nearest-neighbour springs kappa.")
        .def_readonly("lam", &ElasticSolid::lambda, "Lame's first constant (stress).")
        .def_readonly("eta", &ElasticSolid::eta,
                      "Lame's second constant, the shear modulus (stress).")
        .def("sound_speed", &ElasticSolid::sound_speed, "density"_a, "Longitudinal (length/time).")
        .def("__repr__", &shown<ElasticSolid>);
    py::class_<VonMisesSolid>(
        module, "VonMisesSolid",
        "An elastic solid that yields at q = yield_stress + hardening * eps_p (plane or space).")
        .def(py::init([](double lam, double eta, double yield, double hardening) {
                 LinearHardening{yield, hardening}.validate();
                 return VonMisesSolid{elastic(lam, eta), yield, hardening};
             }),
             "lam"_a, "eta"_a, "yield_stress"_a, "hardening"_a = 0.0);
    py::class_<OwnLaw>(
        module, "Material",
        "A stress law of one's own, f(grad_v, stress) -> sigma_dot: for m particles at a time (256 at most)\n"
        "grad_v (m, D, D) with grad_v[:, a, b] = d v_b/d x_a, stress and sigma_dot (m, D(D+1)/2): xx; xx, yy,\n"
        "xy; xx, yy, zz, xy, yz, xz. It must not depend on which particles are asked for together. An\n"
        "exception of f ends the run and arrives unchanged; NaN stops the run (GuardStop).\n"
        "`sound_speed` (length/time), a number or a function of the density, is needed by schemes with\n"
        "viscosity; `modulus`, a typical one, is the\n"
        "scale of the absolute tolerance of stresses.")
        .def(py::init([](py::function f, const SpeedChoice& speed, double modulus) {
                 OwnLaw law = own(speed, modulus);
                 law.f = function_of(std::move(f));
                 return law;
             }),
             "f"_a, "sound_speed"_a = py::none(), "modulus"_a = 1.0)
        .def_static(
            "from_address",
            [](std::uintptr_t address, const SpeedChoice& speed, double modulus) {
                if (address == 0) throw InputError("address: 0 is no address of a function");
                OwnLaw law = own(speed, modulus);
                law.address = address;
                return law;
            },
            "address"_a, "sound_speed"_a = py::none(), "modulus"_a = 1.0,
            "The same by the address of void f(int64 n, double* grad_v, double* stress, double* rate), such as\n"
            "numba.cfunc(...).address: called from several threads at once, without the interpreter. Keep the\n"
            "function alive as long as models use it.");
}

template <class Law>
py::class_<Law> gas(py::module_& module, const char* name, const char* doc) {
    return py::class_<Law>(module, name, doc).def("__repr__", &shown<Law>);
}

void bind_fluids(py::module_& module) {
    gas<LucyGas>(module, "LucyGas", "P = rho^2/2, the gas of [HH01].").def(py::init<>());
    gas<IdealGas>(module, "IdealGas", "P = 2/D rho e, temperature 2/D m e.")
        .def(py::init([](int dimensions, double mass) {
                 expect(dimensions >= 1 && dimensions <= 3, "dimensions", dimensions, "1, 2 or 3");
                 expect(mass > 0.0, "mass", mass, "a number above 0");
                 return IdealGas{dimensions, mass};
             }),
             "dimensions"_a = 2, "mass"_a = 1.0);
    gas<GammaGas>(module, "GammaGas", "P = (gamma - 1) rho e, temperature (gamma - 1) e.")
        .def(py::init([](double gamma) {
                 expect(gamma > 1.0, "gamma", gamma, "more than 1");
                 return GammaGas{gamma};
             }),
             "gamma"_a = 1.4);
    gas<IsentropicGas>(module, "IsentropicGas", "P = P0 (rho/rho0)^gamma")
        .def(py::init([](double P0, double rho0, double gamma) {
                 expect(P0 > 0.0, "P0", P0, "a number above 0");
                 expect(rho0 > 0.0, "rho0", rho0, "a number above 0");
                 expect(gamma > 1.0, "gamma", gamma, "more than 1");
                 return IsentropicGas{P0, rho0, gamma};
             }),
             "P0"_a = 1.0, "rho0"_a = 1.0, "gamma"_a = 2.0);
    gas<VanDerWaals>(module, "VanDerWaals", "P = rho T/(1 - b rho) - a rho^2")
        .def(py::init([](double a, double b, int dimensions) {
                 expect(a >= 0.0, "a", a, "0 or more");
                 expect(b >= 0.0, "b", b, "0 or more");
                 expect(dimensions >= 1 && dimensions <= 3, "dimensions", dimensions, "1, 2 or 3");
                 return VanDerWaals{a, b, dimensions};
             }),
             "a"_a = 1.0, "b"_a = 1.0, "dimensions"_a = 2);
    gas<CavitatingEmbeddedAtom>(
        module, "EmbeddedAtom",
        "P = B0 (rho^3/rho0^3 - rho^2/rho0^2), [HH07]; its tension is at most `tension_limit`, of which\n"
        "4 B0/27 or None is no limit.")
        .def(py::init([](double B0, double rho0, std::optional<double> limit) {
                 expect(B0 > 0.0, "B0", B0, "a number above 0");
                 expect(rho0 > 0.0, "rho0", rho0, "a number above 0");
                 const double most = 4.0 * B0 / 27.0;
                 expect(!limit || (*limit >= 0.0 && *limit <= most), "tension_limit",
                        limit.value_or(0.0), "0 to 4 B0/27");
                 return CavitatingEmbeddedAtom({B0, rho0}, limit.value_or(most));
             }),
             "B0"_a = 1.0, "rho0"_a = 1.0, "tension_limit"_a = std::nullopt);
    gas<VanDerWaalsIsotherm>(
        module, "VanDerWaalsIsotherm",
        "The same at one temperature T: a cold law, e = -T ln((1 - b rho)/rho) - a rho.")
        .def(py::init([](double a, double b, double T) {
                 expect(a >= 0.0, "a", a, "0 or more");
                 expect(b > 0.0, "b", b, "a number above 0");
                 expect(T > 0.0, "T", T, "a number above 0");
                 return VanDerWaalsIsotherm{a, b, T};
             }),
             "a"_a = 1.0, "b"_a = 1.0, "T"_a = 0.25);
    using Gas = std::variant<LucyGas, IdealGas, GammaGas, IsentropicGas, VanDerWaals,
                             VanDerWaalsIsotherm, CavitatingEmbeddedAtom>;
    py::class_<Fluid>(
        module, "Fluid",
        "A gas or liquid: an equation of state, with Newton's viscosity (shear `eta`, second\n"
        "coefficient `lam`) and Fourier's conduction `kappa` where these are given. `by_pairs`: both\n"
        "from differences of pairs, not from gradients.")
        .def(
            py::init([](const Gas& state, std::optional<double> eta, double lam,
                        std::optional<double> kappa, bool by_pairs) {
                if (std::holds_alternative<VanDerWaalsIsotherm>(state) && (eta || kappa))
                    throw InputError(fmt::format(
                        "{}: VanDerWaalsIsotherm is held at one temperature, and has no heat that {}; use "
                        "VanDerWaals, or an external Friction",
                        eta ? "eta" : "kappa", eta ? "friction could warm" : "could be conducted"));
                Fluid fluid{
                    std::visit([](const auto& law) { return AnyEquationOfState(law); }, state)};
                if (eta) fluid.viscosity = NewtonViscosity{lam, *eta};
                if (kappa) fluid.conduction = FourierConduction{*kappa};
                fluid.by_pairs = by_pairs;
                return fluid;
            }),
            "state"_a, "eta"_a = std::nullopt, "lam"_a = 0.0, "kappa"_a = std::nullopt,
            "by_pairs"_a = false)
        .def("__repr__", &shown<Fluid>);
}

}  // namespace

template <int Dim>
Material<Dim> material_of(const Solid& solid, const SharedPending& pending) {
    if (const auto* law = std::get_if<ElasticSolid>(&solid)) return *law;
    if (const auto* law = std::get_if<OwnLaw>(&solid))
        return law->speed ? own_material<Dim, true>(*law, pending)
                          : own_material<Dim, false>(*law, pending);
    const auto& law = std::get<VonMisesSolid>(solid);
    if constexpr (Dim == 1)
        throw InputError(
            "material: a von Mises solid has two or three dimensions; give positions (n, 2) or (n, 3)");
    else
        return YieldingSolid<RadialVonMises<Dim>>({law.elastic.lambda, law.elastic.eta},
                                                  {law.yield, law.hardening});
}

double modulus_of(const Solid& solid) {
    if (const auto* law = std::get_if<OwnLaw>(&solid)) return law->modulus;
    if (const auto* law = std::get_if<ElasticSolid>(&solid)) return law->eta;
    return std::get<VonMisesSolid>(solid).elastic.eta;
}

ElasticSolid elastic_of(const Solid& solid, const char* model) {
    if (const auto* law = std::get_if<ElasticSolid>(&solid)) return *law;
    throw InputError(fmt::format("material: {} takes an ElasticSolid", model));
}

template Material<1> material_of<1>(const Solid&, const SharedPending&);
template Material<2> material_of<2>(const Solid&, const SharedPending&);
template Material<3> material_of<3>(const Solid&, const SharedPending&);

void bind_materials(py::module_& module) {
    bind_solids(module);
    bind_fluids(module);
}

}  // namespace spam::python
