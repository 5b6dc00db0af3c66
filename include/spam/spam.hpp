// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// What a problem with smooth particles or springs needs: options, session, lattices, states, the elastic solid and
/// two gases. Externals, further materials and terms have headers of their own, which src/docs/recipes.md lists.
#include <spam/core/error.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/diagnostics/shape.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/material/lucy_gas.hpp>
#include <spam/problem/session.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>
