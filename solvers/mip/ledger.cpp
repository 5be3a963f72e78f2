#include "solvers/mip/ledger.hpp"

#include <algorithm>

namespace switchyard::mip {

void Ledger::BeginRound() {
  best_ = shared_.best();
  cutoff_ = shared_.cutoff();
  bound_ = shared_.Bound();
  learned_ = shared_.Learned();
  points_ = shared_.BestPointsFrom(known_points_);
  known_points_ += points_.size();
  before_ = nodes_;
  iterations_ = 0;
  done_ = false;
}

void Ledger::Settle() {
  for (NodePointer& node : pushed_) shared_.Push(std::move(node));
  for (const double bound : closed_) shared_.Close(bound);
  for (NodePointer& node : given_up_) shared_.GiveUp(std::move(node));
  for (const Solution& one : offered_) shared_.Offer(one.objective, one.x);
  for (const auto& [step, gain] : seen_) shared_.See(step, gain);
  for (std::int64_t k = nodes_of_round(); k > 0; --k) shared_.CountNode(k == 1 ? iterations_ : 0);
  if (done_) shared_.Done(worker_);
  pushed_.clear();
  closed_.clear();
  given_up_.clear();
  offered_.clear();
  seen_.clear();
}

void Ledger::Push(NodePointer node) {
  if (!in_rounds_) return shared_.Push(std::move(node));
  pushed_.push_back(std::move(node));
}

void Ledger::Done() {
  if (!in_rounds_) return shared_.Done(worker_);
  done_ = true;
}

// In rounds the bound of the node that was taken stands for all that came of it.
void Ledger::Holds(double bound) {
  if (!in_rounds_) shared_.Holds(worker_, bound);
}

void Ledger::Close(double bound) {
  if (!in_rounds_) return shared_.Close(bound);
  closed_.push_back(bound);
}

void Ledger::GiveUp(NodePointer node) {
  if (!in_rounds_) return shared_.GiveUp(std::move(node));
  given_up_.push_back(std::move(node));
}

void Ledger::CountNode(std::int64_t iterations) {
  ++nodes_;
  iterations_ += iterations;
  if (!in_rounds_) shared_.CountNode(iterations);
}

void Ledger::Offer(double objective, const std::vector<double>& x) {
  if (!in_rounds_) {
    shared_.Offer(objective, x);
    return;
  }
  if (!(objective < shared_.budget().control().cutoff)) return;
  offered_.push_back({objective, x});
  best_ = std::min(best_, objective);
  cutoff_ = std::min(cutoff_, Threshold(shared_.budget().control(), objective));
}

void Ledger::See(const Step& step, double gain) {
  if (!in_rounds_) return shared_.See(step, gain);
  seen_.emplace_back(step, gain);
  if (step.variable >= 0) learned_->See(step.variable, step.up, step.distance, gain);
}

std::vector<std::vector<double>> Ledger::NewPoints() {
  if (in_rounds_) return std::exchange(points_, {});
  std::vector<std::vector<double>> points = shared_.BestPointsFrom(known_points_);
  known_points_ += points.size();
  return points;
}

}  // namespace switchyard::mip
