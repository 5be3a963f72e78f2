// core/trajectory/segment_terms.hpp - costs and constraints of segments and of the joints between
// them, over places of their variables, so that all that have the same shape share an evaluator.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "switchyard/gcs/graph_of_convex_sets.hpp"

namespace switchyard {

/// The variables of a segment: n x (order + 1) control points by columns, then the duration h in
/// [h_min, h_max] seconds. As places: 0 is the first coordinate of the first point.
struct SegmentShape {
  int num_positions = 0;
  int order = 0;
  double h_min = 0;
  double h_max = 0;
  [[nodiscard]] int size() const { return num_positions * (order + 1) + 1; }
  [[nodiscard]] int duration() const { return size() - 1; }
  [[nodiscard]] bool has_fixed_duration() const { return h_min == h_max; }
};

/// An evaluator, and the places of the variables that it is for. At a joint the places of the
/// second segment follow those of the first, and slacks of the edge follow both.
template <class C>
struct PlacedTerm {
  std::shared_ptr<C> evaluator;
  std::vector<int> places;
  GraphOfConvexSets::TranscriptionSet in;
};
using PlacedCost = PlacedTerm<Cost>;
using PlacedConstraint = PlacedTerm<Constraint>;

/// lower <= d^order q / dt^order <= upper, by joint; infinite sides are free.
struct DerivativeBound {
  int order = 1;
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
};

/// Some control points of the k-th derivative of r: D times what is at `places`; row j n + i is
/// coordinate i of the j-th of them. By the map M_k of BezierDerivativeMap. No duration is in it.
struct DerivativePoints {
  SparseMatrix D;
  std::vector<int> places;
  int duration = 0;  // its place
};
/// All order + 1 - k of them, the first, the last; k <= order. `place`: of the segment's first
/// variable.
DerivativePoints AllDerivativePoints(const SegmentShape& shape, int k);
DerivativePoints FirstDerivativePoint(const SegmentShape& shape, int k, int place);
DerivativePoints LastDerivativePoint(const SegmentShape& shape, int k);

// ---- Costs of a segment ----

PlacedCost TimeCost(const SegmentShape& shape, double weight);
/// |W (r_{j+1} - r_j)| for each leg of the control polygon; all share one evaluator.
std::vector<PlacedCost> LengthCosts(const SegmentShape& shape, const Eigen::MatrixXd& W);
/// |W (r_{j+1} - r_j)|^2, likewise.
std::vector<PlacedCost> EnergyCosts(const SegmentShape& shape, const Eigen::MatrixXd& W);

// ---- Bounds of derivatives ----

/// h lower <= points <= h upper, of first derivatives; none where all sides are infinite.
std::optional<PlacedConstraint> VelocityRows(const DerivativePoints& points,
                                             const DerivativeBound& bound);

/// h^N lower <= points <= h^N upper, N = bound.order: for the mixed-integer program and the
/// restriction as it stands; for the relaxation rows that every such point satisfies. Over
/// [h_min, h_max], h^N is below its chord and above its tangents: where the right-hand side is
/// concave in h, a chord bounds it, where it is convex, tangents do. Sides that are linear (bound
/// 0, or a fixed duration) stand in all three as they are.
std::vector<PlacedConstraint> DerivativeRows(const DerivativePoints& points,
                                             const DerivativeBound& bound,
                                             const SegmentShape& shape);

/// h0^{N-1} h lower <= points <= h0^{N-1} h upper in the relaxation: what guides, and bounds
/// nothing.
std::optional<PlacedConstraint> SurrogateRows(const DerivativePoints& points,
                                              const DerivativeBound& bound, double h0);

/// points = 0.
PlacedConstraint ZeroRows(const DerivativePoints& points);

// ---- Joints ----

struct JointShape {
  SegmentShape u;
  SegmentShape v;
  [[nodiscard]] int first_of_v() const { return u.size(); }
  [[nodiscard]] int first_slack() const { return u.size() + v.size(); }
};

/// The last point of u plus the offset is the first of v.
PlacedConstraint JoinRows(const JointShape& shape, const Eigen::VectorXd& offset);
/// d^k r_u / ds^k at its end is d^k r_v / ds^k at its start.
PlacedConstraint PathContinuityRows(const JointShape& shape, int k,
                                    GraphOfConvexSets::TranscriptionSet in = {});
/// (d^k r_u / ds^k) h_v^k = (d^k r_v / ds^k) h_u^k, in the mixed-integer program and the
/// restriction; in all three where both durations are fixed, which makes it linear.
PlacedConstraint TimeContinuityRows(const JointShape& shape, int k);
/// The last point of u plus the offset is in the set. `num_slacks`: of its own variables, if any.
std::vector<PlacedConstraint> SubspaceTerms(const JointShape& shape, const ConvexSet& set,
                                            const Eigen::VectorXd& offset, int* num_slacks);

}  // namespace switchyard
