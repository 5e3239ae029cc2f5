// A body but for what accelerates it (body_forces.cpp) and for the reference frame (body_reference.cpp).
#include "solver/body.hpp"

#include <Eigen/LU>

#include "solver/particles/ordered_sum.hpp"
#include "solver/materials/parts.hpp"
#include "solver/schemes/density.hpp"
#include "solver/schemes/kernel_correction.hpp"
#include "solver/schemes/velocity_gradient.hpp"

namespace furrow {
namespace {

/// Neighbours are found a little further than the support reaches, so that a list serves for many steps.
constexpr double skin = 0.08;

}  // namespace

template <int Dim>
Stencil<Dim> Body<Dim>::stencil() const {
  return {scheme.kernel, smoothing_length(), box, in_reference_frame() ? particles.reference_position : particles.position,
          &neighbours_, images.empty() ? nullptr : &images};
}

template <int Dim>
MaterialState Body<Dim>::state(std::size_t i) const {
  const Particles<Dim>& p = particles;
  MaterialState s;
  s.stress = p.stress[i];
  s.density = p.density[i];
  s.internal_energy = p.internal_energy[i];
  s.plastic_strain = p.plastic_strain[i];
  s.temperature = p.temperature[i];
  s.plastic_work = p.plastic_work[i];
  s.damage = p.damage[i];
  s.fracture_onset = p.fracture_onset[i];
  return s;
}

template <int Dim>
void Body<Dim>::set_state(std::size_t i, const MaterialState& s) {
  Particles<Dim>& p = particles;
  p.stress[i] = s.stress;
  p.density[i] = s.density;
  p.internal_energy[i] = s.internal_energy;
  p.plastic_strain[i] = s.plastic_strain;
  p.temperature[i] = s.temperature;
  p.plastic_work[i] = s.plastic_work;
  p.damage[i] = s.damage;
  p.fracture_onset[i] = s.fracture_onset;
}

template <int Dim>
void Body<Dim>::add(const std::vector<Vector<Dim>>& positions, const Vector<Dim>& velocity) {
  const std::size_t first = particles.size();
  resize(particles, first + positions.size());
  const MaterialState initial = std::visit([](const auto& m) { return m.initial_state(); }, material);
  const double c = std::visit([&](const auto& m) { return m.sound_speed(initial); }, material);
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const std::size_t i = first + k;
    particles.id[i] = static_cast<std::int32_t>(i);
    particles.position[i] = particles.reference_position[i] = positions[k];
    particles.deformation_gradient[i].setIdentity();
    particles.velocity[i] = velocity;
    particles.mass[i] = initial.density * std::pow(spacing, Dim);
    particles.sound_speed[i] = c;
    set_state(i, initial);
  }
}

template <int Dim>
void Body<Dim>::hold_face(std::string name, const std::vector<std::vector<std::int32_t>>& columns) {
  // The load of a uniform tension, from a copy: finding neighbours sorts particles.
  Body<Dim> pulled = *this;
  pulled.refresh_neighbours(true);
  Particles<Dim>& p = pulled.particles;
  p.stress.assign(p.size(), Tensor::Identity());
  momentum<Dim>(pulled.stencil(), p, p.velocity, pulled.correction(), {}, pulled.workspace_, p.acceleration, pulled.power_);

  HeldFace face{std::move(name), {}};
  for (const std::vector<std::int32_t>& ids : columns) {
    if (ids.size() < 2) throw std::invalid_argument("a held face needs columns of two particles or more");
    const auto at = [&](std::size_t k) { return pulled.index_of(ids[k]); };
    const Vector<Dim> inwards = (p.position[at(1)] - p.position[at(0)]).normalized();
    std::vector<double> w, d;
    double sum = 0.0;
    for (std::size_t k = 0; k < ids.size(); ++k) {
      w.push_back(p.mass[at(k)] * p.acceleration[at(k)].dot(inwards));
      d.push_back(0.5 * spacing + (p.position[at(k)] - p.position[at(0)]).dot(inwards));
      sum += w.back();
    }
    // w/sum + a + b d with sum 1 and moment 0 about the face.
    double n = 0.0, d1 = 0.0, d2 = 0.0, moment = 0.0;
    for (std::size_t k = 0; k < w.size(); ++k) {
      w[k] /= sum;
      n += 1.0, d1 += d[k], d2 += d[k] * d[k], moment += w[k] * d[k];
    }
    const double b = -moment * n / (n * d2 - d1 * d1), a = -b * d1 / n;
    for (std::size_t k = 0; k < w.size(); ++k) w[k] += a + b * d[k];
    face.columns.push_back({ids, w});
  }
  loads.faces.push_back(face);
}

