// Which joints of a URDF follow others, to the end of each chain.
#include <cmath>
#include <map>
#include <string>

#include "description.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard::dynamics {

std::map<std::string, Mimic> Followers(const Description& d) {
  std::map<std::string, bool> moves;
  std::map<std::string, Mimic> followers;
  for (const DescribedJoint& joint : d.joints) {
    moves[joint.name] = joint.moves;
    if (joint.moves && joint.mimic) followers[joint.name] = *joint.mimic;
  }
  for (auto& [name, mimic] : followers) {
    const auto refuse = [&](const std::string& text) {
      throw plugin::Failure(SY_E_ARGUMENT, d.origin + ": joint \"" + name + "\" mimics \"" +
                                               mimic.joint + "\"" + text);
    };
    if (!std::isfinite(mimic.factor) || !std::isfinite(mimic.offset)) {
      refuse(" by a number that is not finite");
    }
    const auto found = moves.find(mimic.joint);
    if (found == moves.end()) refuse(", which is not there");
    if (!found->second) refuse(", which is fixed");
  }
  for (auto& [name, mimic] : followers) {
    for (std::size_t steps = 0; followers.count(mimic.joint) != 0; ++steps) {
      const Mimic& next = followers.at(mimic.joint);
      if (steps == followers.size() || next.joint == name || mimic.joint == name) {
        throw plugin::Failure(SY_E_ARGUMENT,
                              d.origin + ": joint \"" + name + "\" mimics itself in the end");
      }
      mimic = {next.joint, mimic.factor * next.factor, mimic.factor * next.offset + mimic.offset};
    }
  }
  return followers;
}

}  // namespace switchyard::dynamics
