// core/sets/meeting.hpp - does a set that is moved meet another?
#pragma once

#include <cstdint>
#include <optional>

#include "core/linalg/dense_lp.hpp"
#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

/// A box grown by a ball: {x + u : lower <= x <= upper, |u|_2 <= radius}. Points, boxes and balls
/// are such sets, and two of them meet where their boxes are not farther apart than the radii.
struct RoundedBox {
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
  double radius = 0;
};

/// A set with what its meetings with others are told from.
struct MeetingSet {
  explicit MeetingSet(const ConvexSet& the_set);
  const ConvexSet* set;
  std::optional<RoundedBox> rounded;
  std::optional<Eigen::VectorXd> point;
  std::optional<DenseLp> rows;  // of a small polyhedron, over (x, w)
};

/// The range of x in a meeting, where it is known: proven boxes of the two sets, the second one's
/// less the offset.
struct MeetingRange {
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
};

enum class MeetingProof : std::uint8_t { kClosedForm, kLinearProgram, kIntersection };

/// Decides meetings one after the other; one for each thread.
class MeetingJudge {
 public:
  /// Is x + tau in b for some x of a? Throws std::runtime_error where no backend could tell.
  bool Meet(const MeetingSet& a, const MeetingSet& b, const Eigen::VectorXd& tau,
            const MeetingRange& range);
  /// How the last one was decided.
  [[nodiscard]] MeetingProof proof() const { return proof_; }

 private:
  std::optional<bool> ByLp(const MeetingSet& a, const MeetingSet& b, const Eigen::VectorXd& tau,
                           const MeetingRange& range);
  DenseLp lp_;
  DenseSimplex simplex_;
  MeetingProof proof_ = MeetingProof::kClosedForm;
};

}  // namespace switchyard