template <int Dim>
void Body<Dim>::find_neighbours() {
  Particles<Dim>& p = particles;
  const std::size_t n = p.size();
  // Pairs that are kept for good need no skin.
  const double reach = (keeps_pairs() ? 1.0 : 1.0 + skin) * support(scheme.kernel) * smoothing_length();
  // One grid over particles and images; both parts are sorted by its cells, images after what they are images of.
  std::vector<Vector<Dim>> seen(p.position_at_build.begin(), p.position_at_build.begin() + static_cast<std::ptrdiff_t>(n));
  const std::vector<Vector<Dim>> mirrored = images.choose(seen, reach);
  seen.insert(seen.end(), mirrored.begin(), mirrored.end());
  const CellGrid<Dim> grid(seen, reach, box);
  const CellOrder proper = order_by_cell<Dim>(grid, std::span(seen).first(n));
  permute(p, proper.order);
  const std::vector<Vector<Dim>> unsorted = images.choose(p.position_at_build, reach);
  const CellOrder mirror = order_by_cell<Dim>(grid, unsorted);
  images.permute(mirror.order);
  std::copy_n(p.position_at_build.begin(), n, seen.begin());
  images.fill_positions(seen);
  build_neighbours<Dim>(grid, proper.begin, mirror.begin, seen, n, reach, neighbours_);

  index_of_id_.resize(n);
  for (std::size_t i = 0; i < n; ++i) index_of_id_[static_cast<std::size_t>(p.id[i])] = static_cast<std::int32_t>(i);
  velocity_gradient_.resize(n);
  power_.resize(n);
  const std::size_t extended = n + images.size();
  p.position.resize(extended);
  p.velocity.resize(extended);
  p.mass.resize(extended);
  p.density.resize(extended);
  p.sound_speed.resize(extended);
  p.reference_position.resize(extended);
  p.deformation_gradient.resize(extended);
  volume_.resize(extended);
  if (!layers.empty() && (scheme.correction == Correction::quadratic || in_reference_frame()))
    throw std::invalid_argument("boundary layers are there for the correction none or linear in the current frame");
  in_layer_.assign(n, 0);
  for (std::size_t l = 0; l < layers.size(); ++l)
    for (const std::int32_t id : layers[l].ids) in_layer_[index_of(id)] = static_cast<std::uint8_t>(l + 1);
  if (!layers.empty()) put_idle_layers_to_rest();
  if (scheme.correction == Correction::linear) linear_.resize(n);
  if (scheme.correction == Correction::quadratic) quadratic_.resize(n);
  ++builds_;
  if (in_reference_frame()) build_reference();
}

template <int Dim>
void Body<Dim>::put_idle_layers_to_rest() {
  const std::size_t n = particles.size();
  // Images of a particle are what it is. Twice: what soil sees, and what such a particle of a layer sees.
  std::vector<double> seen(n + images.size(), 0.0);
  std::vector<std::uint8_t> sees(n);
  for (std::size_t i = 0; i < n; ++i) seen[i] = is_in_layer(i) ? 0.0 : 1.0;
  for (int reach = 0; reach < 2; ++reach) {
    images.fill(std::span(seen));
    for (std::size_t i = 0; i < n; ++i) {
      const auto row = neighbours_.row(i);
      sees[i] = seen[i] != 0.0 || std::any_of(row.begin(), row.end(), [&](std::int32_t j) { return seen[static_cast<std::size_t>(j)] != 0.0; });
    }
    std::copy(sees.begin(), sees.end(), seen.begin());
  }
  drop_rows(neighbours_, sees);
}

template <int Dim>
void Body<Dim>::drift(std::span<const Vector<Dim>> velocity, double dt) {
  Particles<Dim>& p = particles;
  if (in_reference_frame()) {   // neighbours are those of the undeformed body
    for_all(p.size(), [&](std::size_t i) { p.position[i] += dt * velocity[i]; });
    return refresh_neighbours();
  }
  const auto n = static_cast<std::int64_t>(p.size());
  double low[Dim], high[Dim], total = 0.0;
  std::fill_n(low, Dim, std::numeric_limits<double>::infinity());
  std::fill_n(high, Dim, -std::numeric_limits<double>::infinity());
#pragma omp parallel for schedule(static) reduction(min : low) reduction(max : high) reduction(+ : total)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    p.position[i] += dt * velocity[i];
    const Vector<Dim> moved = p.position[i] - p.position_at_build[i];
    for (int a = 0; a < Dim; ++a) {
      low[a] = std::min(low[a], moved[a]);
      high[a] = std::max(high[a], moved[a]);
    }
    total += moved.sum();   // not a number where any of them is not
  }
  // No two particles have come nearer to each other than the diagonal of the box that holds all displacements: a body that flies
  // without deforming keeps its neighbours.
  Vector<Dim> lowest = Eigen::Map<const Vector<Dim>>(low), highest = Eigen::Map<const Vector<Dim>>(high);
  images.include_images(lowest, highest);
  const double allowed = skin * support(scheme.kernel) * smoothing_length();
  refresh_neighbours(!std::isfinite(total) || !((highest - lowest).squaredNorm() < allowed * allowed));
}

