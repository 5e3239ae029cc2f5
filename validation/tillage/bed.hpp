// What all cuts share: a bed of soil in its box, and where the blade stands before it.
#pragma once

#include <optional>
#include <vector>

#include "harness/dynamic_run.hpp"
#include "harness/scheme_input.hpp"
#include "harness/soil_box.hpp"
#include "reference/exact/earthmoving.hpp"
#include "validation/tillage/interface_input.hpp"

namespace furrow::tillage_cases {

/// A rectangular bed, its lower left corner at the origin, on a rough floor, at a smooth wall on the left; and a blade that comes
/// in from the right through the free face.
struct Bed {
  Soil soil;
  double length, height;   ///< m
  bool right_wall;         ///< below the blade the right face leans on a smooth wall
  double gravity;          ///< m/s^2
  double courant;
  Scheme scheme;
};
Bed read_bed(const Parameters& input);

struct Blade {
  double rake, depth, length, thickness;   ///< rad and m
  double relief;                           ///< angle by which the lower end rises behind the edge; rad
  double gap;                              ///< between the edge and the soil's face at the start, m
  double speed;                            ///< m/s, to the left
  double friction, adhesion;               ///< 1 and Pa
  double travel;                           ///< m, in all

  Vector<2> along() const { return {std::cos(rake), std::sin(rake)}; }                      ///< up the face
  Vector<2> normal() const { return {-std::sin(rake), std::cos(rake)}; }                    ///< of the face, towards the soil
  Vector<2> edge(const Bed& bed) const { return {bed.length + gap, bed.height - depth}; }   ///< at the start
};
/// The blade and its place; an InputError where it cannot be.
Blade read_blade(const Parameters& input, const Bed& bed);

/// How soil and tool act on each other, the blade's friction and adhesion included.
Interface read_interface(const Parameters& input, const Bed& bed, const Blade& blade);

/// The body of soil, at rest, without what a disc (centre and radius) fills.
Body<2> soil_body(const Bed& bed, const Blade& blade, const Resolution& resolution,
                  const std::optional<std::pair<Vector<2>, double>>& disc = std::nullopt);

/// The blade's outline at the start, anticlockwise from the edge.
std::vector<Vector<2>> outline_of(const Bed& bed, const Blade& blade);

/// Throws std::invalid_argument where a particle of soil is touched already, or where the blade on its way reaches none.
void check_start(const Body<2>& soil, const Outline<2>& outline, const Blade& blade, double range);

/// The plane wedge of this cut, with the strength that the soil's cone has in plane strain.
exact::CutForce wedge_of(const Bed& bed, const Blade& blade, exact::Rupture rupture = exact::Rupture::least_force);

/// Picture of the soil, coloured by a quantity, with the outline of the blade.
void picture(Run& run, const Body<2>& soil, const std::vector<std::pair<std::string, std::vector<Vector<2>>>>& outlines,
             const std::string& name, const std::string& title, const Column& colour,
             const std::function<double(std::size_t)>& value);

}  // namespace furrow::tillage_cases
