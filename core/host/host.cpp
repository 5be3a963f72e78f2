#include "switchyard/host/host.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <deque>
#include <map>
#include <set>
#include <sstream>

#include "core/host/facade.hpp"
#include "core/host/module.hpp"
#include "core/host/places.hpp"
#include "core/host/preferences.hpp"
#include "switchyard/error.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard {
namespace {

std::string ShortName(const std::string& id) { return id.substr(id.rfind('.') + 1); }

std::vector<std::string> Split(const std::string& list, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(list);
  for (std::string part; std::getline(in, part, separator);) {
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

}  // namespace

std::string to_string(BackendState state) {
  switch (state) {
    case BackendState::kNotLoadable:
      return "not loadable";
    case BackendState::kNotCompatible:
      return "not compatible";
    case BackendState::kNotReady:
      return "not ready";
    default:
      return "ready";
  }
}

struct Host::State {
  struct Entry {
    Backend backend;
    FacadeContext context;
    sy_solver facade{};
  };

  HostOptions options;
  std::vector<std::string> folders;
  mutable std::recursive_mutex mutex;
  std::deque<Entry> entries;  // entries never move: tables point to them
  std::vector<std::pair<const sy_plugin*, std::string>> plugins;  // and where each came from
  std::vector<PluginProblem> problems;
  std::map<std::string, std::map<std::string, std::string>> user_options;  // by backend's id
  std::map<std::pair<std::string, std::string>, std::string> settings;     // given out as pointers
  Preferences preferences;                                                 // said by the program
  LogSink log;
  sy_host table{};
  sy_solvers solvers{};

  void FillTables(Host* host);
  bool Take(const sy_plugin& plugin, const std::string& origin);
  const char* Setting(const std::string& id, const std::string& name);
  void Configure(const Backend& backend, Instance& instance) const;
  const sy_solver* Find(const Host& host, const sy_wish& wish) const;
};

void Host::State::FillTables(Host* host) {
  solvers.size = sizeof solvers;
  solvers.context = host;
  solvers.find = [](void* context, const sy_wish* wish, sy_error* error) noexcept {
    const sy_solver* found = nullptr;
    plugin::Guarded(error, [&] {
      const auto* self = static_cast<const Host*>(context);
      found = self->state_->Find(*self, plugin::Whole(*wish));
    });
    return found;
  };
  table.size = sizeof table;
  table.abi_major = SY_ABI_MAJOR;
  table.abi_minor = SY_ABI_MINOR;
  table.name = "switchyard";
  table.version = SWITCHYARD_VERSION;
  table.context = host;
  table.log = [](void* context, sy_level level, const char* text) noexcept {
    const LogSink& sink = static_cast<const Host*>(context)->state_->log;
    try {
      if (sink && text != nullptr) sink(level, text);
    } catch (...) {  // a sink that throws loses its line, not the solve
    }
  };
  table.extension = [](void* context, const char* id) noexcept -> const void* {
    const bool known = id != nullptr && std::string_view(id) == "sy.solvers/1";
    return known ? &static_cast<const Host*>(context)->state_->solvers : nullptr;
  };
  table.setting = [](void* context, const char* id, const char* name) noexcept -> const char* {
    try {
      return static_cast<const Host*>(context)->state_->Setting(id, name);
    } catch (...) {
      return nullptr;
    }
  };
}

const char* Host::State::Setting(const std::string& id, const std::string& name) {
  if (!options.setting) return nullptr;
  const std::optional<std::string> value = options.setting(id, name);
  if (!value) return nullptr;
  const std::lock_guard lock(mutex);
  std::string& kept = settings[{id, name}];
  if (kept != *value) kept = *value;
  return kept.c_str();
}

bool Host::State::Take(const sy_plugin& plugin, const std::string& origin) {
  bool all = true;
  plugins.emplace_back(&plugin, origin);
  const sy_solver* const none = nullptr;
  const sy_solver* const* const tables = plugin.solvers != nullptr ? plugin.solvers : &none;
  for (const sy_solver* const* table_of = tables; *table_of != nullptr; ++table_of) {
    const sy_solver& solver = **table_of;
    std::string fault = TableFault(solver);
    const auto same = std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) {
      return fault.empty() && entry.backend.id == solver.id;
    });
    if (same != entries.end()) {
      fault =
          Text(solver.id, " is already there, from ", same->backend.origin, ", which comes first");
    }
    if (!fault.empty()) {
      problems.push_back({origin, BackendState::kNotCompatible, fault});
      all = false;
      continue;
    }
    Entry& entry = entries.emplace_back();
    entry.backend = {&solver,     plugin::Whole(solver),
                     solver.id,   ShortName(solver.id),
                     solver.name, Text(plugin.name, " ", plugin.version),
                     origin};
    entry.context.backend = &entry.backend;
    entry.context.host = &table;
    entry.context.turn.serial = (entry.backend.facts.traits & SY_ONE_AT_A_TIME) != 0;
    entry.context.turn.who = entry.backend.id;
    entry.context.configure = [this, &entry](Instance& i) { Configure(entry.backend, i); };
    entry.facade = Facade::Table(entry.context);
  }
  return all;
}