template <int Dim>
void Body<Dim>::refresh_neighbours(bool find) {
  Particles<Dim>& p = particles;
  const std::size_t n = p.size();
  if (in_reference_frame()) {
    if (find) {
      std::copy_n(p.reference_position.begin(), n, p.position_at_build.begin());
      find_neighbours();
    }
    if (find || !keeps_pairs()) fill_images();   // else sums fill what they read
    return;
  }
  if (find) {
    for_all(n, [&](std::size_t i) { p.position[i] = box.wrapped(p.position[i]); });
    std::copy_n(p.position.begin(), n, p.position_at_build.begin());
    find_neighbours();
  }
  fill_images();
}

template <int Dim>
void Body<Dim>::restore_neighbours() {
  find_neighbours();
  fill_images();
}

template <int Dim>
void Body<Dim>::fill_images() {
  if (images.empty()) return;
  has_run(Module::images);
  images.fill_positions(particles.position);
  images.fill_velocities(particles.velocity);
  images.fill_positions(particles.reference_position);
  images.fill_tensors(particles.deformation_gradient);
  images.fill(particles.mass);
  images.fill(particles.density);
  images.fill(particles.sound_speed);
}

template <int Dim>
CorrectionView<Dim> Body<Dim>::correction() {
  if (in_reference_frame()) return view_of_correction();
  if (scheme.correction != Correction::none || !layers.empty()) find_volumes(0.0);
  make_correction();
  return view_of_correction();
}

template <int Dim>
void Body<Dim>::find_volumes(double ahead) {
  const Particles<Dim>& p = particles;
  const auto n = static_cast<std::int64_t>(p.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    volume_[i] = p.mass[i] / (p.density[i] + ahead * p.density_rate[i]);
  }
  images.fill(volume_);
}

template <int Dim>
void Body<Dim>::make_correction() {
  if (scheme.correction == Correction::linear) kernel_correction<Dim>(stencil(), volume_, linear_, scheme.least_span);
  if constexpr (Dim == 2)
    if (scheme.correction == Correction::quadratic) quadratic_correction<Dim>(stencil(), volume_, quadratic_);
}

template <int Dim>
CorrectionView<Dim> Body<Dim>::view_of_correction() const {
  switch (scheme.correction) {
    case Correction::none: return std::monostate{};
    case Correction::linear: return std::span<const Matrix<Dim>>(linear_);
    case Correction::quadratic: return std::span<const QuadraticGradient<Dim>>(quadratic_);
  }
  throw std::logic_error("unknown correction");
}

template <int Dim>
void Body<Dim>::plain_velocity_gradient(double dt) {
  const Particles<Dim>& p = particles;
  if (!scheme.dual_gradient)
    return furrow::velocity_gradient<Dim>(stencil(), volume_, p.velocity, linear(), velocity_gradient_);
  // L_i = 1/rho_i sum_j m_j (v_j - v_i) (x) grad_i W_ij, whose power with the stress is that of Eqs 8 and 10 whatever the densities.
  furrow::velocity_gradient<Dim>(stencil(), p.mass, p.velocity, {}, velocity_gradient_);
  for_all(p.size(), [&](std::size_t i) { velocity_gradient_[i] /= p.density[i] + 0.5 * dt * p.density_rate[i]; });
}

