#include "description.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>

#include "xml.hpp"

namespace switchyard::dynamics {
namespace {

using plugin::Failure;

constexpr std::size_t kMostBytes = std::size_t{1} << 28;

std::string FormatName(sy_model_format format) { return format == SY_MODEL_URDF ? "URDF" : "MJCF"; }

std::string Content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Failure(SY_E_RESOURCE, path + ": " + std::strerror(errno));
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (file.bad() || text.empty()) throw Failure(SY_E_RESOURCE, path + ": nothing can be read");
  return text;
}

// "XML_ERROR_MISMATCHED_ELEMENT" -> "mismatched element"
std::string Words(std::string name) {
  const std::string prefix = "XML_ERROR_";
  if (name.starts_with(prefix)) name.erase(0, prefix.size());
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) {
    return c == '_' ? ' ' : static_cast<char>(std::tolower(c));
  });
  return name;
}

void Parse(const Description& d, tinyxml2::XMLDocument& document) {
  if (d.text.size() > kMostBytes) {
    throw Failure(SY_E_RESOURCE, d.origin + ": more than " + std::to_string(kMostBytes) + " bytes");
  }
  if (document.Parse(d.text.data(), d.text.size()) != tinyxml2::XML_SUCCESS) {
    Refuse(d, std::max(1, document.ErrorLineNum()),
           "not well-formed XML: " + Words(document.ErrorName()));
  }
  const std::string needed = d.format == SY_MODEL_URDF ? "robot" : "mujoco";
  const tinyxml2::XMLElement* root = document.RootElement();
  if (root == nullptr) Refuse(d, 1, "there is no element, <" + needed + "> is needed");
  if (root->Name() != needed) {
    Refuse(d, root->GetLineNum(),
           std::string("the root is <") + root->Name() + ">, that of " + FormatName(d.format) +
               " is <" + needed + ">");
  }
}

}  // namespace

Description Describe(const sy_dynamics_source& source) {
  if (source.format != SY_MODEL_URDF && source.format != SY_MODEL_MJCF) {
    throw Failure(SY_E_ARGUMENT, "format " + std::to_string(source.format) +
                                     " is not known: SY_MODEL_URDF is 0, SY_MODEL_MJCF is 1");
  }
  Description d;
  d.format = source.format;
  if (source.path != nullptr) {
    d.path = d.origin = source.path;
    d.text = Content(d.path);
  } else if (source.text != nullptr) {
    d.origin = FormatName(d.format);
    d.text = source.text;
  } else {
    throw Failure(SY_E_ARGUMENT, "neither a path nor a text to load a model from");
  }
  tinyxml2::XMLDocument document;
  Parse(d, document);
  (d.format == SY_MODEL_URDF ? DescribeUrdf : DescribeMjcf)(&document, d);
  return d;
}

}  // namespace switchyard::dynamics
