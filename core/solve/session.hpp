// core/solve/session.hpp - the road from a program to an answer, once or again and again.
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "core/host/instance.hpp"
#include "core/lower/lowering.hpp"
#include "core/solve/choice.hpp"
#include "core/solve/control.hpp"
#include "core/solve/recovery.hpp"
#include "core/solve/solve_log.hpp"
#include "switchyard/solve/solve.hpp"

namespace switchyard {

struct SolverSession::State {
  State(const MathematicalProgram& p, std::string n, SolverOptions o, Host& h, bool k)
      : program(p), names(std::move(n)), given(std::move(o)), keeps(k), host(h) {}

  MathematicalProgramResult Solve(const std::optional<Eigen::VectorXd>& guess);

  const MathematicalProgram& program;
  const std::string names;
  const SolverOptions given;
  const bool keeps;  // updates may follow
  Host& host;
  std::optional<Lowering> lowering;
  SolverOptions options;  // those given, and of the rest those of the program
  std::unique_ptr<SolveLog> log;
  std::unique_ptr<Instance> instance;  // of the host's table over the chosen backend
  const Backend* backend = nullptr;
  std::vector<Considered> considered;

 private:
  using Clock = std::chrono::steady_clock;

  void TakeOptions();
  std::uint64_t Lower();
  bool HandOver(const std::optional<Eigen::VectorXd>& guess, MathematicalProgramResult& result);
  void ChooseForm();
  bool Choose(MathematicalProgramResult& result);
  void SendChanges();
  void Start(const std::optional<Eigen::VectorXd>& guess);
  void Run(MathematicalProgramResult& result);
  bool RunOnce(const sy_control& control, MathematicalProgramResult& result);
  void ReadPool(Recovery& recovery);
  void Describe(MathematicalProgramResult& result) const;
  [[nodiscard]] sy_control Control();
  [[nodiscard]] double Spent() const;

  std::uint64_t unsent_ = 0;  // what changed since the backend was last told
  Clock::time_point began_;
  std::optional<SolveControl> control_;
};

}  // namespace switchyard
