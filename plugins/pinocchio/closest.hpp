#pragma once

#include <coal/distance.h>

#include <Eigen/Core>

namespace switchyard::dynamics {

struct Closest {
  double distance = 0.0;  // negative where the shapes meet: by how much they must be moved apart
  Eigen::Vector3d on_first, on_second;
  Eigen::Vector3d normal;  // from the first to the second, also where they meet
};

/// The distance of two convex shapes, by GJK, and by EPA where they meet. The answer depends on the
/// two poses alone, not on what was asked before.
class PairDistance {
 public:
  PairDistance(const coal::CollisionGeometry& first, const coal::CollisionGeometry& second);

  Closest operator()(const coal::Transform3s& first, const coal::Transform3s& second);

 private:
  coal::ComputeDistance compute_;
  bool round_;
  coal::DistanceResult found_, again_;
};

}  // namespace switchyard::dynamics
