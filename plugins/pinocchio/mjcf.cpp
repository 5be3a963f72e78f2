// What is looked up in an MJCF: gravity, and what the library would pass over in silence.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

#include "xml.hpp"

namespace switchyard::dynamics {
namespace {

using tinyxml2::XMLElement;

// Forces that inverse dynamics would lack.
struct Force {
  std::string_view element;
  const char* attribute;
  std::string_view what;
};
constexpr std::array kForces = {
    Force{"joint", "stiffness", "a spring"},
    Force{"joint", "springdamper", "a spring"},
    Force{"body", "gravcomp", "compensation of gravity"},
    Force{"option", "density", "a fluid"},
    Force{"option", "viscosity", "a fluid"},
};

// What stands in a body and is read, or is no matter of dynamics.
constexpr std::array<std::string_view, 10> kInBodies = {"body",     "joint",   "freejoint", "geom",
                                                        "inertial", "site",    "camera",    "light",
                                                        "plugin",   "flexcomp"};

std::string Tag(std::string_view name) { return std::string("<").append(name).append(">"); }

bool IsOn(const std::string& numbers) {
  std::istringstream stream(numbers);
  for (double value = 0; stream >> value;) {
    if (value != 0.0) return true;
  }
  return false;
}

void CheckForces(const Description& d, const XMLElement& e) {
  for (const Force& force : kForces) {
    if (e.Name() == force.element && IsOn(Attribute(e, force.attribute))) {
      std::string text = "<";
      text.append(e.Name()).append(" ").append(force.attribute).append("=");
      text.append(Quoted(Attribute(e, force.attribute))).append("> is ").append(force.what);
      Refuse(d, e.GetLineNum(), text + ", which is no part of the dynamics here", SY_E_UNSUPPORTED);
    }
  }
}

void CheckPlace(const Description& d, const XMLElement& e) {
  const XMLElement* parent = e.Parent() != nullptr ? e.Parent()->ToElement() : nullptr;
  const std::string_view name = e.Name();
  const std::string_view within = parent != nullptr ? parent->Name() : "";
  const auto refuse = [&](const std::string& text) {
    Refuse(d, e.GetLineNum(), text, SY_E_UNSUPPORTED);
  };
  if (name == "include") refuse("<include> is not taken: a model is one file");
  if ((within == "body" || within == "worldbody") &&
      std::find(kInBodies.begin(), kInBodies.end(), name) == kInBodies.end()) {
    refuse(Tag(name) + " in a body is not taken");
  }
  if (within == "equality" && Attribute(e, "active") != "false") {
    refuse(Tag(name) + " of <equality> is not taken: bodies and joints are a tree");
  }
  const std::string type = name == "freejoint" ? "free" : Attribute(e, "type");
  if ((name == "joint" || name == "freejoint") && (type == "free" || type == "ball")) {
    const std::string called = Attribute(e, "name");
    refuse((called.empty() ? "a joint" : "joint " + Quoted(called)) + " is " + type +
           "; hinge and slide joints are taken");
  }
}

// The library would make one joint of them.
void CheckJoints(const Description& d, const XMLElement& body) {
  int joints = 0;
  for (const XMLElement* e = body.FirstChildElement("joint"); e != nullptr;
       e = e->NextSiblingElement("joint")) {
    ++joints;
  }
  if (joints < 2) return;
  Refuse(d, body.GetLineNum(),
         "body " + Quoted(Attribute(body, "name")) + " has " + std::to_string(joints) +
             " joints; a body is taken with one at most",
         SY_E_UNSUPPORTED);
}

void CheckClass(const Description& d, const XMLElement& e, const std::set<std::string>& classes) {
  for (const char* attribute : {"class", "childclass"}) {
    const std::string name = Attribute(e, attribute);
    if (name.empty() || classes.count(name) != 0) continue;
    Refuse(d, e.GetLineNum(), "there is no class " + Quoted(name));
  }
}

void Check(const Description& d, const XMLElement& top, const std::set<std::string>& classes) {
  CheckForces(d, top);
  CheckPlace(d, top);
  CheckClass(d, top, classes);
  if (std::string_view(top.Name()) == "body") {
    CheckJoints(d, top);
    if (Attribute(top, "name").empty()) Refuse(d, top.GetLineNum(), "a body has no name");
  }
  for (const XMLElement* e = top.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    Check(d, *e, classes);  // as deep as the parser lets elements nest, 500
  }
}

// Of <default> elements, one within another.
void AddClasses(const XMLElement& within, std::set<std::string>& classes) {
  for (const XMLElement* e = within.FirstChildElement("default"); e != nullptr;
       e = e->NextSiblingElement("default")) {
    const std::string name = Attribute(*e, "class");
    classes.insert(name.empty() ? "main" : name);
    AddClasses(*e, classes);
  }
}

}  // namespace

void DescribeMjcf(const void* document, Description& d) {
  const XMLElement& root = *static_cast<const tinyxml2::XMLDocument*>(document)->RootElement();
  const XMLElement* world = root.FirstChildElement("worldbody");
  if (world == nullptr || world->FirstChildElement("body") == nullptr) {
    Refuse(d, (world != nullptr ? world : &root)->GetLineNum(), "there is no body in <worldbody>");
  }
  std::set<std::string> classes;
  AddClasses(root, classes);
  Check(d, root, classes);
  for (const XMLElement* option = root.FirstChildElement("option"); option != nullptr;
       option = option->NextSiblingElement("option")) {
    if (option->Attribute("gravity") == nullptr) continue;
    std::istringstream stream(option->Attribute("gravity"));
    for (double& component : d.gravity) {
      if (!(stream >> component) || !std::isfinite(component)) {
        Refuse(d, option->GetLineNum(),
               "gravity is " + Quoted(option->Attribute("gravity")) + ", not three numbers");
      }
    }
  }
}

}  // namespace switchyard::dynamics
