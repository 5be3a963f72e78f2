// Which engine loads a model, and from what.
#include <cmath>
#include <limits>

#include "core/dynamics/loaded_model.hpp"
#include "switchyard/host/host.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard {
namespace {

constexpr const char* kTable = "sy.dynamics/1";

struct Engine {
  sy_dynamics table;
  std::string plugin;  // name and version
};

const Host& OrDefault(const Host* host) { return host != nullptr ? *host : Host::Default(); }

/// Tables that end before their last function are of another version, and no engine.
std::vector<Engine> EnginesOf(const Host& host) {
  std::vector<Engine> engines;
  for (const PluginTable& found : host.Tables(kTable)) {
    const auto& table = *static_cast<const sy_dynamics*>(found.table);
    if (table.size < sizeof(sy_dynamics)) continue;
    engines.push_back({plugin::Whole(table), found.plugin});
  }
  return engines;
}

/// Where engines were looked for, and why a file there that sounds like one is none.
std::string WordsOfSearch(const Host& host) {
  std::string text;
  for (const std::string& folder : host.folders()) text += (text.empty() ? "" : ", ") + folder;
  if (text.empty()) text = "no folder";
  for (const PluginProblem& problem : host.problems()) {
    if (problem.path.find("pinocchio") != std::string::npos) {
      text += Text("; ", problem.path, ": ", problem.reason);
    }
  }
  return text;
}

sy_dynamics EngineNamed(const std::string& call, const std::string& name, const Host& host) {
  const std::vector<Engine> engines = EnginesOf(host);
  Require(!engines.empty(), call, ": no loaded plugin offers rigid-body dynamics (", kTable,
          "); the plugin pinocchio does, and was looked for in ", WordsOfSearch(host));
  std::string known;
  for (const Engine& engine : engines) {
    if (name.empty() || name == engine.table.name ||
        engine.plugin.compare(0, name.size() + 1, name + " ") == 0) {
      return engine.table;
    }
    known += Text(known.empty() ? "" : ", ", engine.table.name);
  }
  Refuse(call, ": there is no engine \"", name, "\" of rigid-body dynamics, but ", known);
}

std::vector<const char*> PointersTo(const std::vector<std::string>& texts) {
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  return pointers;
}

std::shared_ptr<const LoadedModel> Load(const std::string& call, sy_model_format format,
                                        const char* path, const char* text,
                                        const RigidBodyOptions& options) {
  const sy_dynamics table = EngineNamed(call, options.engine, OrDefault(options.host));
  std::vector<std::string> names;
  std::vector<double> positions;
  for (const auto& [name, position] : options.locked) {
    Require(std::isfinite(position), call, ": the locked joint \"", name,
            "\" needs a finite position, got ", position);
    names.push_back(name);
    positions.push_back(position);
  }
  const Eigen::Vector3d gravity =
      options.gravity.value_or(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  for (int i = 0; options.gravity && i < 3; ++i) {
    Require(std::isfinite(gravity[i]), call, ": gravity[", i, "] needs to be finite, got ",
            gravity[i]);
  }
  const std::vector<const char*> packages = PointersTo(options.packages);
  const std::vector<const char*> locked = PointersTo(names);
  sy_dynamics_source source{};
  source.size = sizeof source;
  source.format = format;
  source.path = path;
  source.text = text;
  source.packages = packages.data();
  source.num_packages = static_cast<int>(packages.size());
  source.num_locked = static_cast<int>(locked.size());
  source.locked = locked.data();
  source.locked_position = positions.data();
  for (int i = 0; i < 3; ++i) source.gravity[i] = gravity[i];
  source.geometry = options.geometry ? 1 : 0;
  sy_dynamics_model* model = nullptr;
  sy_error error{};
  if (table.load(&source, &model, &error) < 0) Refuse(call, ": ", error.text);
  return std::make_shared<const LoadedModel>(table, model);
}

}  // namespace

RigidBodyModel RigidBodyModel::LoadUrdf(const std::string& path, const RigidBodyOptions& options) {
  return RigidBodyModel(Load("LoadUrdf", SY_MODEL_URDF, path.c_str(), nullptr, options));
}

RigidBodyModel RigidBodyModel::LoadMjcf(const std::string& path, const RigidBodyOptions& options) {
  return RigidBodyModel(Load("LoadMjcf", SY_MODEL_MJCF, path.c_str(), nullptr, options));
}

RigidBodyModel RigidBodyModel::ParseUrdf(const std::string& text, const RigidBodyOptions& options) {
  return RigidBodyModel(Load("ParseUrdf", SY_MODEL_URDF, nullptr, text.c_str(), options));
}

RigidBodyModel RigidBodyModel::ParseMjcf(const std::string& text, const RigidBodyOptions& options) {
  return RigidBodyModel(Load("ParseMjcf", SY_MODEL_MJCF, nullptr, text.c_str(), options));
}

std::vector<std::string> RigidBodyModel::Engines(const Host* host) {
  std::vector<std::string> names;
  for (const Engine& engine : EnginesOf(OrDefault(host))) names.emplace_back(engine.table.name);
  return names;
}

}  // namespace switchyard
