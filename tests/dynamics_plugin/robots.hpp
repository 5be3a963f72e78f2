// Robots as text.
#pragma once

#include <string>

namespace switchyard::dynamics_plugin {

/// A URDF link: mass at (x, 0, z) with inertia about its own centre, no products.
inline std::string Link(const std::string& name, double mass, double x, double inertia,
                        const std::string& more = "") {
  const std::string i = std::to_string(inertia);
  return "<link name=\"" + name + "\"><inertial><origin xyz=\"" + std::to_string(x) +
         " 0 0\"/><mass value=\"" + std::to_string(mass) + "\"/><inertia ixx=\"" + i + "\" iyy=\"" +
         i + "\" izz=\"" + i + "\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>" + more + "</link>\n";
}

inline std::string Joint(const std::string& name, const std::string& type,
                         const std::string& parent, const std::string& child,
                         const std::string& origin, const std::string& axis,
                         const std::string& more = "") {
  const std::string limit =
      type == "fixed" ? "" : "<limit lower=\"-3\" upper=\"2.5\" velocity=\"7\" effort=\"40\"/>";
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/><origin xyz=\"" + origin +
         "\" rpy=\"0 0 0\"/><axis xyz=\"" + axis + "\"/>" + limit + more + "</joint>\n";
}

inline std::string Robot(const std::string& content) {
  return "<robot name=\"robot\">\n" + content + "</robot>\n";
}

/// Two bars of 0.8 m and 0.6 m that swing about -y: at q = 0 both point along x, and at (pi/2, 0)
/// up.
inline std::string TwoLinkPendulum(const std::string& of_joints = "") {
  return Robot("<link name=\"base\"/>\n" + Link("upper", 2.0, 0.3, 0.05) +
               Link("lower", 1.5, 0.25, 0.03) + "<link name=\"tip\"/>\n" +
               Joint("shoulder", "revolute", "base", "upper", "0 0 0", "0 -1 0", of_joints) +
               Joint("elbow", "revolute", "upper", "lower", "0.8 0 0", "0 -1 0", of_joints) +
               Joint("end", "fixed", "lower", "tip", "0.6 0 0", "1 0 0"));
}

/// A tree of every kind of joint, with axes and origins that are nowhere aligned.
inline std::string Branched() {
  const std::string damped = "<dynamics damping=\"0.3\" friction=\"0.2\"/>";
  return Robot("<link name=\"base\"/>\n" + Link("a", 2.0, 0.3, 0.05) + Link("b", 1.5, 0.2, 0.04) +
               Link("c", 1.0, -0.1, 0.02) + Link("d", 0.7, 0.15, 0.01) + Link("e", 0.5, 0.1, 0.01) +
               Joint("turn", "continuous", "base", "a", "0.1 0 0.2", "0.2 0.1 1", damped) +
               Joint("zigzag", "prismatic", "a", "b", "0.3 0.1 0", "1 0.5 -0.3", damped) +
               Joint("bend", "revolute", "a", "c", "0 0.4 0.1", "0 1 0") +
               Joint("spin", "continuous", "c", "d", "0.1 0.2 0.3", "0 0 1") +
               Joint("lift", "prismatic", "d", "e", "0 0 0.3", "0 0 1", damped));
}

}  // namespace switchyard::dynamics_plugin
