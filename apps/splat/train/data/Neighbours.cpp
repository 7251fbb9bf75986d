#include "train/data/Neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nanoflann.hpp>

namespace vorion::splat {
namespace {

// NOLINTBEGIN(readability-identifier-naming): nanoflann's names.

/// The points, as nanoflann reads them.
struct Points {
  const std::vector<float> &Positions;

  std::size_t kdtree_get_point_count() const { return Positions.size() / 3; }
  double kdtree_get_pt(std::size_t Point, std::size_t Axis) const {
    return Positions[3 * Point + Axis];
  }
  template <typename Box> bool kdtree_get_bbox(Box & /*Result*/) const {
    return false; // nanoflann finds it
  }
};

/// Squared distances in double. Those to the sides of boxes, by which branches
/// are left out, are less by more than rounding, so that none is left out
/// wrongly.
struct Squares : nanoflann::L2_Simple_Adaptor<double, Points> {
  using L2_Simple_Adaptor::L2_Simple_Adaptor;
  static double accum_dist(double A, double B, std::size_t /*Axis*/) {
    return (A - B) * (A - B) * (1 - 1e-12);
  }
};

/// The nearest ones so far. Nothing is nearer than distance 0, so that many
/// points in one place are not all gone through for each of them.
struct NearestSet : nanoflann::KNNResultSet<double, uint32_t> {
  using KNNResultSet::KNNResultSet;
  double worstDist() const {
    const double Worst = KNNResultSet::worstDist();
    return Worst > 0 ? Worst : -1;
  }
};

// NOLINTEND(readability-identifier-naming)

} // namespace

std::vector<double> meanNeighbourDistances(const std::vector<float> &Positions,
                                           std::size_t Count) {
  const Points P{Positions};
  const std::size_t N = P.kdtree_get_point_count();
  const std::size_t Wanted = std::min(Count, N > 0 ? N - 1 : 0);
  std::vector<double> Means(N, 0);
  if (Wanted == 0)
    return Means;
  const nanoflann::KDTreeSingleIndexAdaptor<Squares, Points, 3> Tree(3, P);
  // The nearest one is the point itself, or one that coincides with it.
  std::vector<uint32_t> Nearest(Wanted + 1);
  std::vector<double> Distances(Wanted + 1);
  for (std::size_t I = 0; I < N; ++I) {
    const std::array Here{P.kdtree_get_pt(I, 0), P.kdtree_get_pt(I, 1),
                          P.kdtree_get_pt(I, 2)};
    NearestSet Set(Wanted + 1);
    Set.init(Nearest.data(), Distances.data());
    Tree.findNeighbors(Set, Here.data(), {});
    for (std::size_t K = 1; K <= Wanted; ++K)
      Means[I] += std::sqrt(Distances[K]);
    Means[I] /= static_cast<double>(Wanted);
  }
  return Means;
}

} // namespace vorion::splat
