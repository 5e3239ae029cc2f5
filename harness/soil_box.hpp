// Soil in a box: what cases of soils share. Blocks of particles, boundary layers as floors and walls, the stress at rest.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/case.hpp"
#include "harness/material_file.hpp"
#include "solver/body.hpp"

namespace furrow {

struct Soil {
  std::string name;
  DruckerPrager law;
};

/// The material that the parameter `material` names; an InputError where it is no soil.
Soil read_soil(const Parameters& input);

/// Ratio of lateral to vertical stress at which level ground under the vertical pressure `pressure` (Pa) yields actively.
double active_ratio(const DruckerPrager& law, double pressure);

/// Ratio of lateral to vertical stress at rest: a given number; or else that of elastic soil without lateral strain,
/// nu/(1 - nu), where the cone allows it, and 1.02 times the one at yield where it does not.
struct RestingRatio {
  std::optional<double> given;
  double operator()(const DruckerPrager& law, double pressure) const;
};

/// The key `k0`: a number, or absent. Throws InputError for a number outside the cone at the largest vertical pressure.
RestingRatio read_resting_ratio(const Parameters& input, const DruckerPrager& law, double largest_pressure);

/// Centres of cells of edge dx that fill a rectangle; std::invalid_argument where its edges are no whole numbers of cells.
std::vector<Vector<2>> rectangle(const Vector<2>& corner, double width, double height, double dx);

/// Adds a layer of particles behind the straight surface from `from` to `to`, a row thicker than the kernel reaches. The soil is on the
/// left-hand side on the way.
void add_flat_layer(Body<2>& body, std::string name, const Vector<2>& from, const Vector<2>& to, Slip slip,
                    std::function<Vector<2>(double)> velocity = {});

/// Stress at rest under level ground at height `top`: vertical -rho g (top - y), lateral in both directions by the ratio.
void set_geostatic(Body<2>& body, const DruckerPrager& law, double top, const RestingRatio& ratio);

/// By id, whether a particle belongs to a boundary layer: of a body that has not looked for its neighbours yet.
std::vector<std::uint8_t> layer_flags(const Body<2>& body);

/// Throws std::invalid_argument that names the first soil particle that lies in a layer or closer than a spacing to one of its
/// particles, tolerance a hundredth of the spacing.
void check_clear(const Body<2>& body);

/// A figure of the soil without its layers, each particle with a value by its index. Other series may be added to it.
Figure& soil_figure(Run& run, const Body<2>& body, const std::string& name, const std::string& title, const Column& colour,
                    const std::function<double(std::size_t)>& value);

}  // namespace furrow
