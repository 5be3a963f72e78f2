#include "solvers/mip/shared.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

namespace switchyard::mip {

Shared::Shared(const sy_problem& problem, std::size_t pool, rounding::Budget& budget)
    : budget_(budget),
      incumbents_(pool),
      pseudocosts_(problem.num_vars),
      cutoff_(Threshold(budget.control(), kInfinity)) {}

void Shared::SetWorkers(std::size_t count) {
  const std::lock_guard lock(mutex_);
  held_.assign(count, kInfinity);
  at_work_.assign(count, 0);
}

void Shared::Push(NodePointer node) {
  const std::lock_guard lock(mutex_);
  auto numbered = std::make_shared<Node>(*node);
  numbered->number = number_++;
  open_.Push(std::move(numbered));
  changed_.notify_one();
}

// Nothing: there is none that is worth it now.
NodePointer Shared::PopLocked(std::size_t worker) {
  if (open_.empty()) return nullptr;
  if (open_.least_bound() >= cutoff_) {  // then all are
    while (!open_.empty()) closed_ = std::min(closed_, open_.Pop()->bound);
    return nullptr;
  }
  NodePointer node = open_.Pop();
  at_work_[worker] = 1;
  held_[worker] = node->bound;
  return node;
}

NodePointer Shared::Pop(std::size_t worker) {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (StoppedLocked()) return nullptr;
    if (NodePointer node = PopLocked(worker)) return node;
    const bool others =
        std::any_of(at_work_.begin(), at_work_.end(), [](std::uint8_t w) { return w != 0; });
    if (!others) {
      changed_.notify_all();
      return nullptr;
    }
    changed_.wait_for(lock, std::chrono::milliseconds(20));
  }
}

std::vector<NodePointer> Shared::PopSome(std::size_t count) {
  std::vector<NodePointer> nodes;
  const std::lock_guard lock(mutex_);
  if (StoppedLocked()) return nodes;
  while (nodes.size() < count) {
    NodePointer node = PopLocked(nodes.size());
    if (node == nullptr) break;
    nodes.push_back(std::move(node));
  }
  return nodes;
}

void Shared::Done(std::size_t worker) {
  const std::lock_guard lock(mutex_);
  at_work_[worker] = 0;
  held_[worker] = kInfinity;
  changed_.notify_all();
}

void Shared::Holds(std::size_t worker, double bound) {
  const std::lock_guard lock(mutex_);
  held_[worker] = bound;
}

void Shared::Close(double bound) {
  const std::lock_guard lock(mutex_);
  closed_ = std::min(closed_, bound);
}

void Shared::GiveUp(NodePointer node) {
  const std::lock_guard lock(mutex_);
  if (incumbents_.empty()) {
    waiting_.push_back(std::move(node));
    return;
  }
  unproven_ = std::min(unproven_, node->bound);
  ++given_up_;
}

std::size_t Shared::given_up() const {
  const std::lock_guard lock(mutex_);
  return given_up_ + waiting_.size();
}

void Shared::CountNode(std::int64_t iterations) {
  iterations_ += iterations;
  const std::int64_t count = ++nodes_;
  constexpr std::int64_t kTellEvery = 16;
  if (count % kTellEvery != 0) return;
  const std::lock_guard lock(mutex_);
  TellLocked(nullptr);
}

bool Shared::Offer(double objective, const std::vector<double>& x) {
  if (!(objective < budget_.control().cutoff)) return false;
  const std::lock_guard lock(mutex_);
  if (!incumbents_.Offer(objective, x)) return false;
  best_points_.push_back(x);
  best_ = objective;
  cutoff_ = Threshold(budget_.control(), objective);
  for (NodePointer& node : waiting_) open_.Push(std::move(node));
  waiting_.clear();
  TellLocked(x.data());
  return true;
}

std::vector<std::vector<double>> Shared::BestPointsFrom(std::size_t k) const {
  const std::lock_guard lock(mutex_);
  std::vector<std::vector<double>> points;
  for (; k < best_points_.size(); ++k) points.push_back(best_points_[k]);
  return points;
}

void Shared::See(const Step& step, double gain) {
  if (step.variable < 0) return;
  const std::lock_guard lock(mutex_);
  pseudocosts_.See(step.variable, step.up, step.distance, gain);
}

Pseudocosts Shared::Learned() const {
  const std::lock_guard lock(mutex_);
  return pseudocosts_;
}

bool Shared::Stopped() {
  const std::lock_guard lock(mutex_);
  return StoppedLocked();
}

bool Shared::StoppedLocked() {
  return budget_.Stopped() || node_limit() || !failure_.empty() ||
         incumbents_.objective() <= budget_.control().target;
}

double Shared::BoundLocked() const {
  double bound = std::min({open_.least_bound(), closed_, unproven_});
  for (const double held : held_) bound = std::min(bound, held);
  for (const NodePointer& node : waiting_) bound = std::min(bound, node->bound);
  proven_ = std::max(proven_, std::min(bound, incumbents_.objective()));
  return proven_;
}

double Shared::Bound() const {
  const std::lock_guard lock(mutex_);
  return BoundLocked();
}

std::size_t Shared::open() const {
  const std::lock_guard lock(mutex_);
  return open_.size();
}

void Shared::TellLocked(const double* incumbent) {
  const double objective =
      incumbents_.empty() ? std::numeric_limits<double>::quiet_NaN() : incumbents_.objective();
  budget_.TellOfTree(objective, BoundLocked(), incumbent, nodes_,
                     static_cast<std::int64_t>(open_.size()));
}

void Shared::Fail(const std::string& why) {
  const std::lock_guard lock(mutex_);
  if (failure_.empty()) failure_ = why;
  changed_.notify_all();
}

std::string Shared::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

}  // namespace switchyard::mip
