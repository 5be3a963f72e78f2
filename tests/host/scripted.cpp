#include "tests/host/scripted.hpp"

#include <algorithm>

#include "core/host/facade.hpp"

namespace switchyard::test {
namespace {

class Scripted {
 public:
  Scripted(const sy_solver& self, const sy_host&)
      : script_(*static_cast<Script*>(const_cast<void*>(self.context))) {
    const Inside inside(script_, "create");
    {
      const std::lock_guard lock(script_.recording);
      script_.self = &self;
    }
    if (script_.create) script_.create();
  }
  Scripted(const Scripted&) = delete;
  Scripted& operator=(const Scripted&) = delete;
  ~Scripted() { const Inside inside(script_, "destroy"); }

  void SetOption(std::string_view name, const sy_value& value) {
    const Inside inside(script_, "set_option");
    script_.options.emplace_back(name, value.type == SY_TEXT   ? std::string(value.as.text)
                                       : value.type == SY_REAL ? std::to_string(value.as.real)
                                                               : std::to_string(value.as.integer));
  }
  void Load(const sy_problem& problem, std::uint64_t updates) {
    const Inside inside(script_, "load");
    if (script_.load) script_.load();
    const std::lock_guard lock(script_.recording);
    script_.problem = Problem(problem);
    script_.announced = updates;
  }
  void Update(const sy_update& update) {
    const Inside inside(script_, "update");
    if (script_.update) script_.update();
    std::uint64_t kinds = update.whole;
    if (update.num_x > 0 || update.num_rows > 0) kinds |= SY_UPDATES_BOUNDS;
    if (update.num_cones > 0) kinds |= SY_UPDATES_SWITCH;
    if (update.num_gone_rows > 0 || update.num_gone_cones > 0) kinds |= SY_UPDATES_REMOVE;
    if (update.more != nullptr) kinds |= SY_UPDATES_APPEND;
    script_.kinds.push_back(kinds);
    script_.last_update = update;
    script_.problem.Apply(update);
  }
  void WarmStart(const sy_start& start) {
    const Inside inside(script_, "warm_start");
    const ProblemData& d = script_.problem.data();
    const auto take = [](const double* from, std::int32_t count) {
      return from == nullptr ? std::vector<double>() : std::vector<double>(from, from + count);
    };
    script_.start_x = take(start.x, d.num_vars);
    script_.start_row_dual = take(start.row_dual, d.num_rows());
    script_.start_has_basis = start.x_basis != nullptr;
  }
  void Solve(const sy_control& control, sy_result& result) {
    const Inside inside(script_, "solve");
    if (script_.solve) return script_.solve(control, result);
    result.termination = SY_OPTIMAL;
    result.primal = SY_FEASIBLE;
    result.objective = script_.problem.data().offset;
    if (result.x != nullptr) std::fill_n(result.x, script_.problem.data().num_vars, 0.0);
  }

 private:
  // Counts the calls that are inside at a time.
  class Inside {
   public:
    Inside(Script& script, const char* call) : script_(script) {
      const int now = ++script_.inside;
      int most = script_.most_inside;
      while (now > most && !script_.most_inside.compare_exchange_weak(most, now)) {
      }
      const std::lock_guard lock(script_.recording);
      script_.calls.emplace_back(call);
    }
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;
    ~Inside() { --script_.inside; }

   private:
    Script& script_;
  };

