// SPDX-License-Identifier: GPL-3.0-or-later
// What nearly every problem uses, in one header that is precompiled for all of them. What few need (a term, a
// material, an external, an analysis) is included where it is used.
#pragma once

#include "formulation.hpp"
#include "friction.hpp"
#include "reduced_units.hpp"
#include "shared_options.hpp"
#include "stiffness.hpp"
#include <spam/diagnostics/fits.hpp>
#include <spam/io/csv.hpp>
#include <spam/kernel/any_weight.hpp>
#include <spam/problem/findings.hpp>
#include <spam/problem/pictures.hpp>
#include <spam/problem/sides.hpp>
#include <spam/problem/variant.hpp>
#include <spam/setup/drawn.hpp>
#include <spam/spam.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>
