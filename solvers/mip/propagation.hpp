// solvers/mip/propagation.hpp - the boxes of a node narrowed by rows, cones, groups and cutoff, at
// a cost proportional to what changed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solvers/mip/node_boxes.hpp"
#include "switchyard/abi.h"
#include "switchyard/boxes.hpp"
#include "switchyard/sos1_groups.hpp"

namespace switchyard::mip {

class Propagator;

/// The memory of propagation: one for each thread.
class Workspace {
 public:
  explicit Workspace(const Propagator& propagator);

  /// Entries of rows, cones, groups and objective visited so far: a measure of time that is the
  /// same in every run.
  [[nodiscard]] std::int64_t work() const { return work_; }

 private:
  friend class Narrowing;

  /// Numbers below a given one, each at most once, first in first out.
  class Queue {
   public:
    explicit Queue(std::size_t capacity) : waiting_(capacity) {}
    [[nodiscard]] bool empty() const { return count_ == 0; }
    void Push(std::int32_t i) {
      std::size_t end = first_ + count_++;
      if (end >= waiting_.size()) end -= waiting_.size();
      waiting_[end] = i;
    }
    std::int32_t Pop() {
      const std::int32_t i = waiting_[first_];
      if (++first_ == waiting_.size()) first_ = 0;
      --count_;
      return i;
    }

   private:
    std::vector<std::int32_t> waiting_;
    std::size_t first_ = 0, count_ = 0;
  };

  std::int64_t work_ = 0;
  std::vector<std::uint8_t> is_queued_;        // of each constraint
  Queue cheap_;                                // rows and groups, looked at first
  Queue cones_;                                // then these, and last the objective
  std::vector<Interval> ranges_;               // of the cone at hand
  std::vector<boxes_detail::Activity> least_;  // of the objective's terms
};

/// Propagation over a problem, as ProvenBoxes of boxes.hpp does it, and over its groups, for nodes
/// that differ from one another by few boxes: what is looked at again is what a change concerns.
///
/// No feasible point with an objective of at most the cutoff is ever outside of the boxes: all
/// rounding is outward, an integer's ends are integers (and what misses one by 1e-9 is one), and a
/// contradiction is one by more than 1e-9 relative. Functions of an nlp are not looked at, and with
/// one the cutoff is not used.
///
/// Const once made: threads share one, each with its own Workspace, on boxes of its own. Copies
/// what it needs of the problem.
class Propagator {
 public:
  /// Variables in `also_integer` are known to be integers at every feasible point (see
  /// implied_integers.hpp). Throws plugin::Failure (SY_E_ARGUMENT): "sy.sos1/1" does not fit.
  explicit Propagator(const sy_problem& problem, std::span<const std::int32_t> also_integer = {});
  Propagator(const Propagator&) = delete;
  Propagator& operator=(const Propagator&) = delete;

  /// The problem's bounds, integers' ends rounded inward; nothing is propagated yet.
  [[nodiscard]] NodeBoxes Bounds() const;

  /// Draws the consequences of what was imposed on the boxes since they were last propagated (of
  /// everything, where they never were), and of a cutoff below the last one. False: no point is
  /// left, and boxes.contradiction() says where that came out; then UndoTo a mark before.
  ///
  /// A narrowing has consequences where it is a thousandth of the range, or an integer's. What
  /// takes more than `kPasses` visits of every entry is left half done: boxes are as valid, only
  /// wider.
  bool Propagate(NodeBoxes& boxes, Workspace& workspace, double cutoff = kInfinity) const;

  /// In how many rows, cones, groups a variable stands, the objective among them.
  [[nodiscard]] std::int32_t NumConstraintsOf(std::int32_t j) const;
  [[nodiscard]] std::int32_t num_vars() const { return num_vars_; }
  /// Of rows, cones, groups and objective: the unit of work.
  [[nodiscard]] std::int64_t num_entries() const { return num_entries_; }

  static constexpr std::int64_t kPasses = 20;

 private:
  friend class Workspace;
  friend class Narrowing;

  /// A constraint that a variable stands in, and which changes of it concern the constraint.
  struct Watch {
    std::int32_t constraint;
    bool on_raise;  // of its lower end
    bool on_cut;    // of its upper end
  };

  /// A cone that is no product of half-lines, of rows first_row... of f_.
  struct ConeRows {
    sy_cone cone;
    std::int32_t index;  // in the problem
    std::int32_t first_row;
  };

  void TakeBounds(const sy_problem& problem);
  void TakeLinear(const sy_problem& problem);
  template <class Visit>
  void EachWatch(Visit&& visit) const;
  void WatchAll();

  [[nodiscard]] std::int32_t first_cone() const { return linear_.cols; }
  [[nodiscard]] std::int32_t first_group() const {
    return first_cone() + static_cast<std::int32_t>(cones_.size());
  }
  [[nodiscard]] std::int32_t objective() const { return first_group() + groups_.size(); }
  [[nodiscard]] Contradiction Of(std::int32_t constraint) const;

  // Constraints are numbered: linear rows, cones, groups, objective.
  std::int32_t num_vars_;
  std::vector<double> x_lower_, x_upper_;
  std::vector<std::uint8_t> integer_;
  Csc linear_;  // by rows: those of A, then those of zero and nonnegative cones
  std::vector<double> side_lower_, side_upper_;
  std::int32_t num_rows_;
  std::vector<std::int32_t> cone_of_row_;  // of the rows beyond num_rows_, by the problem's index
  Csc f_;                                  // by rows
  std::vector<double> g_;
  std::vector<ConeRows> cones_;
  Sos1Groups groups_;
  std::vector<boxes_detail::Term> terms_;  // nowhere above the objective, without the offset
  double offset_;
  bool use_cutoff_;  // no nlp
  std::int64_t num_entries_ = 0;
  std::vector<std::int32_t> watch_start_;  // num_vars + 1
  std::vector<Watch> watch_;
};

}  // namespace switchyard::mip
