// Boundary layers: particles behind the surface of a wall or of a rigid body, which continue the soil in front of it. They have
// places in the neighbour lists like any particle; velocity and stress they borrow (Bui et al. 2008; Adami, Hu & Adams 2012).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solver/particles/box.hpp"
#include "solver/particles/fields.hpp"
#include "solver/particles/neighbours.hpp"
#include "solver/smoothing/kernels.hpp"

namespace furrow {

enum class Slip {
  none,   ///< rough: soil sticks to the surface, and is bonded to it as soil to soil
  free    ///< smooth: no shear stress and no tension on the surface
};

/// One wall or rigid body of any shape; its particles move as prescribed, without turning.
template <int Dim>
struct BoundaryLayer {
  std::string name;
  Slip slip = Slip::none;
  std::function<Vector<Dim>(double time)> velocity;   ///< m/s
  std::vector<std::int32_t> ids;                      ///< its particles
  std::vector<Vector<Dim>> normal;                    ///< of the surface nearest to each, towards the soil
  std::vector<double> depth;                          ///< of each below the surface, m
};

/// What the extrapolation reads: arrays with images behind the particles proper, and rows of neighbours for these.
template <int Dim>
struct LayerSurroundings {
  AnyKernel kernel;
  double smoothing_length;
  Box<Dim> box;
  const NeighbourList* neighbours;
  std::span<const Vector<Dim>> position;
  std::span<const double> soil_volume;         ///< m/rho, and 0 for particles of layers
  std::span<const std::int32_t> index_of_id;
  std::span<const std::uint8_t> layer_of = {};   ///< of particles proper: 0 for soil, else one more than its place among layers
};

/// Velocities of a layer's particles for the sums over pairs. With <f> the mean over the soil in reach, weighed by V W, and d the
/// distance from the surface:
///   v_w = V - min(1, d_w/<d>) (<v> - V) for a surface that moves with V and does not let slip: v = V on it for a linear profile;
///   where it does, the part along the normal alone, and the part along the surface is <v>'s.
template <int Dim>
void extrapolate_velocity(const LayerSurroundings<Dim>& around, const BoundaryLayer<Dim>& layer, Slip slip,
                          const Vector<Dim>& wall_velocity, std::span<Vector<Dim>> velocity);

/// Stress of a layer's particles: <sigma> + n n^T rho g.n (<x> - x_w).n, the second term what equilibrium along the normal adds
/// over the distance, but no more than <sigma> itself presses: soil without stress does not float on a surface. Of a smooth surface <sigma> is seen in the mirror, so that there is no shear on the surface, and tension
/// across it is cut off. `stress` has the blocks of the stress in the space of motion, images included; `weight` is rho g, N/m^3.
template <int Dim>
void extrapolate_stress(const LayerSurroundings<Dim>& around, const BoundaryLayer<Dim>& layer, const Vector<Dim>& weight,
                        std::span<const Matrix<Dim>> stress, std::span<Tensor> layer_stress);

/// What the pairs of one layer's particle do.
template <int Dim>
struct LayerExchange {
  Vector<Dim> stress_force = Vector<Dim>::Zero();   ///< on it, from the stress term with all its neighbours, N
  Vector<Dim> from_other_layers = Vector<Dim>::Zero();   ///< what of stress_force no soil exerts, N
  double power = 0.0;                               ///< into the soil that it stands for, W
};

/// Sums V_w V_j (A_w + A_j) grad_w W over all neighbours, and over those that are soil the power that the pair neither gives to
/// motion nor to the strain of the body nor takes from the wall's own motion V:
///   f_jw.(V - v_j) - V_j V_w (v_w - v_j).A_j grad_j W,   f_jw = V_j V_w (A_j + A_w) grad_j W,
/// v_w the velocity that the strain of the soil saw. `A` is the stress times the transposed correction of gradients.
template <int Dim>
void layer_exchange(const LayerSurroundings<Dim>& around, const BoundaryLayer<Dim>& layer, const Vector<Dim>& wall_velocity,
                    std::span<const double> volume, std::span<const Matrix<Dim>> A, std::span<const Vector<Dim>> velocity,
                    std::span<LayerExchange<Dim>> out);

}  // namespace furrow
