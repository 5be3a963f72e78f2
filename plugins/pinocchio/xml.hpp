// Reading an XML document by its elements, with the line in every complaint.
#pragma once

#include <tinyxml2.h>

#include <string>

#include "description.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard::dynamics {

inline std::string Quoted(const std::string& name) { return "\"" + name + "\""; }

[[noreturn]] inline void Refuse(const Description& d, int line, const std::string& text,
                                sy_status code = SY_E_ARGUMENT) {
  throw plugin::Failure(code, d.origin + ":" + std::to_string(line) + ": " + text);
}

/// The attribute's text; empty where it is absent.
inline std::string Attribute(const tinyxml2::XMLElement& element, const char* name) {
  const char* text = element.Attribute(name);
  return text != nullptr ? text : "";
}

/// The attribute as a number, or `absent`.
inline double Number(const Description& d, const tinyxml2::XMLElement& element, const char* name,
                     double absent) {
  double value = absent;
  if (element.QueryDoubleAttribute(name, &value) == tinyxml2::XML_WRONG_ATTRIBUTE_TYPE) {
    Refuse(d, element.GetLineNum(),
           std::string(name) + " is " + Quoted(Attribute(element, name)) + ", no number");
  }
  return value;
}

}  // namespace switchyard::dynamics
