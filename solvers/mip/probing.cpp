#include "solvers/mip/probing.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <utility>

namespace switchyard::mip {
namespace {

bool IsOpenBinary(const NodeBoxes& boxes, std::int32_t j) {
  return boxes.IsInteger(j) && boxes.lower(j) == 0 && boxes.upper(j) == 1;
}

class Prober {
 public:
  Prober(const Propagator& propagator, const ProbingOptions& options, NodeBoxes& boxes,
         Workspace& workspace)
      : propagator_(propagator), options_(options), boxes_(boxes), workspace_(workspace) {}

  ProbingResult Run(std::span<const std::int32_t> candidates) {
    const auto before = boxes_.Now();
    bool left = Propagate();
    for (const std::int32_t j : candidates) {
      if (!left || Stopped()) break;
      if (IsOpenBinary(boxes_, j)) left = ProbeOne(j);
      ++result_.probed;
    }
    result_.infeasible = !left;
    result_.complete = !left || result_.probed == static_cast<std::int32_t>(candidates.size());
    CountFixed(before);
    return std::move(result_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool Stopped() const {
    const std::chrono::duration<double> passed = Clock::now() - begin_;
    return workspace_.work() - first_work_ >= options_.work || passed.count() >= options_.seconds;
  }
  bool Propagate() { return propagator_.Propagate(boxes_, workspace_, options_.cutoff); }

  /// Is a point left? Its consequences are in the boxes then.
  bool ProbeOne(std::int32_t j) {
    const bool zero_left = Try(j, false);
    const bool one_left = Try(j, true);
    if (!zero_left || !one_left) {
      boxes_.Impose(j, zero_left ? 0 : 1, one_left ? 1 : 0);
      return Propagate();
    }
    return !TakeUnion(j) || Propagate();
  }

  /// Propagates x_j = value, and leaves the boxes as they were. Is a point left?
  bool Try(std::int32_t j, bool value) {
    const auto mark = boxes_.Now();
    boxes_.Impose(j, value ? 1 : 0, value ? 1 : 0);
    const bool left = Propagate();
    if (left) boxes_.NarrowedSince(mark, narrowed_[value ? 1 : 0]);
    boxes_.UndoTo(mark);
    if (left && options_.record_implications) Record(j, value);
    return left;
  }

  void Record(std::int32_t j, bool value) {
    for (const VariableBox& box : narrowed_[value ? 1 : 0]) {
      if (box.variable == j || !IsOpenBinary(boxes_, box.variable)) continue;
      result_.implications.push_back({j, box.variable, value, box.lower == 1});
    }
  }

  /// Narrows each box to what both cases leave of it: those that both of them narrowed. Was any?
  bool TakeUnion(std::int32_t j) {
    const std::size_t changes = boxes_.Now().num_changes;
    auto other = narrowed_[1].begin();
    for (const VariableBox& zero : narrowed_[0]) {
      while (other != narrowed_[1].end() && other->variable < zero.variable) ++other;
      if (other == narrowed_[1].end()) break;
      if (other->variable != zero.variable || zero.variable == j) continue;
      const std::int32_t i = zero.variable;
      const double lower = std::min(zero.lower, other->lower);
      const double upper = std::max(zero.upper, other->upper);
      result_.tightened += (lower > boxes_.lower(i) ? 1 : 0) + (upper < boxes_.upper(i) ? 1 : 0);
      boxes_.Impose(i, lower, upper);
    }
    return boxes_.Now().num_changes > changes;
  }

  void CountFixed(const NodeBoxes::Mark& before) {
    for (const VariableBox& box : boxes_.NarrowedSince(before)) {
      if (boxes_.IsInteger(box.variable) && box.lower == box.upper) ++result_.fixed;
    }
  }

  const Propagator& propagator_;
  const ProbingOptions& options_;
  NodeBoxes& boxes_;
  Workspace& workspace_;
  const Clock::time_point begin_ = Clock::now();
  const std::int64_t first_work_ = workspace_.work();
  std::vector<VariableBox> narrowed_[2];  // by x_j = 0 and by x_j = 1
  ProbingResult result_;
};

}  // namespace

ProbingResult Probe(const Propagator& propagator, std::span<const std::int32_t> candidates,
                    const ProbingOptions& options, NodeBoxes& boxes, Workspace& workspace) {
  return Prober(propagator, options, boxes, workspace).Run(candidates);
}

std::vector<std::int32_t> BinariesByConstraints(const Propagator& propagator,
                                                const NodeBoxes& boxes) {
  std::vector<std::int32_t> binaries;
  for (std::int32_t j = 0; j < propagator.num_vars(); ++j) {
    if (IsOpenBinary(boxes, j)) binaries.push_back(j);
  }
  std::stable_sort(binaries.begin(), binaries.end(), [&](std::int32_t a, std::int32_t b) {
    return propagator.NumConstraintsOf(a) > propagator.NumConstraintsOf(b);
  });
  return binaries;
}

}  // namespace switchyard::mip
