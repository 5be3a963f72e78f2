// switchyard/dynamics/model_functions.hpp - what a rigid-body model computes, as functions of q
// (and v and a) with exact derivatives.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "switchyard/dynamics/rigid_body_model.hpp"
#include "switchyard/functions/function.hpp"

namespace switchyard {

/// The efforts of some joints, in this order, of (q, v, a): R^{3n} -> R^{joints}. Throws where an
/// index is no joint.
SWITCHYARD_EXPORT std::shared_ptr<const Function> InverseDynamicsFunction(
    const RigidBodyModel& model, std::vector<int> joints);

/// of_position'o + tr(of_rotation' R) + constant, for a frame with origin o and axes R.
struct PoseRow {
  Eigen::Vector3d of_position = Eigen::Vector3d::Zero();
  Eigen::Matrix3d of_rotation = Eigen::Matrix3d::Zero();
  double constant = 0;
};

/// Rows affine in the pose of a frame, of q. Throws where the frame is none.
///
/// With v_i and w_i the velocities of origin and axes by joint i, joint i before joint j on the way
/// from the root to the frame (or i = j):
///
///   do/dq_i = v_i      d^2 o / dq_i dq_j = w_i x v_j
///   dR/dq_i = [w_i] R  d^2 R / dq_i dq_j = [w_i] [w_j] R
///
/// since joint i carries along all that comes after it. Of joints beside that way both are 0. Where
/// a coordinate moves several joints of the way (one that mimics another) there are no second
/// derivatives.
SWITCHYARD_EXPORT std::shared_ptr<const Function> FrameFunction(const RigidBodyModel& model,
                                                                int frame,
                                                                std::vector<PoseRow> rows);

/// The distances of some pairs, of q. Gradients come with them; second derivatives are differences
/// of gradients (a distance has none where the nearest points jump from one face to another: there
/// those to one side of q), good to 1e-8 where shapes are smooth. Throws where an index is no pair.
SWITCHYARD_EXPORT std::shared_ptr<const Function> DistanceFunction(const RigidBodyModel& model,
                                                                   std::vector<int> pairs);

}  // namespace switchyard
