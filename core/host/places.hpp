// core/host/places.hpp - where plugins are looked for.
#pragma once

#include <string>
#include <vector>

namespace switchyard {

/// SWITCHYARD_PLUGIN_PATH, the user's folder, and the one beside libswitchyard, in this order;
/// each once.
std::vector<std::string> DefaultPluginFolders();

/// The modules (*.so) of a folder in order of their names; none where there is no such folder.
std::vector<std::string> ModulesIn(const std::string& folder);

}  // namespace switchyard
