// A rod on a wall: its particles before the impact, and its shape afterwards. The axis is x, the wall is x = 0.
#pragma once

#include <string>
#include <vector>

#include "solver/body.hpp"

namespace furrow::taylor_bar_cases {

struct Rod {
  double length, diameter;   ///< m
};

/// Cells that fill a rod: centres and volumes. Every cell is dx wide along the radius and `layer` thick along the axis.
struct Cells {
  std::vector<Vector<3>> centre;   ///< layer by layer from the foot
  std::vector<double> volume;      ///< m^3
  double layer = 0.0;              ///< m
  std::size_t per_layer = 0;
};

enum class Arrangement {
  rings,    ///< concentric rings, dx apart: the surface is round
  square    ///< square cells whose centres lie within the section: the surface is a staircase
};
Arrangement arrangement_by_name(const std::string& name);

/// The quarter y, z > 0 of the rod; `spacing` must fit into the radius a whole number of times (rings) and layers are the whole
/// number that comes nearest to it. Volumes sum to that of the quarter rod. Throws std::invalid_argument.
Cells quarter_rod(const Rod& rod, double spacing, Arrangement arrangement);

/// The same with its mirror images across y = 0 and z = 0.
Cells whole_rod(const Cells& quarter);

/// How far the material of particle i reaches along the unit vector n, seen from the origin: its centre plus half its deformed
/// spacing. A cell of edges 2 s_k becomes an ellipsoid of half axes F s, which reaches |S F^T n| from its centre.
double reach(const Particles<3>& particles, std::size_t i, const Vector<3>& n, const Vector<3>& half_edges);

/// Shape of a rod as one would measure it, m.
struct RodShape {
  double length = 0.0;         ///< from the wall to where the rear reaches
  double foot_radius = 0.0;    ///< greatest radius
  /// One point a layer of cells, by height: centre and radius of its outermost particle.
  std::vector<double> height, radius;

  /// Radius at a height above the wall, on straight lines between layers; the first or last layer's beyond them.
  double radius_at(double h) const;
  /// Length of the rear whose radius has grown by less than `tolerance` times the first radius.
  double undeformed_length(double first_radius, double tolerance) const;
};
RodShape shape_of(const Body<3>& body, double layer);

}  // namespace furrow::taylor_bar_cases
