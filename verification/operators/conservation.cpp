// Random particles with random masses, stresses and velocities, in a block with free edges: which form of the momentum sum keeps
// momentum, angular momentum and power, term by term (Monaghan 2005, section 4; Bonet & Lok 1999).
#include <cmath>
#include <random>
#include <string>

#include "solver/schemes/kernel_correction.hpp"
#include "solver/schemes/momentum.hpp"
#include "solver/schemes/xsph.hpp"
#include "verification/lattices.hpp"
#include "verification/operators/largest.hpp"
#include "verification/operators/problems.hpp"

namespace furrow::operator_cases {
namespace {

struct Setup {
  std::string kernel;
  double spacing, ratio;
  int cells;
  std::uint64_t seed;
  bool dual;
};

constexpr double stress_scale = 1e6, speed_scale = 10.0, sound = 50.0;

/// Stresses of no symmetry, or pressures and tensions of the same size.
template <int Dim>
void load(Particles<Dim>& p, bool isotropic, std::mt19937_64& generator) {
  const auto random = [&generator] { return 2.0 * uniform(generator) - 1.0; };
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (isotropic) {
      p.stress[i] = stress_scale * random() * Tensor::Identity();
      continue;
    }
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b <= a; ++b) p.stress[i](a, b) = p.stress[i](b, a) = stress_scale * random();
  }
}

/// x cross f: the component out of the plane, or all three.
Vector<3> moment(const Vector<2>& x, const Vector<2>& f) { return {0.0, 0.0, x[0] * f[1] - x[1] * f[0]}; }
Vector<3> moment(const Vector<3>& x, const Vector<3>& f) { return x.cross(f); }

/// What is lost, each over the sum of the magnitudes of what is added up.
struct Losses {
  double momentum, angular_momentum, power;
};

template <int Dim>
Losses losses(const Stencil<Dim>& stencil, const Particles<Dim>& p, const CorrectionView<Dim>& correction, const MomentumTerms& terms) {
  std::vector<Vector<Dim>> a(p.size());
  std::vector<MomentumPower> power(p.size());
  MomentumWorkspace<Dim> workspace;
  momentum<Dim>(stencil, p, p.velocity, correction, terms, workspace, a, power);
  Vector<Dim> force = Vector<Dim>::Zero(), centre = Vector<Dim>::Zero();
  for (const Vector<Dim>& x : p.position) centre += x / static_cast<double>(p.size());
  Vector<3> torque = Vector<3>::Zero();
  double work = 0.0, forces = 0.0, torques = 0.0, works = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector<Dim> f = p.mass[i] * a[i], arm = p.position[i] - centre;
    force += f, forces += f.norm();
    torque += moment(arm, f), torques += arm.norm() * f.norm();
    const double heat = p.mass[i] * (power[i].stress + power[i].viscous + power[i].artificial);
    work += f.dot(p.velocity[i]) + heat, works += std::abs(f.dot(p.velocity[i])) + std::abs(heat);
  }
  return {force.norm() / forces, torque.norm() / torques, std::abs(work) / works};
}