void Host::State::Configure(const Backend& backend, Instance& instance) const {
  const std::lock_guard lock(mutex);
  const auto set = user_options.find(backend.id);
  if (set == user_options.end()) return;
  for (const auto& [name, text] : set->second) {
    const sy_option* option = FindOption(backend.facts, name);
    sy_value value{};
    value.type = SY_TEXT;
    value.as.text = text.c_str();
    instance.SetOption(name, option != nullptr ? ParseOptionValue(*option, text) : value);
  }
}

Host::Host(HostOptions options) : state_(std::make_unique<State>()) {
  state_->options = std::move(options);
  state_->folders = state_->options.folders.value_or(DefaultPluginFolders());
  state_->FillTables(this);
  std::set<std::filesystem::path> seen;  // one file may be reached by several names
  const auto load_once = [&](const std::string& file) {
    std::error_code none;
    const std::filesystem::path real = std::filesystem::canonical(file, none);
    if (none || seen.insert(real).second) Load(file);
  };
  for (const std::string& file : state_->options.files) load_once(file);
  for (const std::string& folder : state_->folders) {
    for (const std::string& file : ModulesIn(folder)) load_once(file);
  }
}

Host::~Host() = default;

Host& Host::Default() {
  static Host& host = *new Host();  // never destroyed: backends live as long as the process
  return host;
}

bool Host::Load(const std::string& path) {
  const std::lock_guard lock(state_->mutex);
  const Module module = OpenModule(path);
  if (module.plugin == nullptr) {
    state_->problems.push_back({path, module.state, module.reason});
    return false;
  }
  return state_->Take(*module.plugin, path);
}

bool Host::Register(const sy_plugin& plugin, const std::string& origin) {
  const std::lock_guard lock(state_->mutex);
  const std::string fault = TableFault(plugin);
  if (!fault.empty()) {
    state_->problems.push_back({origin, BackendState::kNotCompatible, fault});
    return false;
  }
  return state_->Take(plugin, origin);
}

std::vector<const Backend*> Host::backends() const {
  const std::lock_guard lock(state_->mutex);
  std::vector<const Backend*> all;
  for (const State::Entry& entry : state_->entries) all.push_back(&entry.backend);
  return all;
}

std::vector<PluginTable> Host::Tables(const std::string& id) const {
  const std::lock_guard lock(state_->mutex);
  std::vector<PluginTable> all;
  for (const auto& [plugin, origin] : state_->plugins) {
    const sy_plugin whole = plugin::Whole(*plugin);  // fields its author did not know are 0
    const void* table = whole.extension != nullptr ? whole.extension(id.c_str()) : nullptr;
    if (table != nullptr) all.push_back({table, Text(plugin->name, " ", plugin->version), origin});
  }
  return all;
}

std::vector<PluginProblem> Host::problems() const {
  const std::lock_guard lock(state_->mutex);
  return state_->problems;
}

const std::vector<std::string>& Host::folders() const { return state_->folders; }
const sy_host* Host::table() const { return &state_->table; }
void Host::SetLog(LogSink sink) { state_->log = std::move(sink); }

const Backend* Host::Find(const std::string& name) const {
  const std::lock_guard lock(state_->mutex);
  for (const State::Entry& entry : state_->entries) {
    if (entry.backend.id == name || entry.backend.short_name == name) return &entry.backend;
  }
  return nullptr;
}

Readiness Host::Ready(const Backend& backend) const {
  const sy_solver& solver = backend.facts;
  const auto or_empty = [](const char* text) { return std::string(text != nullptr ? text : ""); };
  if (solver.ready == nullptr) return {true, or_empty(solver.version), ""};
  sy_facts facts{};
  facts.size = sizeof facts;
  try {
    Call(solver, "ready", solver.ready, backend.table, &state_->table, &facts);
  } catch (const BackendError& e) {
    return {false, or_empty(solver.version), e.reason()};
  }
  facts.version[sizeof facts.version - 1] = '\0';
  facts.text[sizeof facts.text - 1] = '\0';
  const std::string version = facts.version[0] != '\0' ? facts.version : or_empty(solver.version);
  return {true, version, facts.text};
}

const sy_solver* Host::Facade(const Backend& backend) const {
  const std::lock_guard lock(state_->mutex);
  for (const State::Entry& entry : state_->entries) {
    if (&entry.backend == &backend) return &entry.facade;
  }
  Refuse("the backend ", backend.id, " is not of this host");
}