  Script& script_;
};

}  // namespace

Script::Script(const char* id) {
  table.context = this;
  table.id = id;
  table.name = "Scripted";
  table.version = "1.0";
  table.license = "BSD-3-Clause";
  table.accepts = SY_ACCEPTS_BOUNDS | SY_ACCEPTS_ROWS;
  plugin::WriteFunctions<Scripted>(table);
  plugin = {sizeof plugin, SY_ABI_MAJOR, SY_ABI_MINOR, "scripted", "1.0", list, nullptr};
}

const Backend& Add(Host& host, Script& script) {
  const bool taken = host.Register(script.plugin);
  return taken ? *host.Find(script.table.id)
               : throw std::logic_error(host.problems().back().reason);
}

HostOptions Nowhere() {
  HostOptions options;
  options.folders = std::vector<std::string>();
  return options;
}

sy_control Freely() {
  sy_control c = {};
  c.size = sizeof c;
  c.threads = 1;
  c.seconds = kInfinity;
  c.iterations = c.nodes = std::numeric_limits<std::int64_t>::max();
  c.cutoff = kInfinity;
  c.target = -kInfinity;
  c.feasibility = c.optimality = c.integrality = c.absolute_gap = c.relative_gap = kNaN;
  return c;
}

void Session::Load(const ProblemData& data, std::uint64_t updates) {
  problem_ = Problem(data);
  instance_.Load(problem_.view(), updates);
}

void Session::Update(const sy_update& update) {
  Problem next = problem_;
  next.Apply(update);
  instance_.Update(update);
  problem_ = std::move(next);
}

Answer Session::Solve(const sy_control& control) {
  const ProblemData& d = problem_.data();
  Answer a;
  a.x.assign(static_cast<std::size_t>(d.num_vars), -77);
  a.x_dual = a.x;
  a.row_dual.assign(d.row_lower.size(), -77);
  a.cone_dual.assign(d.g.size(), -77);
  char text[256] = "";
  a.result.size = sizeof a.result;
  a.result.x = a.x.data();
  a.result.x_dual = a.x_dual.data();
  a.result.row_dual = a.row_dual.data();
  a.result.cone_dual = a.cone_dual.data();
  a.result.text = text;
  a.result.text_size = sizeof text;
  try {
    instance_.Solve(control, a.result);
  } catch (const BackendError& e) {
    a.status = e.code();
    a.error = e.what();
  }
  a.text = text;
  return a;
}

namespace {
const sy_facade& Served(const Instance& instance) {
  const sy_solver& table = instance.solver();
  return *static_cast<const sy_facade*>(table.extension(&table, "sy.facade/1"));
}
}  // namespace

int Session::loads() const { return Served(instance_).loads(instance_.get()); }
int Session::updates() const { return Served(instance_).updates(instance_.get()); }

std::string Failed(const std::function<void()>& call, sy_status code) {
  try {
    call();
  } catch (const BackendError& e) {
    return e.code() == code ? e.what() : "(another status) " + std::string(e.what());
  }
  return "";
}

namespace {
// A matrix from its dense columns, entry by entry.
Csc Dense(std::int32_t rows, const std::vector<std::vector<double>>& columns) {
  Csc m(rows, static_cast<std::int32_t>(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j) {
    for (std::int32_t i = 0; i < rows; ++i) {
      if (columns[j][static_cast<std::size_t>(i)] == 0) continue;
      m.row.push_back(i);
      m.value.push_back(columns[j][static_cast<std::size_t>(i)]);
    }
    m.start[j + 1] = static_cast<std::int32_t>(m.row.size());
  }
  return m;
}
}  // namespace

ProblemData SmallLp() {
  ProblemData d;
  d.num_vars = 2;
  d.P = Csc(2, 2);
  d.q = {1, 2};
  d.x_lower = {0, 0};
  d.x_upper = {4, 4};
  d.A = Dense(2, {{1, 1}, {1, -1}});
  d.row_lower = {1, -1};
  d.row_upper = {kInfinity, 1};
  d.F = Csc(0, 2);
  return d;
}

ProblemData SmallCones() {
  ProblemData d = SmallLp();
  d.F = Dense(6, {{0, 1, 0, 0, 1, 0}, {0, 0, 1, 0, 0, 1}});
  d.g = {3, 0, 0, 2, -1, -1};
  d.cones = {{SY_CONE_SECOND_ORDER, 3, 0}, {SY_CONE_SECOND_ORDER, 3, 0}};
  return d;
}

sy_update NoUpdate() {
  sy_update update{};
  update.size = sizeof update;
  return update;
}

}  // namespace switchyard::test
