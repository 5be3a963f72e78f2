// tests/host/scripted.hpp - a backend that does what a test says, and remembers what it was told.
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/host/instance.hpp"
#include "switchyard/error.hpp"
#include "switchyard/host/host.hpp"
#include "switchyard/plugin.hpp"
#include "switchyard/problem.hpp"
#include "switchyard/problem_update.hpp"

namespace switchyard::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A table, what stands behind it, and what came. One for all instances of its backend.
struct Script {
  explicit Script(const char* id = "org.fake.scripted");
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;

  sy_solver table{};  // to be changed before the host sees it
  std::function<void(const sy_control&, sy_result&)> solve;  // unset: optimal at x = 0
  std::function<void()> create;
  std::function<void()> load;
  std::function<void()> update;

  std::mutex recording;
  Problem problem;  // as loaded and updated
  std::vector<std::string> calls;
  std::uint64_t announced = 0;       // kinds of update, at the last load
  std::vector<std::uint64_t> kinds;  // of each update
  sy_update last_update{};           // its counts; the pointers are not good any more
  std::vector<double> start_x, start_row_dual;
  bool start_has_basis = false;
  std::vector<std::pair<std::string, std::string>> options;
  const sy_solver* self = nullptr;  // what create was given
  std::atomic<int> inside = 0;      // calls at this moment
  std::atomic<int> most_inside = 0;

  sy_plugin plugin{};
  const sy_solver* list[2] = {&table, nullptr};
};

/// Registers the script's table; the backend.
const Backend& Add(Host& host, Script& script);

/// A host that finds nothing by itself.
HostOptions Nowhere();

/// A control that limits nothing.
sy_control Freely();

struct Answer {
  sy_status status = SY_OK;
  std::string error;
  sy_result result{};
  std::vector<double> x, x_dual, row_dual, cone_dual;
  std::string text;
};

/// One instance of a table, told what to do as a strategy tells it.
class Session {
 public:
  Session(const Host& host, const Backend& backend)
      : instance_(*host.Facade(backend), *host.table()) {}
  explicit Session(const Host& host, Script& script) : Session(host, *host.Find(script.table.id)) {}

  void Load(const ProblemData& data, std::uint64_t updates = 0);
  void Update(const sy_update& update);
  void WarmStart(const sy_start& start) { instance_.WarmStart(start); }
  /// The buffers fit the problem as it is now; what fails is in the answer.
  Answer Solve(const sy_control& control = Freely());
  [[nodiscard]] int loads() const;
  [[nodiscard]] int updates() const;
  [[nodiscard]] const ProblemData& data() const { return problem_.data(); }
  Instance& instance() { return instance_; }

 private:
  Problem problem_;  // in place while the instance has it
  Instance instance_;
};

/// What a call of a facade that must fail said; "" where it did not.
std::string Failed(const std::function<void()>& call, sy_status code);

/// minimize x0 + 2 x1, 0 <= x <= 4, x0 + x1 >= 1, -1 <= x0 - x1 <= 1.
ProblemData SmallLp();
/// SmallLp with |x| <= 3 and |x - (1, 1)| <= 2, as second-order cones.
ProblemData SmallCones();

sy_update NoUpdate();

}  // namespace switchyard::test
