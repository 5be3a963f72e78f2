// A file's text to a model of Pinocchio.
#include <coal/mesh_loader/loader.h>
#include <boost/property_tree/xml_parser.hpp>
#include <exception>
#include <memory>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include "captured_log.hpp"
#include "pinocchio/parsers/mjcf.hpp"
#include "pinocchio/parsers/urdf.hpp"
#include "switchyard/plugin.hpp"
#include "tree.hpp"

namespace switchyard::dynamics {
namespace {

using plugin::Failure;

void BuildFromUrdf(const Description& d, const sy_dynamics_source& source, Tree& tree) {
  pinocchio::urdf::buildModelFromXML(d.text, tree.model);
  if (source.geometry == 0) return;
  const std::vector<std::string> packages(source.packages, source.packages + source.num_packages);
  pinocchio::urdf::buildGeom(tree.model, std::istringstream(d.text), pinocchio::COLLISION,
                             tree.geometry, packages);
}

// Materials and textures, which the library reads, and warns of on stdout.
void DropLooks(boost::property_tree::ptree& element) {
  for (const char* name : {"material", "texture"}) {
    element.erase(name);
    const auto attributes = element.find("<xmlattr>");
    if (attributes != element.not_found()) attributes->second.erase(name);
  }
  for (auto& [name, child] : element) {
    if (name != "<xmlattr>") DropLooks(child);
  }
}

// The library reads files alone, so the steps of its reader are taken here one by one.
void BuildFromMjcf(const Description& d, const sy_dynamics_source& source, Tree& tree) {
  pinocchio::Model model;
  pinocchio::mjcf::details::MjcfVisitor visitor(model);
  pinocchio::mjcf::details::MjcfGraph graph(visitor, d.path);
  std::istringstream stream(d.text);
  boost::property_tree::read_xml(stream, graph.pt);
  DropLooks(graph.pt);
  graph.parseGraph();
  graph.parseRootTree();
  tree.model = visitor.model;
  if (source.geometry == 0) return;
  coal::MeshLoaderPtr meshes = std::make_shared<coal::MeshLoader>();
  graph.parseGeomTree(pinocchio::COLLISION, tree.geometry, meshes);
}

}  // namespace

void ReadTree(const Description& d, const sy_dynamics_source& source, Tree& tree) {
  CapturedLog log;
  try {
    (d.format == SY_MODEL_URDF ? BuildFromUrdf : BuildFromMjcf)(d, source, tree);
    // What it cannot understand the library leaves out, and goes on.
    if (!log.Text().empty()) throw Failure(SY_E_ARGUMENT, d.origin + ": " + log.Text());
  } catch (const Failure&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    const std::string said = log.Text();
    throw Failure(SY_E_ARGUMENT, d.origin + ": " + (said.empty() ? Sentence(e.what()) : said));
  }
}

}  // namespace switchyard::dynamics
