// bare_solver.hpp - a plugin's table driven without a host: load, solve, look.
#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "switchyard/abi.h"
#include "switchyard/problem.hpp"

namespace switchyard::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A solver of a module in the plugin folder. Modules are never unloaded.
struct Named {
  std::string name;
  const sy_solver* table;
};

inline void PrintTo(const Named& named, std::ostream* out) { *out << named.name; }

inline std::vector<Named> AllSolvers() {
  std::vector<Named> all;
  std::error_code absent;
  for (const auto& file : std::filesystem::directory_iterator(SWITCHYARD_PLUGIN_FOLDER, absent)) {
    if (file.path().extension() != ".so") continue;
    void* module = dlopen(file.path().c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module == nullptr) continue;
    const auto entry = reinterpret_cast<sy_plugin_entry>(dlsym(module, SY_PLUGIN_ENTRY));
    if (entry == nullptr || entry()->solvers == nullptr) continue;
    for (const sy_solver* const* s = entry()->solvers; *s != nullptr; ++s) {
      if (((*s)->traits & SY_STRATEGY) != 0) continue;  // needs a host that offers others
      all.push_back({(*s)->name, *s});
    }
  }
  std::sort(all.begin(), all.end(), [](auto& a, auto& b) { return a.name < b.name; });
  return all;
}

/// Those that take every section in `sections` together, SY_ACCEPTS_*.
inline std::vector<Named> SolversOf(std::uint64_t sections) {
  std::vector<Named> fit;
  for (const Named& named : AllSolvers()) {
    const bool integer = (sections & SY_ACCEPTS_INTEGER) != 0;
    const std::uint64_t takes = integer ? named.table->integer_accepts : named.table->accepts;
    const std::uint64_t also = named.table->accepts;
    if ((sections & ~takes) == 0 && (sections & ~also) == 0) fit.push_back(named);
  }
  return fit;
}

inline std::string NameOf(const testing::TestParamInfo<Named>& info) { return info.param.name; }

inline sy_control Freely() {
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

struct Answer {
  sy_result result{};
  std::vector<double> x, x_dual, row_dual;
  std::vector<std::uint8_t> x_basis, row_basis;
  std::string text;
};

class BareSolver {
 public:
  explicit BareSolver(const Named& named) : table_(named.table) {
    host_.size = sizeof host_;
    host_.abi_major = SY_ABI_MAJOR;
    host_.name = "bare";
    Expect(table_->create(table_, &host_, &instance_, &error_), "create");
  }
  BareSolver(const BareSolver&) = delete;
  BareSolver& operator=(const BareSolver&) = delete;
  ~BareSolver() {
    if (instance_ != nullptr) table_->destroy(instance_);
  }

  void Load(const sy_problem& problem, std::uint64_t updates = 0) {
    vars_ = problem.num_vars;
    rows_ = problem.num_rows;
    Expect(table_->load(instance_, &problem, updates, &error_), "load");
  }
  void Update(const sy_update& update) {
    Expect(table_->update(instance_, &update, &error_), "update");
    rows_ -= update.num_gone_rows;
    if (update.more == nullptr) return;
    vars_ += update.more->num_vars;
    rows_ += update.more->num_rows;
  }
  void WarmStart(const sy_start& start) {
    Expect(table_->warm_start(instance_, &start, &error_), "warm_start");
  }
  sy_status SetOption(const char* name, const sy_value& value) {
    return table_->set_option(instance_, name, &value, &error_);
  }
  Answer Solve(const sy_control& control = Freely()) {
    const auto vars = static_cast<std::size_t>(vars_);
    const auto rows = static_cast<std::size_t>(rows_);
    Answer a;
    a.x.resize(vars);
    a.x_dual.resize(vars);
    a.row_dual.resize(rows);
    a.x_basis.resize(vars);
    a.row_basis.resize(rows);
    char text[256] = "";
    a.result.size = sizeof a.result;
    a.result.x = a.x.data();
    a.result.x_dual = a.x_dual.data();
    a.result.row_dual = a.row_dual.data();
    a.result.x_basis = a.x_basis.data();
    a.result.row_basis = a.row_basis.data();
    a.result.text = text;
    a.result.text_size = sizeof text;
    Expect(table_->solve(instance_, &control, &a.result, &error_), "solve");
    a.text = text;
    return a;
  }

  [[nodiscard]] bool Has(std::uint64_t trait) const { return (table_->traits & trait) != 0; }
  [[nodiscard]] bool Honors(std::uint64_t limit) const { return (table_->honors & limit) != 0; }
  [[nodiscard]] bool Updates(std::uint64_t kind) const { return (table_->updates & kind) != 0; }
  [[nodiscard]] const sy_solver& table() const { return *table_; }
  [[nodiscard]] sy_instance* instance() const { return instance_; }
  sy_host& host() { return host_; }
  sy_error& error() { return error_; }

 private:
  void Expect(sy_status status, const char* call) {
    EXPECT_EQ(status, SY_OK) << call << ": " << error_.text;
  }

  const sy_solver* table_;
  sy_host host_{};
  sy_instance* instance_ = nullptr;
  sy_error error_{};
  std::int32_t vars_ = 0;
  std::int32_t rows_ = 0;
};

}  // namespace switchyard::test
