#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "switchyard/dynamics.h"

namespace switchyard::dynamics {

/// One joint follows another: q = factor q_joint + offset.
struct Mimic {
  std::string joint;
  double factor = 1.0;
  double offset = 0.0;
};

struct DescribedJoint {
  std::string name;
  std::string parent;  // link
  std::string child;   // link
  bool moves = true;
  std::optional<Mimic> mimic;
};

/// A file as it was read, and what is looked up in it before the library sees it.
struct Description {
  sy_model_format format = SY_MODEL_URDF;
  std::string text;
  std::string path;    // empty where the text came alone
  std::string origin;  // what errors call it
  std::array<double, 3> gravity = {0.0, 0.0, -9.81};
  std::vector<DescribedJoint> joints;  // of a URDF, from the root outwards, branches as in the file
};

/// Reads the file or the text. Throws plugin::Failure for what is not there, not well-formed, or
/// would be dropped or misunderstood further on: with the line where it stands.
Description Describe(const sy_dynamics_source& source);

/// The joints that follow others, each with the one at the end of its chain, which follows none.
/// Throws plugin::Failure.
std::map<std::string, Mimic> Followers(const Description& description);

/// What urdf.cpp and mjcf.cpp know of their formats; `document` is a tinyxml2::XMLDocument.
void DescribeUrdf(const void* document, Description& description);
void DescribeMjcf(const void* document, Description& description);

}  // namespace switchyard::dynamics
