// SPDX-License-Identifier: GPL-3.0-or-later
// Configurations of a body of elements that are worth drawing.
#pragma once

#include "../common.hpp"
#include <spam/material/plastic_fields.hpp>

#include <limits>

namespace breaking {

using namespace spam;

/// Plastic strains of elements, NaN where they are broken.
inline std::vector<double> strains_of_elements(const Model<2>& model, std::span<const double> y) {
    const ConstState<2> elements = ConstState<2>(model.layout(), y).elements();
    const std::size_t n = model.quadrilaterals().size();
    const double* const strain = elements.find(field_kind::plastic_strain);
    const double* const broken = elements.find(field_kind::broken);
    std::vector<double> all(strain, strain + n);
    for (std::size_t k = 0; broken != nullptr && k < n; ++k)
        if (broken[k] != 0.0) all[k] = std::numeric_limits<double>::quiet_NaN();
    return all;
}

/// Elements that are not broken coloured by their plastic strains, `strain`, nodes that belong to none left out.
inline ConfigurationPanel strain_panel(const std::string& title, const Model<2>& model,
                                       const Points<2>& position,
                                       const std::vector<double>& strain) {
    ConfigurationPanel panel{title, {}, {}, {}, {}};
    std::vector<std::int64_t> place(model.particles().size(), -1);
    std::vector<Eigen::Index> nodes;
    for (std::size_t k = 0; k < strain.size(); ++k) {
        if (std::isnan(strain[k])) continue;
        Quadrilateral corners = model.quadrilaterals()[k];
        for (std::uint32_t& i : corners) {
            if (place[i] < 0) {
                place[i] = static_cast<std::int64_t>(nodes.size());
                nodes.push_back(i);
            }
            i = static_cast<std::uint32_t>(place[i]);
        }
        panel.colour.push_back(strain[k]);
        panel.elements.push_back(corners);
    }
    panel.position = position(Eigen::all, nodes);
    return panel;
}

}  // namespace breaking
