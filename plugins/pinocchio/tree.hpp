// The robot as Pinocchio holds it. Its headers take half a minute to compile: read.cpp, load.cpp
// and dynamics.cpp alone include this one.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "description.hpp"
#include "pinocchio/geometry.hpp"
#include "pinocchio/multibody.hpp"
#include "switchyard/dynamics.h"

namespace switchyard::dynamics {

/// A joint of Pinocchio's model, by a coordinate: its angle or length is factor q_i + offset, which
/// a continuous joint holds as (cos, sin). Each joint has one velocity: joint j's is v_{j - 1}.
struct Follows {
  int coordinate = 0;  // i
  double factor = 1.0;
  double offset = 0.0;
  int first = 0;  // of Pinocchio's configuration
  bool on_circle = false;
};

struct Tree {
  pinocchio::Model model;  // locked joints are welded
  pinocchio::GeometryModel geometry;
  std::vector<Follows> joints;  // of model.joints, without the universe at 0
  std::vector<sy_joint> coordinates;
  std::vector<std::string> names;  // of the coordinates
};

/// Builds model and, where asked for, geometry. Throws plugin::Failure.
void ReadTree(const Description& description, const sy_dynamics_source& source, Tree& tree);

/// Throws plugin::Failure.
Tree LoadTree(const sy_dynamics_source& source);

}  // namespace switchyard::dynamics
