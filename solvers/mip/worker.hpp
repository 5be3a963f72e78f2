// solvers/mip/worker.hpp - one that takes open nodes and goes down from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "solvers/mip/conic_engine.hpp"
#include "solvers/mip/engine.hpp"
#include "solvers/mip/instance.hpp"
#include "solvers/mip/ledger.hpp"
#include "solvers/mip/outer_engine.hpp"
#include "solvers/rounding/candidates.hpp"

namespace switchyard::mip {

class Worker {
 public:
  Worker(const Instance& instance, Ledger ledger);

  /// Down from a node, child by child; what is left of it in the end is closed or open. In rounds
  /// after some nodes what is at hand is open again.
  void Plunge(NodePointer node);
  [[nodiscard]] Ledger& ledger() { return ledger_; }
  /// See Engine.
  void See(const std::vector<double>& x) { engine_->See(x); }

 private:
  /// What became of a node.
  enum class End { kClosed, kAgain, kSplit };

  bool Enter(const Node& node);
  bool Propagate();
  bool Look();
  Relaxed Relax(int rounds);
  Relaxed RelaxOtherwise();
  End Judge(Relaxed& relaxed);
  End JudgePoint(Relaxed& relaxed);
  End JudgeIntegral(Relaxed& relaxed);
  void JudgeLeaf(const Relaxed& rest);
  void TryPoint(std::vector<double> x, double tolerance = kFeasible);
  /// What the engine of rests found last.
  void TryRest(const std::vector<double>& x);
  /// Of the integers of a point: their best continuous rest.
  Relaxed SolveFixed(const std::vector<double>& x);
  /// The engine of such rests.
  ConicEngine& Fixed();
  void TryPaths(const std::vector<double>& x);
  void TryRounding(const std::vector<double>& x);
  void TryNear(const std::vector<double>& x);
  void NarrowByReducedCosts(const Relaxed& relaxed, double cutoff);
  bool Descend(Split split);
  void GiveUp(double bound);
  void LearnFrom(const Relaxed& relaxed);
  [[nodiscard]] bool IsFixed() const;
  [[nodiscard]] bool IsWorthGoingOn() const;
  [[nodiscard]] std::vector<VariableBox> Decided() const;

  const Instance& instance_;
  Ledger ledger_;
  Workspace workspace_;
  std::unique_ptr<Engine> engine_;
  std::optional<ConicEngine> fixed_;  // these are made where they are needed
  std::optional<OuterEngine> spare_;
  rounding::Options path_options_;
  std::vector<rounding::Candidate> paths_;  // tried so far
  NodeBoxes boxes_;
  NodeBoxes::Mark mark_;  // where the node at hand began
  NodePointer node_;      // at hand
  double bound_ = -kInfinity;
  double cutoff_ = kInfinity;             // that the node at hand is looked at with
  bool took_root_ = false;                // of the root, what was known before
  int length_ = 0;                        // of the plunge
  std::int64_t near_at_ = 8;              // nodes after which the best neighborhood is searched
  std::vector<double> best_x_;            // that it has heard of
  std::set<std::vector<double>> solved_;  // integers of which the rest was solved
};

}  // namespace switchyard::mip