void Host::SetOption(const std::string& name, const std::string& option, const std::string& value) {
  const Backend* backend = Find(name);
  if (backend == nullptr) {
    std::vector<std::string> names;
    for (const Backend* one : backends()) names.push_back(one->short_name);
    const std::string near = NearestName(name, names);
    Refuse("there is no backend \"", name, "\" to set ", option, " of",
           near.empty() ? "" : "; the nearest is \"" + near + "\"");
  }
  const sy_option* known = FindOption(backend->facts, option);
  if (known != nullptr) ParseOptionValue(*known, value);
  const std::lock_guard lock(state_->mutex);
  state_->user_options[backend->id][option] = value;
}

void Host::ClearOptions() {
  const std::lock_guard lock(state_->mutex);
  state_->user_options.clear();
}

namespace {

Candidate Judge(const Host& host, const Backend& backend, const sy_problem& problem,
                const sy_solver& facade) {
  const Readiness readiness = host.Ready(backend);
  if (!readiness.ready) return {&backend, false, "not ready: " + readiness.text, 0};
  try {
    const BridgePlan plan = PlanFor(problem, backend);
    if (backend.facts.supports != nullptr) {
      Call(facade, "supports", facade.supports, &facade, host.table(), &problem);
    }
    std::string why;
    for (const BridgeKind* kind : plan)
      why += (why.empty() ? "by " : ", ") + std::string(kind->name);
    return {&backend, true, why.empty() ? "takes it as it is" : why, static_cast<int>(plan.size())};
  } catch (const BackendError& e) {
    return {&backend, false, e.reason(), 0};
  } catch (const std::exception& e) {
    return {&backend, false, e.what(), 0};
  }
}

// Strategies ask others, and each has a way of its own: which one is the user's to say. Unless it
// proves what integers make hard, which most other backends do not take at all.
bool IsAskedUnnamed(const Backend& backend, const sy_problem& problem) {
  if ((backend.facts.traits & SY_STRATEGY) == 0) return true;
  if ((backend.facts.traits & SY_PROVES_GLOBAL) == 0 || problem.integer == nullptr) return false;
  return std::any_of(problem.integer, problem.integer + problem.num_vars,
                     [](std::uint8_t i) { return i != 0; });
}

// Among suitable backends that nobody named: strategies last; fewer bridges; then those that come
// with the project, so that the default is the same on every machine; then more that can be known
// and kept.
bool Better(const Candidate& a, const Candidate& b) {
  if (a.suitable != b.suitable) return a.suitable;
  const auto strategy = [](const Candidate& c) {
    return (c.backend->facts.traits & SY_STRATEGY) != 0;
  };
  if (strategy(a) != strategy(b)) return strategy(b);
  if (a.num_bridges != b.num_bridges) return a.num_bridges < b.num_bridges;
  const auto ours = [](const Candidate& c) { return c.backend->id.starts_with("org.switchyard."); };
  if (ours(a) != ours(b)) return ours(a);
  const auto worth = [](const Candidate& c) {
    const sy_solver& s = c.backend->facts;
    return std::popcount(s.traits & (SY_GIVES_DUALS | SY_GIVES_CERTIFICATES)) * 100 +
           std::popcount(s.traits & SY_GIVES_BASIS) * 20 + std::popcount(s.updates) +
           std::popcount(s.honors);
  };
  if (worth(a) != worth(b)) return worth(a) > worth(b);
  return a.backend->id < b.backend->id;
}

}  // namespace

std::vector<Candidate> Host::Rank(const sy_problem& problem, const std::string& preference) const {
  const bool only_named = !preference.empty();
  Preference wanted{preference, ""};
  if (!only_named) wanted = PreferenceFor(ProgramTypeOf(problem));
  std::vector<Candidate> first;
  std::vector<Candidate> rest;
  for (const std::string& name : Split(wanted.names, ',')) {
    const Backend* backend = Find(name);
    if (backend == nullptr) continue;
    first.push_back(Judge(*this, *backend, problem, *Facade(*backend)));
    if (!only_named) {
      first.back().why += Text(first.back().why.empty() ? "" : "; ", "preferred for ",
                               to_string(ProgramTypeOf(problem)), " by ", wanted.source);
    }
  }
  for (const Backend* backend : backends()) {
    const bool is_named = std::any_of(first.begin(), first.end(),
                                      [&](const Candidate& c) { return c.backend == backend; });
    if (is_named || only_named || !IsAskedUnnamed(*backend, problem)) continue;
    rest.push_back(Judge(*this, *backend, problem, *Facade(*backend)));
  }
  std::stable_partition(first.begin(), first.end(), [](const Candidate& c) { return c.suitable; });
  std::stable_sort(rest.begin(), rest.end(), Better);
  const auto place =
      std::find_if(first.begin(), first.end(), [](const Candidate& c) { return !c.suitable; });
  first.insert(place, rest.begin(), rest.end());
  return first;
}

