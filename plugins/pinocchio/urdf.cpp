// What is looked up in a URDF: the joints, which it takes and which follow others, and their order.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "xml.hpp"

namespace switchyard::dynamics {
namespace {

using tinyxml2::XMLElement;

std::string Linked(const XMLElement& joint, const char* end) {
  const XMLElement* element = joint.FirstChildElement(end);
  return element != nullptr ? Attribute(*element, "link") : "";
}

// <joint> of <robot>; those in <transmission> and <gazebo> are others.
DescribedJoint Read(const Description& d, const XMLElement& element,
                    const std::set<std::string>& links) {
  DescribedJoint joint;
  const int line = element.GetLineNum();
  joint.name = Attribute(element, "name");
  if (joint.name.empty()) Refuse(d, line, "a joint has no name");
  const std::string called = "joint " + Quoted(joint.name);
  const std::string type = Attribute(element, "type");
  if (type.empty()) Refuse(d, line, called + " has no type");
  joint.moves = type != "fixed";
  if (joint.moves && type != "revolute" && type != "continuous" && type != "prismatic") {
    Refuse(d, line,
           called + " is " + type + "; revolute, continuous, prismatic and fixed joints are taken",
           SY_E_UNSUPPORTED);
  }
  joint.parent = Linked(element, "parent");
  joint.child = Linked(element, "child");
  for (const auto& [end, link] : {std::pair("parent", joint.parent), {"child", joint.child}}) {
    if (links.count(link) == 0) {
      Refuse(d, line,
             called + (link.empty() ? std::string(" names no ") + end + " link"
                                    : std::string(" has the ") + end + " link " + Quoted(link) +
                                          ", which is not there"));
    }
  }
  if (const XMLElement* mimic = element.FirstChildElement("mimic"); mimic != nullptr) {
    joint.mimic = Mimic{Attribute(*mimic, "joint"), Number(d, *mimic, "multiplier", 1.0),
                        Number(d, *mimic, "offset", 0.0)};
  }
  return joint;
}

// Depth first; a joint is left out where no root leads to it, which the library then complains of.
std::vector<DescribedJoint> FromTheRoot(const std::vector<DescribedJoint>& joints) {
  std::map<std::string, std::vector<std::size_t>> below;  // by link
  std::set<std::string> carried;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    below[joints[i].parent].push_back(i);
    carried.insert(joints[i].child);
  }
  std::vector<std::size_t> open;
  const auto push = [&](const std::string& link) {
    const auto found = below.find(link);
    if (found == below.end()) return;
    open.insert(open.end(), found->second.rbegin(), found->second.rend());
    below.erase(found);
  };
  std::vector<DescribedJoint> sorted;
  for (const DescribedJoint& joint : joints) {
    if (carried.count(joint.parent) == 0) push(joint.parent);
    while (!open.empty()) {
      sorted.push_back(joints[open.back()]);
      open.pop_back();
      push(sorted.back().child);
    }
  }
  return sorted;
}

}  // namespace

void DescribeUrdf(const void* document, Description& d) {
  const XMLElement& robot = *static_cast<const tinyxml2::XMLDocument*>(document)->RootElement();
  std::set<std::string> links;
  for (const XMLElement* e = robot.FirstChildElement("link"); e != nullptr;
       e = e->NextSiblingElement("link")) {
    const std::string name = Attribute(*e, "name");
    if (!links.insert(name).second) {
      Refuse(d, e->GetLineNum(), "a second link is called " + Quoted(name));
    }
  }
  std::vector<DescribedJoint> joints;
  std::set<std::string> names;
  for (const XMLElement* e = robot.FirstChildElement("joint"); e != nullptr;
       e = e->NextSiblingElement("joint")) {
    joints.push_back(Read(d, *e, links));
    if (!names.insert(joints.back().name).second) {
      Refuse(d, e->GetLineNum(), "a second joint is called " + Quoted(joints.back().name));
    }
  }
  d.joints = FromTheRoot(joints);
}

}  // namespace switchyard::dynamics
