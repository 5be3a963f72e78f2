// switchyard/host/host.hpp - what backends are there: modules found at run time and tables
// registered by the program, each with what it can do or why it cannot.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "switchyard/abi.h"
#include "switchyard/error.hpp"
#include "switchyard/export.hpp"
#include "switchyard/host/program_type.hpp"

namespace switchyard {

/// How far a backend or a file has come; each state short of kReady has a reason.
enum class BackendState { kNotLoadable, kNotCompatible, kNotReady, kReady };
SWITCHYARD_EXPORT std::string to_string(BackendState state);

/// A backend: one sy_solver of a plugin, and where it came from. Lives as long as its host.
struct Backend {
  const sy_solver* table = nullptr;  // the plugin's own
  sy_solver facts{};                 // a whole copy: fields its author did not know are 0
  std::string id;                    // "org.coin-or.clp"
  std::string short_name;            // "clp": what stands behind the id's last dot
  std::string name;
  std::string plugin;  // name and version of the plugin
  std::string origin;  // the file, or "registered by the program"
};

/// A table of a plugin that is no solver, such as "sy.dynamics/1" of switchyard/dynamics.h. Lives
/// as long as the process.
struct PluginTable {
  const void* table = nullptr;
  std::string plugin;  // name and version of the plugin
  std::string origin;  // the file, or "registered by the program"
};

/// Whether a backend could be used now: license, device, library.
struct Readiness {
  bool ready = false;
  std::string version;  // of the solver
  std::string text;     // license, place, device; or why it is not ready
};

/// A file or folder entry that gave no backend, or a backend that another one hides.
struct PluginProblem {
  std::string path;
  BackendState state = BackendState::kNotLoadable;
  std::string reason;
};

struct HostOptions {
  /// Modules to load, before all others. A path that cannot be used is an entry of problems().
  std::vector<std::string> files;
  /// Folders to search, in order. Unset: SWITCHYARD_PLUGIN_PATH (a list with colons), the user's
  /// folder ($XDG_DATA_HOME or ~/.local/share, then switchyard/plugins), and
  /// switchyard/plugins beside libswitchyard.
  std::optional<std::vector<std::string>> folders;
  /// What a backend asks for before it is created: value of `name` for a solver's id.
  std::function<std::optional<std::string>(const std::string& id, const std::string& name)> setting;
};

/// Receives what backends log; may be called from any thread.
using LogSink = std::function<void(sy_level level, const std::string& text)>;

/// Why a backend would or would not serve a problem.
struct Candidate {
  const Backend* backend = nullptr;
  bool suitable = false;
  std::string why;      // where not suitable; else which bridges it needs
  int num_bridges = 0;  // fewer are better
};

/// The backends of a process. Loading never throws and never aborts, whatever file it meets.
/// Const members may be used from any thread; Load and Register serialize among themselves.
class SWITCHYARD_EXPORT Host {
 public:
  explicit Host(HostOptions options = {});
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;
  ~Host();

  /// The process's own, made at the first call with default options.
  static Host& Default();

  /// Loads one module. What went wrong is the last entry of problems(), and the answer false.
  bool Load(const std::string& path);
  /// Takes the tables of a plugin that is linked in; they must outlive the process's solves.
  bool Register(const sy_plugin& plugin, const std::string& origin = "registered by the program");

  /// All usable backends, in the order in which they were found.
  [[nodiscard]] std::vector<const Backend*> backends() const;
  [[nodiscard]] std::vector<PluginProblem> problems() const;
  /// The tables named `id`, one a plugin that has one, in the order in which they were found.
  [[nodiscard]] std::vector<PluginTable> Tables(const std::string& id) const;
  /// The folders that were searched, in order.
  [[nodiscard]] const std::vector<std::string>& folders() const;
  /// By id or short name; nullptr where there is none.
  [[nodiscard]] const Backend* Find(const std::string& name) const;
  /// Asked anew at every call.
  [[nodiscard]] Readiness Ready(const Backend& backend) const;

  /// The host's table over a backend: a sy_solver that takes every section it can bridge, every
  /// update (reloading where the backend cannot), and keeps the limits that the backend leaves to
  /// it. See sy_solvers in abi.h. Lives as long as the host.
  [[nodiscard]] const sy_solver* Facade(const Backend& backend) const;
  /// What plugins are given.
  [[nodiscard]] const sy_host* table() const;

  /// All backends for a problem of this shape, best first: those named in `preference` (ids or
  /// short names, comma-separated) alone; where it is empty those that are preferred for the
  /// problem's class, then all others; suitable ones before others. Strategies are considered only
  /// where named.
  [[nodiscard]] std::vector<Candidate> Rank(const sy_problem& problem,
                                            const std::string& preference = "") const;

  /// Backends to try first, in order (ids or short names, comma-separated; empty: no preference any
  /// more), for programs of a class, or for all whose class has no preference of its own. Goes
  /// before SWITCHYARD_SOLVERS, which goes before the file switchyard/solvers.conf in
  /// $XDG_CONFIG_HOME or ~/.config: lines "lp = clp, highs", or names alone for all classes. Throws
  /// InvalidArgument for a name that no backend has.
  void Prefer(std::optional<ProgramType> type, const std::string& names);
  /// Is the backend ready, and does it take a program of that class, perhaps by bridges?
  [[nodiscard]] bool Serves(const Backend& backend, ProgramType type) const;

  /// Options for a backend wherever it is used, also inside a strategy. Throws InvalidArgument for
  /// an unknown backend or option, with the nearest name, or a value out of its range.
  void SetOption(const std::string& backend, const std::string& name, const std::string& value);
  void ClearOptions();

  /// Where lines that backends write go, from any thread, one at a time; set before they are solved
  /// with.
  void SetLog(LogSink sink);

 private:
  [[nodiscard]] struct Preference PreferenceFor(ProgramType type) const;

  struct State;
  std::unique_ptr<State> state_;
};

/// A text as the value that an option takes. Throws InvalidArgument, naming option, need and text.
/// A text value points into `text`.
SWITCHYARD_EXPORT sy_value ParseOptionValue(const sy_option& option, const std::string& text);
/// The option of that name. Throws InvalidArgument with the nearest name; nullptr where the solver
/// takes options that it does not list.
SWITCHYARD_EXPORT const sy_option* FindOption(const sy_solver& solver, const std::string& name);

}  // namespace switchyard
