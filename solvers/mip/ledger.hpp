// solvers/mip/ledger.hpp - what one worker tells the others and hears of them: at once, or, so that
// the tree does not depend on who is faster, between rounds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "solvers/mip/incumbents.hpp"
#include "solvers/mip/node.hpp"
#include "solvers/mip/pseudocosts.hpp"
#include "solvers/mip/shared.hpp"

namespace switchyard::mip {

class Ledger {
 public:
  /// `in_rounds`: what is heard is what was so at BeginRound, and what this worker itself found
  /// since; what is told is told by Settle.
  Ledger(Shared& shared, std::size_t worker, bool in_rounds)
      : shared_(shared), worker_(worker), in_rounds_(in_rounds) {}

  void BeginRound();
  void Settle();

  // ---- As Shared has them ----

  void Push(NodePointer node);
  void Done();
  void Holds(double bound);
  void Close(double bound);
  void GiveUp(NodePointer node);
  void CountNode(std::int64_t iterations);
  void Offer(double objective, const std::vector<double>& x);
  void See(const Step& step, double gain);
  [[nodiscard]] double best() const { return in_rounds_ ? best_ : shared_.best(); }
  [[nodiscard]] double cutoff() const { return in_rounds_ ? cutoff_ : shared_.cutoff(); }
  [[nodiscard]] double Bound() const { return in_rounds_ ? bound_ : shared_.Bound(); }
  [[nodiscard]] Pseudocosts Learned() const { return in_rounds_ ? *learned_ : shared_.Learned(); }
  /// Best points of others, each told once.
  [[nodiscard]] std::vector<std::vector<double>> NewPoints();
  [[nodiscard]] bool Stopped() { return shared_.Stopped(); }
  [[nodiscard]] rounding::Budget& budget() { return shared_.budget(); }

  /// Nodes of this worker.
  [[nodiscard]] std::int64_t nodes() const { return nodes_; }
  /// In this round.
  [[nodiscard]] std::int64_t nodes_of_round() const { return nodes_ - before_; }
  [[nodiscard]] bool in_rounds() const { return in_rounds_; }

 private:
  Shared& shared_;
  const std::size_t worker_;
  const bool in_rounds_;
  std::int64_t nodes_ = 0, before_ = 0, iterations_ = 0;
  std::size_t known_points_ = 0;  // of the others'

  // As it was when the round began.
  double best_ = kInfinity, cutoff_ = kInfinity, bound_ = -kInfinity;
  std::optional<Pseudocosts> learned_;
  std::vector<std::vector<double>> points_;

  // To be told.
  std::vector<NodePointer> pushed_, given_up_;
  std::vector<double> closed_;
  std::vector<Solution> offered_;
  std::vector<std::pair<Step, double>> seen_;
  bool done_ = false;
};

}  // namespace switchyard::mip
