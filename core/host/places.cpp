#include "core/host/places.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace switchyard {
namespace fs = std::filesystem;
namespace {

/// The folder of the file that this code was loaded from.
fs::path OwnFolder() {
  Dl_info info{};
  static const char anchor = 0;
  if (dladdr(&anchor, &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code none;
  const fs::path real = fs::canonical(info.dli_fname, none);
  return real.parent_path();
}

std::string Environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

}  // namespace

std::vector<std::string> DefaultPluginFolders() {
  std::vector<std::string> folders;
  const auto add = [&](const std::string& folder) {
    const bool known = std::find(folders.begin(), folders.end(), folder) != folders.end();
    if (!folder.empty() && !known) folders.push_back(folder);
  };
  std::istringstream listed(Environment("SWITCHYARD_PLUGIN_PATH"));
  for (std::string folder; std::getline(listed, folder, ':');) add(folder);
  std::string data = Environment("XDG_DATA_HOME");
  const std::string home = Environment("HOME");
  if (data.empty() && !home.empty()) data = home + "/.local/share";
  if (!data.empty()) add(data + "/switchyard/plugins");
  const fs::path own = OwnFolder();
  if (!own.empty()) add((own / SWITCHYARD_PLUGIN_SUBDIR).string());
  return folders;
}

std::vector<std::string> ModulesIn(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code fault;
  for (fs::directory_iterator at(folder, fault), end; !fault && at != end; at.increment(fault)) {
    if (at->path().extension() == ".so") files.push_back(at->path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace switchyard