void Host::Prefer(std::optional<ProgramType> type, const std::string& names) {
  const std::lock_guard lock(state_->mutex);
  for (const std::string& name : Split(names, ',')) {
    if (Find(name) != nullptr) continue;
    std::vector<std::string> known;
    for (const Backend* one : backends()) known.push_back(one->short_name);
    const std::string near = NearestName(name, known);
    Refuse("there is no backend \"", name, "\" to prefer",
           near.empty() ? "" : "; the nearest is \"" + near + "\"");
  }
  state_->preferences.Set(type, names, "the program");
}

Preference Host::PreferenceFor(ProgramType type) const {
  const std::lock_guard lock(state_->mutex);
  const Preference own = state_->preferences.For(type);
  return own.names.empty() ? ConfiguredPreferences().For(type) : own;
}

bool Host::Serves(const Backend& backend, ProgramType type) const {
  if (!Ready(backend).ready) return false;
  const auto is = [&](std::initializer_list<ProgramType> types) {
    return std::find(types.begin(), types.end(), type) != types.end();
  };
  using enum ProgramType;
  Features needed = SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS;
  const bool integer = is({kMILP, kMIQP, kMISOCP, kMISDP, kMICGP, kMINLP});
  if (integer) needed |= SY_ACCEPTS_INTEGER;
  if (is({kQP, kMIQP, kQuadraticCostConicConstraint})) needed |= SY_ACCEPTS_QUADRATIC_OBJECTIVE;
  if (is({kSOCP, kMISOCP, kQuadraticCostConicConstraint})) {
    needed |= ConeFeature(SY_CONE_SECOND_ORDER);
  }
  if (is({kSDP, kMISDP})) needed |= ConeFeature(SY_CONE_PSD);
  if (is({kCGP, kMICGP})) needed |= ConeFeature(SY_CONE_EXPONENTIAL);
  if (is({kNLP, kMINLP})) needed |= SY_ACCEPTS_NLP;
  return PlanBridges(needed, AbilitiesOf(backend.facts, integer)).found;
}

const sy_solver* Host::State::Find(const Host& host, const sy_wish& wish) const {
  Require(wish.problem != nullptr, "a wish needs a problem");
  Require(wish.rank >= 0, "a wish needs a rank from 0 on, got ", wish.rank);
  std::string reasons;
  std::vector<const Candidate*> good;
  const std::string names = wish.names != nullptr ? wish.names : "";
  for (const std::string& name : Split(names, ',')) {
    if (host.Find(name) != nullptr) continue;
    reasons += Text(reasons.empty() ? "" : "; ", name, ": there is none of that name");
  }
  const auto ranked = host.Rank(*wish.problem, names);
  for (const Candidate& candidate : ranked) {
    const sy_solver& facts = candidate.backend->facts;
    std::string why = candidate.suitable ? "" : candidate.why;
    const bool strategy = (facts.traits & SY_STRATEGY) != 0;
    if (why.empty() && strategy && names.empty()) why = "is a strategy, and was not named";
    if (why.empty() && (wish.traits & ~facts.traits) != 0) why = "lacks a trait that is needed";
    if (why.empty() && (wish.honors & ~host.Facade(*candidate.backend)->honors) != 0) {
      why = "does not keep a limit that is needed";
    }
    if (why.empty()) {
      good.push_back(&candidate);
    } else {
      reasons += Text(reasons.empty() ? "" : "; ", candidate.backend->short_name, ": ", why);
    }
  }
  // Cheap updates and many instances are better, in the order that stands otherwise.
  const auto misses = [&](const Candidate* c) {
    const bool serial = wish.instances > 1 && (c->backend->facts.traits & SY_ONE_AT_A_TIME) != 0;
    return std::popcount(wish.updates & ~c->backend->facts.updates) + (serial ? 8 : 0);
  };
  if (wish.names == nullptr) {
    std::stable_sort(good.begin(), good.end(),
                     [&](const Candidate* a, const Candidate* b) { return misses(a) < misses(b); });
  }
  if (wish.rank >= 0 && static_cast<std::size_t>(wish.rank) < good.size()) {
    return host.Facade(*good[static_cast<std::size_t>(wish.rank)]->backend);
  }
  if (!good.empty()) {
    reasons += Text(reasons.empty() ? "" : "; ", "there is none of rank ", wish.rank, ", only ",
                    good.size(), " would serve");
  }
  throw plugin::Failure(SY_E_UNSUPPORTED, reasons.empty() ? "no backend is there" : reasons);
}

}  // namespace switchyard
