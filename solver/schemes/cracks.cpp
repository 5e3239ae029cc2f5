#include "solver/schemes/cracks.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>

#include "solver/modules.hpp"
#include "solver/tensor/lanes.hpp"

namespace furrow {

template <int Dim>
bool CrackFacet<Dim>::separates(const Vector<Dim>& a, const Vector<Dim>& b) const {
  const double from = (a - centre).dot(normal), to = (b - centre).dot(normal);
  if ((from > 0.0) == (to > 0.0)) return false;
  const Vector<Dim> crossing = a + from / (from - to) * (b - a);
  return (crossing - centre).squaredNorm() <= radius * radius;
}

template <int Dim>
Vector<Dim> most_stretched(const Matrix<Dim>& F) {
  const Eigen::SelfAdjointEigenSolver<Matrix<Dim>> solver(F.transpose() * F);
  Vector<Dim> n = solver.eigenvectors().col(Dim - 1);
  Eigen::Index largest;
  n.cwiseAbs().maxCoeff(&largest);
  if (n[largest] < 0.0) n = -n;
  return n;
}

template <int Dim>
std::vector<CrackFacet<Dim>> crack_facets(const Particles<Dim>& p, double spacing) {
  std::vector<CrackFacet<Dim>> facets;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (const Vector<Dim>& n = p.crack_normal[i]; !n.isZero(0.0))
      facets.push_back({p.reference_position[i] + 0.5 * spacing * n, n, 0.55 * spacing});
  return facets;
}

namespace {

/// Leaves out of the list the pairs that are not to be kept.
template <class Keep>
void filter(NeighbourList& list, Keep&& keep) {
  std::int64_t end = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::int64_t first = list.begin[i], start = end;
    const std::int32_t pairs = list.count[i];
    list.begin[i] = start;
    for (std::int32_t k = 0; k < pairs; ++k) {
      // Rows only move towards the front: what is read here has not been written yet.
      const std::int32_t j = list.index[static_cast<std::size_t>(first + k)];
      if (keep(i, static_cast<std::size_t>(j))) list.index[static_cast<std::size_t>(end++)] = j;
    }
    list.count[i] = static_cast<std::int32_t>(end - start);
    while ((end - start) % lane_count != 0) list.index[static_cast<std::size_t>(end++)] = static_cast<std::int32_t>(i);
  }
  list.begin[list.size()] = end;
  list.index.resize(static_cast<std::size_t>(end));
}

}  // namespace

template <int Dim>
void cut_pairs(NeighbourList& list, std::span<const Vector<Dim>> x, const std::vector<CrackFacet<Dim>>& facets) {
  if (facets.empty()) return;
  has_run(Module::cracks);
  filter(list, [&](std::size_t i, std::size_t j) {
    return std::none_of(facets.begin(), facets.end(), [&](const auto& facet) { return facet.separates(x[i], x[j]); });
  });
}

template <int Dim>
void drop_debris(NeighbourList& list, const Particles<Dim>& p) {
  // Images behind the particles proper are taken for whole.
  const auto has_failed = [&p](std::size_t i) { return i < p.size() && !p.crack_normal[i].isZero(0.0); };
  std::vector<std::uint8_t> debris(list.size(), 0);
  bool any = false;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto row = list.row(i);
    const bool alone = std::all_of(row.begin(), row.end(), [&](std::int32_t j) { return has_failed(static_cast<std::size_t>(j)); });
    debris[i] = has_failed(i) && alone;
    any = any || debris[i];
  }
  if (any) filter(list, [&](std::size_t i, std::size_t j) { return !debris[i] && !(j < debris.size() && debris[j]); });
}

#define FURROW_INSTANTIATE(Dim)                                                                          \
  template struct CrackFacet<Dim>;                                                                       \
  template Vector<Dim> most_stretched<Dim>(const Matrix<Dim>&);                                          \
  template std::vector<CrackFacet<Dim>> crack_facets<Dim>(const Particles<Dim>&, double);                \
  template void cut_pairs<Dim>(NeighbourList&, std::span<const Vector<Dim>>, const std::vector<CrackFacet<Dim>>&); \
  template void drop_debris<Dim>(NeighbourList&, const Particles<Dim>&);
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