template <int Dim>
void run_block(Run& run, const Setup& s) {
  const AnyKernel kernel = *kernel_by_name(s.kernel);
  const double h = s.ratio * s.spacing, density = 2000.0;
  Arrangement<Dim> a = arranged(jittered(square_lattice<Dim>(all_axes<Dim>(s.cells), s.spacing, false), 0.3, s.seed), density,
                                support(kernel) * h * (1.0 + 1e-9));
  Particles<Dim>& p = a.particles;
  run.count(0, static_cast<long>(p.size()));
  std::mt19937_64 generator(s.seed + 1);
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.mass[i] *= 0.8 + 0.4 * uniform(generator);
    p.density[i] *= 0.8 + 0.4 * uniform(generator);
    p.sound_speed[i] = sound * (0.5 + uniform(generator));
    for (int b = 0; b < Dim; ++b) p.velocity[i][b] = speed_scale * (2.0 * uniform(generator) - 1.0);
  }
  const Stencil<Dim> stencil = a.stencil(kernel, h);
  std::vector<Matrix<Dim>> B;
  if (s.dual) {
    B.resize(p.size());
    kernel_correction<Dim>(stencil, a.volume(), B);
  }

  Table& table = run.table("losses", "What the sum over all particles leaves, over the sum of magnitudes",
                           {{"stress"}, {"terms"}, {"momentum"}, {"angular momentum"}, {"power"}});
  Largest momentum_lost, power_lost, promised, not_promised_plain, not_promised_artificial;
  for (const bool isotropic : {true, false}) {
    load<Dim>(p, isotropic, generator);
    for (const bool viscous : {false, true})
      for (const bool artificial : {false, true}) {
        MomentumTerms terms{.viscosity = {}, .artificial_stress = {}, .spacing = s.spacing};
        if (viscous) terms.viscosity = ArtificialViscosity{};
        if (artificial) terms.artificial_stress = ArtificialStress{};
        const CorrectionView<Dim> correction = B.empty() ? CorrectionView<Dim>{} : std::span<const Matrix<Dim>>(B);
        const Losses lost = losses<Dim>(stencil, p, correction, terms);
        momentum_lost.add(lost.momentum);
        power_lost.add(lost.power);
        // Forces along the line of centres turn nothing: pressure in the paper's form, viscosity, artificial stress of a pressure.
        const bool central = (isotropic || s.dual) && (isotropic || !artificial);
        if (central)
          promised.add(lost.angular_momentum);
        else if (artificial)
          not_promised_artificial.add(lost.angular_momentum);
        else
          not_promised_plain.add(lost.angular_momentum);
        table.row({isotropic ? "pressure" : "general", std::string("stress") + (viscous ? " + viscosity" : "") + (artificial ? " + artificial stress" : ""),
                   lost.momentum, lost.angular_momentum, lost.power});
      }
  }

  std::vector<Vector<Dim>> moved(p.size());
  xsph_velocity<Dim>(stencil, p, p.velocity, 0.5, moved);
  Vector<Dim> drift = Vector<Dim>::Zero();
  double drifts = 0.0, before = 0.0, after = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    drift += p.mass[i] * (moved[i] - p.velocity[i]), drifts += p.mass[i] * (moved[i] - p.velocity[i]).norm();
    before += p.mass[i] * p.velocity[i].squaredNorm(), after += p.mass[i] * moved[i].squaredNorm();
  }

  Figure& figure = run.figure({.name = "particles", .title = "The random block", .kind = "particles", .x = {"x", "mm"}, .y = {"y", "mm"},
                               .colour = {"sigma_xx", "MPa"}});
  figure.caption = "Particles of a jittered block with free edges; colour: one component of their random stress.";
  Series& series = figure.add({.label = "particles"});
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (Dim == 3 && p.position[i][Dim - 1] > s.spacing) continue;
    series.x.push_back(1e3 * p.position[i][0]), series.y.push_back(1e3 * p.position[i][1]), series.colour.push_back(1e-6 * p.stress[i](0, 0));
  }

  run.measure("momentum", momentum_lost.value());
  run.measure("angular_momentum", promised.value());
  run.measure("power", power_lost.value());
  if (!s.dual) run.measure("angular_momentum_general_stress", not_promised_plain.value());
  run.measure("angular_momentum_artificial_stress", not_promised_artificial.value());
  run.measure("xsph_momentum", drift.norm() / drifts);
  run.measure("xsph_kinetic_energy", after / before);
  run.note(s.dual ? "The dual form turns nothing under any stress; artificial stress in principal axes is not central and does."
                  : "The paper's form turns the body by itself as soon as the stress is not a pressure: its pair forces are not along the "
                    "line of centres.");
}

}  // namespace

Problem conservation(const Parameters& input) {
  const Setup setup{.kernel = input.choice("kernel", kernel_names()),
                    .spacing = input.quantity("spacing", dimension::length, range::positive),
                    .ratio = input.number("h_over_dx", {0.8, 4.0}),
                    .cells = static_cast<int>(input.integer("cells", 4, 200)),
                    .seed = static_cast<std::uint64_t>(input.integer("seed", 0, 1'000'000)),
                    .dual = input.choice("form", {"paper", "dual"}) == "dual"};
  const long dimension = input.integer("dimension", 2, 3);
  return [=](Run& run) {
    for (const char* module : {"momentum", "viscosity", "artificial_stress", "xsph"}) run.exercises(std::string("schemes/") + module);
    if (setup.dual) run.exercises("schemes/kernel_correction");
    if (dimension == 2)
      run_block<2>(run, setup);
    else
      run_block<3>(run, setup);
  };
}

}  // namespace furrow::operator_cases
