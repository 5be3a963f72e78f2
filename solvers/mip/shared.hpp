// solvers/mip/shared.hpp - what the workers of one solve have in common: open nodes, the best
// points, pseudocosts, limits.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "solvers/mip/branching.hpp"
#include "solvers/mip/incumbents.hpp"
#include "solvers/mip/node.hpp"
#include "solvers/mip/pseudocosts.hpp"
#include "solvers/rounding/budget.hpp"

namespace switchyard::mip {

/// The tree of one solve. Every member may be called from any thread.
///
/// The bound is the least of those of open nodes, of nodes at work, and of nodes that were given
/// up: within the gap, or because nothing about them could be proven.
class Shared {
 public:
  Shared(const sy_problem& problem, std::size_t pool, rounding::Budget& budget);

  // ---- Nodes ----

  void Push(NodePointer node);
  /// The next one for a worker; waits while there is none but others may open some. Nothing where
  /// all is done, or the solve must stop.
  NodePointer Pop(std::size_t worker);
  /// The best ones, at most `count`, the k-th for worker k; none where all is done, or the solve
  /// must stop. While no worker is at work.
  std::vector<NodePointer> PopSome(std::size_t count);
  /// The worker is through with its node, all of whose rest is closed.
  void Done(std::size_t worker);
  /// The least bound of what the worker has at hand.
  void Holds(std::size_t worker, double bound);
  /// A node within the gap, or above the cutoff: closed with this bound.
  void Close(double bound);
  /// A node about which nothing more can be proven. While there is no point it waits for one: a
  /// cutoff makes boxes finite, and so proofs possible.
  void GiveUp(NodePointer node);
  void CountNode(std::int64_t iterations);

  // ---- Points ----

  /// A verified point. Is it the best, and below the cutoff that was asked for?
  bool Offer(double objective, const std::vector<double>& x);
  /// Of the best one; infinity where there is none.
  [[nodiscard]] double best() const { return best_; }
  /// See Threshold.
  [[nodiscard]] double cutoff() const { return cutoff_; }
  /// Points that were the best when they were found, from the k-th on.
  [[nodiscard]] std::vector<std::vector<double>> BestPointsFrom(std::size_t k) const;

  // ---- What was learned ----

  void See(const Step& step, double gain);
  [[nodiscard]] Pseudocosts Learned() const;

  // ---- The whole ----

  [[nodiscard]] bool Stopped();
  [[nodiscard]] rounding::Budget& budget() { return budget_; }
  [[nodiscard]] double Bound() const;
  /// While no worker runs.
  [[nodiscard]] const Incumbents& incumbents() const { return incumbents_; }
  [[nodiscard]] std::int64_t nodes() const { return nodes_; }
  [[nodiscard]] std::int64_t iterations() const { return iterations_; }
  /// Nodes about which nothing could be proven.
  [[nodiscard]] std::size_t given_up() const;
  [[nodiscard]] std::size_t open() const;
  [[nodiscard]] bool node_limit() const { return nodes_ >= budget_.control().nodes; }
  /// What a worker threw; the first stands.
  void Fail(const std::string& why);
  [[nodiscard]] std::string failure() const;
  void SetWorkers(std::size_t count);

 private:
  NodePointer PopLocked(std::size_t worker);
  [[nodiscard]] bool StoppedLocked();
  [[nodiscard]] double BoundLocked() const;
  void TellLocked(const double* incumbent);

  rounding::Budget& budget_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  OpenNodes open_;
  std::vector<double> held_;           // by worker; infinity: nothing
  std::vector<std::uint8_t> at_work_;  // by worker
  Incumbents incumbents_;
  std::vector<std::vector<double>> best_points_;
  Pseudocosts pseudocosts_;
  std::atomic<double> best_ = kInfinity;
  std::atomic<double> cutoff_;
  double closed_ = kInfinity, unproven_ = kInfinity;
  std::vector<NodePointer> waiting_;  // for a point
  std::int64_t number_ = 0;
  std::size_t given_up_ = 0;
  std::atomic<std::int64_t> nodes_ = 0, iterations_ = 0;
  mutable double proven_ = -kInfinity;  // what was proven stays so
  std::string failure_;
};

}  // namespace switchyard::mip
