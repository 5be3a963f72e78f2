#include "closest.hpp"

#include <cmath>
#include <utility>

#include "switchyard/plugin.hpp"

namespace switchyard::dynamics {
namespace {

// Neither a polyhedron nor one with a ball moved along it.
bool IsRound(const coal::CollisionGeometry& shape) {
  const coal::NODE_TYPE type = shape.getNodeType();
  return type == coal::GEOM_CYLINDER || type == coal::GEOM_CONE || type == coal::GEOM_ELLIPSOID;
}

}  // namespace

PairDistance::PairDistance(const coal::CollisionGeometry& first,
                           const coal::CollisionGeometry& second)
    : compute_(&first, &second), round_(IsRound(first) || IsRound(second)) {}

// GJK is not precise below the tolerance of 1e-6, at which the normals of round shapes are 1e-3 off
// by the default criterion, 1e-5 by the gap to the dual and a second and third start from what was
// found; of polyhedra all are exact.
Closest PairDistance::operator()(const coal::Transform3s& first, const coal::Transform3s& second) {
  coal::DistanceRequest request;
  request.enable_signed_distance = true;
  request.gjk_convergence_criterion = coal::GJKConvergenceCriterion::DualityGap;
  request.gjk_max_iterations = 1000;
  request.epa_max_iterations = 256;
  request.gjk_initial_guess = coal::GJKInitialGuess::CachedGuess;
  request.cached_gjk_guess = -first.inverseTimes(second).getTranslation();
  if (request.cached_gjk_guess.norm() < 1e-9) request.cached_gjk_guess = coal::Vec3s(1, 0, 0);
  request.cached_support_func_guess.setZero();
  found_.clear();
  compute_(first, second, request, found_);
  for (int start = 0; start < 2 && round_ && found_.min_distance > 0.0; ++start) {
    request.cached_gjk_guess = found_.cached_gjk_guess;
    request.cached_support_func_guess = found_.cached_support_func_guess;
    again_.clear();
    compute_(first, second, request, again_);
    const double gain = found_.min_distance - again_.min_distance;
    if (!(gain > 0.0)) break;
    std::swap(found_, again_);
    if (gain < 1e-13) break;
  }
  if (!std::isfinite(found_.min_distance) || !found_.normal.allFinite()) {
    throw plugin::Failure(SY_E_INTERNAL, "GJK found no distance");
  }
  return {found_.min_distance, found_.nearest_points[0], found_.nearest_points[1], found_.normal};
}

}  // namespace switchyard::dynamics
