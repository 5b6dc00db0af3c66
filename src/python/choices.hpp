// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "callbacks.hpp"
#include <spam/external/friction.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/fluid.hpp>
#include <spam/physics/scheme.hpp>

#include <optional>
#include <variant>
#include <vector>

/// What Python names before the number of dimensions is known.
namespace spam::python {

/// von Mises' solid in the plane or in space.
struct VonMisesSolid {
    ElasticSolid elastic;
    double yield, hardening;
};

/// A law of the user's own: a function of Python, or an address.
struct OwnLaw {
    Function f;
    std::uintptr_t address = 0;
    std::optional<SoundSpeed> speed;
    double modulus = 1.0;
};

using Solid = std::variant<ElasticSolid, VonMisesSolid, OwnLaw>;

/// Exceptions of a law of Python go to `pending`. Throws InputError for a law that has no such dimension.
template <int Dim>
Material<Dim> material_of(const Solid& solid, const SharedPending& pending);

/// Typical magnitude of stresses: a shear modulus.
double modulus_of(const Solid& solid);
/// Likewise the elastic constants; throws InputError where the law tells none.
ElasticSolid elastic_of(const Solid& solid, const char* model);

/// A scheme whose range, where none is given, is three spacings of the particles that it is for.
struct SchemeChoice {
    Scheme scheme;
    std::optional<double> range;

    Scheme of(double spacing) const {
        Scheme one = scheme;
        one.range = range.value_or(3.0 * spacing);
        return one;
    }
    bool operator==(const SchemeChoice&) const = default;
};

struct GravityChoice {
    std::vector<double> g;
};
struct FrictionChoice {
    double gamma;
    FrictionOf of;
};
struct DragChoice {
    double c, fastest;
    std::vector<double> wind;
};
struct ForceChoice {
    Function f;
};
using ExternalChoice = std::variant<GravityChoice, FrictionChoice, DragChoice, ForceChoice>;

template <int Dim>
std::unique_ptr<External<Dim>> external_of(const ExternalChoice& choice,
                                           const SharedPending& pending);

/// The value whose to_string() is `word`. Throws InputError, which names all of them and the nearest.
template <class Enum>
Enum value_of(const std::string& word, const std::vector<Enum>& values, const std::string& option);

}  // namespace spam::python