template <int Dim>
double Body<Dim>::respond(double dt, std::int64_t step) {
  Particles<Dim>& p = particles;
  const Stencil<Dim> s = stencil();
  lend_velocities(p.velocity, false);
  if (keeps_pairs()) {
    images.fill_velocities(p.velocity);
    if (keeps_weights())
      reference_gradient<Dim>(s, weights_, p.velocity, linear(), gradient_rate_);
    else if constexpr (Dim == 2)
      quadratic_reference_gradient(s, pair_gradients_, p.velocity, gradient_rate_);
    if (neighbour_strain) neighbour_strain(std::span(gradient_rate_).first(p.size()));
    return respond_in_reference(dt);
  }
  // Seen from the middle of the step, where positions are already: a volume from its beginning would cost an order.
  if (!in_reference_frame()) find_volumes(0.5 * dt);
  if (scheme.correction == Correction::linear && !in_reference_frame()) {
    corrected_velocity_gradient<Dim>(s, volume_, p.velocity, scheme.least_span, linear_, velocity_gradient_);
  } else if (scheme.correction != Correction::quadratic) {
    plain_velocity_gradient(dt);
  } else if constexpr (Dim == 2) {
    if (!in_reference_frame()) make_correction();
    quadratic_velocity_gradient<Dim>(s, volume_, p.velocity, quadratic_, velocity_gradient_);
  }
  return_velocities(p.velocity);
  if (neighbour_strain) neighbour_strain(velocity_gradient_);
  for (const BoundaryLayer<Dim>& layer : layers)   // layers do not strain
    for (const std::int32_t id : layer.ids) velocity_gradient_[index_of(id)].setZero();

  if (in_reference_frame()) {
    std::copy_n(velocity_gradient_.begin(), p.size(), gradient_rate_.begin());
    return respond_in_reference(dt);
  }

  const bool shepard = scheme.density == DensityEquation::shepard ||
                       (scheme.shepard_every > 0 && step % scheme.shepard_every == scheme.shepard_every - 1);
  if (shepard || scheme.density == DensityEquation::summation) density_before_.assign(p.density.begin(), p.density.end());
  if (scheme.density == DensityEquation::continuity) {
    const auto n = static_cast<std::int64_t>(p.size());
#pragma omp parallel for schedule(static)
    for (std::int64_t k = 0; k < n; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const double before = p.density[i];
      p.density[i] *= std::exp(-velocity_gradient_[i].trace() * dt);
      p.density_rate[i] = (p.density[i] - before) / dt;
    }
  } else if (scheme.density == DensityEquation::summation) {
    summation_density<Dim>(s, p.mass, p.density);
  }
  if (shepard) {
    if (!images.empty()) images.fill(p.density);
    density_before_.assign(p.density.begin(), p.density.end());
    shepard_density<Dim>(s, p.mass, density_before_, p.density);
  }

  has_run(Module::jaumann_rate);
  for_each_part(material, has_run);
  return std::visit(
      [&](const auto& law) {
        double compression = 0.0;
        const auto n = static_cast<std::int64_t>(p.size());
#pragma omp parallel for schedule(static) reduction(max : compression)
        for (std::int64_t k = 0; k < n; ++k) {
          const auto i = static_cast<std::size_t>(k);
          if (is_in_layer(i)) continue;
          const Matrix<Dim> L_i = velocity_gradient_[i];
          const Tensor L = embed<Dim>(L_i);
          const MaterialState next = turn_and_respond(law, state(i), {symmetric_part(L) * dt, skew_part(L) * dt, dt});
          set_state(i, next);
          const Matrix<Dim> half = 0.5 * dt * L_i, I = Matrix<Dim>::Identity();
          p.deformation_gradient[i] = (I - half).inverse() * (I + half) * p.deformation_gradient[i];
          p.sound_speed[i] = law.sound_speed(next);
          compression = std::max(compression, -L_i.trace());
        }
        return compression;
      },
      material);
}

template <int Dim>
void Body<Dim>::prescribe(double time, std::span<Vector<Dim>> velocity) const {
  for (const PrescribedMotion<Dim>& motion : loads.motions) {
    has_run(Module::prescribed_motion);
    const Vector<Dim> v = motion.velocity(time);
    for (const std::int32_t id : motion.ids) velocity[index_of(id)] = v;
  }
  for (const BoundaryLayer<Dim>& layer : layers) {
    const Vector<Dim> v = layer.velocity(time);
    for (const std::int32_t id : layer.ids) velocity[index_of(id)] = v;
  }
}

template <int Dim>
double Body<Dim>::prescribed_kinetic_energy(double time) const {
  double energy = 0.0;
  for (const PrescribedMotion<Dim>& motion : loads.motions) {
    double mass = 0.0;
    for (const std::int32_t id : motion.ids) mass += particles.mass[index_of(id)];
    energy += 0.5 * mass * motion.velocity(time).squaredNorm();
  }
  return energy;
}

template class Body<2>;
template class Body<3>;

}  // namespace furrow
