#include "core/trajectory/segment_terms.hpp"

#include <algorithm>

#include "switchyard/sets/cartesian_product.hpp"
#include "switchyard/trajectory/bezier_curve.hpp"

namespace switchyard {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Derivative control points first, ..., first + count - 1: column j of M_k has the k + 1 points
/// from j on.
DerivativePoints Points(const SegmentShape& shape, int k, int first, int count, int place) {
  const int n = shape.num_positions;
  const Eigen::SparseMatrix<double> M = BezierDerivativeMap(shape.order, k);
  Triplets entries;
  for (int j = 0; j < count; ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator e(M, first + j); e; ++e) {
      const auto point = static_cast<int>(e.row()) - first;
      for (int i = 0; i < n; ++i) entries.emplace_back(j * n + i, point * n + i, e.value());
    }
  }
  DerivativePoints points{SparseMatrix(n * count, n * (count + k)), {}, place + shape.duration()};
  points.D.setFromTriplets(entries.begin(), entries.end());
  for (int i = 0; i < n * (count + k); ++i) points.places.push_back(place + n * first + i);
  return points;
}

/// The points of two neighbours in the control polygon, for each leg.
template <class C>
std::vector<PlacedTerm<C>> ForEachLeg(const SegmentShape& shape, const std::shared_ptr<C>& leg) {
  std::vector<PlacedTerm<C>> terms;
  for (int j = 0; j < shape.order; ++j) {
    PlacedTerm<C>& term = terms.emplace_back(PlacedTerm<C>{leg, {}, {}});
    for (int i = 0; i < 2 * shape.num_positions; ++i) {
      term.places.push_back(j * shape.num_positions + i);
    }
  }
  return terms;
}

/// (-W, W).
Eigen::MatrixXd Difference(const Eigen::MatrixXd& W) {
  Eigen::MatrixXd difference(W.rows(), 2 * W.cols());
  difference << -W, W;
  return difference;
}

std::vector<int> Joined(std::vector<int> a, const std::vector<int>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// (a A, -b B).
SparseMatrix Difference(double a, const SparseMatrix& A, double b, const SparseMatrix& B) {
  Triplets entries;
  for (int j = 0; j < A.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator e(A, j); e; ++e) {
      entries.emplace_back(e.row(), e.col(), a * e.value());
    }
  }
  for (int j = 0; j < B.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator e(B, j); e; ++e) {
      entries.emplace_back(e.row(), A.cols() + e.col(), -b * e.value());
    }
  }
  SparseMatrix both(A.rows(), A.cols() + B.cols());
  both.setFromTriplets(entries.begin(), entries.end());
  return both;
}

std::vector<int> LastPoint(const SegmentShape& u) {
  std::vector<int> places;
  for (int i = 0; i < u.num_positions; ++i) places.push_back(u.num_positions * u.order + i);
  return places;
}

}  // namespace

DerivativePoints AllDerivativePoints(const SegmentShape& shape, int k) {
  return Points(shape, k, 0, shape.order + 1 - k, 0);
}

DerivativePoints FirstDerivativePoint(const SegmentShape& shape, int k, int place) {
  return Points(shape, k, 0, 1, place);
}

DerivativePoints LastDerivativePoint(const SegmentShape& shape, int k) {
  return Points(shape, k, shape.order - k, 1, 0);
}

PlacedCost TimeCost(const SegmentShape& shape, double weight) {
  return {
      std::make_shared<LinearCost>(Eigen::VectorXd::Constant(1, weight)), {shape.duration()}, {}};
}

std::vector<PlacedCost> LengthCosts(const SegmentShape& shape, const Eigen::MatrixXd& W) {
  const auto leg = std::make_shared<L2NormCost>(Difference(W), Eigen::VectorXd::Zero(W.rows()));
  leg->set_description("path length");
  return ForEachLeg<Cost>(shape, leg);
}

std::vector<PlacedCost> EnergyCosts(const SegmentShape& shape, const Eigen::MatrixXd& W) {
  const Eigen::MatrixXd A = Difference(W);
  const auto leg = std::make_shared<QuadraticCost>(Eigen::MatrixXd(2 * A.transpose() * A),
                                                   Eigen::VectorXd::Zero(A.cols()), 0, true);
  leg->set_description("path energy");
  return ForEachLeg<Cost>(shape, leg);
}

PlacedConstraint ZeroRows(const DerivativePoints& points) {
  return {
      std::make_shared<LinearEqualityConstraint>(points.D, Eigen::VectorXd::Zero(points.D.rows())),
      points.places,
      {}};
}

PlacedConstraint JoinRows(const JointShape& shape, const Eigen::VectorXd& offset) {
  const DerivativePoints last = LastDerivativePoint(shape.u, 0);
  const DerivativePoints first = FirstDerivativePoint(shape.v, 0, shape.first_of_v());
  return {std::make_shared<LinearEqualityConstraint>(Difference(1, last.D, 1, first.D), -offset),
          Joined(last.places, first.places),
          {}};
}

PlacedConstraint PathContinuityRows(const JointShape& shape, int k,
                                    GraphOfConvexSets::TranscriptionSet in) {
  const DerivativePoints last = LastDerivativePoint(shape.u, k);
  const DerivativePoints first = FirstDerivativePoint(shape.v, k, shape.first_of_v());
  return {std::make_shared<LinearEqualityConstraint>(Difference(1, last.D, 1, first.D),
                                                     Eigen::VectorXd::Zero(last.D.rows())),
          Joined(last.places, first.places), in};
}

std::vector<PlacedConstraint> SubspaceTerms(const JointShape& shape, const ConvexSet& set,
                                            const Eigen::VectorXd& offset, int* num_slacks) {
  const Eigen::Index n = offset.size();
  *num_slacks = 0;
  if (const auto point = set.MaybeGetPoint()) {
    return {{std::make_shared<LinearEqualityConstraint>(Eigen::MatrixXd::Identity(n, n),
                                                        *point - offset),
             LastPoint(shape.u),
             {}}};
  }
  MathematicalProgram program;
  const VectorXDecisionVariable x = program.NewContinuousVariables(static_cast<int>(n));
  const auto added = offset.isZero(0) ? set.AddPointInSetConstraints(&program, x)
                                      : CartesianProduct(MakeConvexSets(set),
                                                         Eigen::MatrixXd::Identity(n, n), offset)
                                            .AddPointInSetConstraints(&program, x);
  *num_slacks = static_cast<int>(added.first.size());
  const std::vector<int> last = LastPoint(shape.u);
  std::vector<PlacedConstraint> terms;
  for (const Binding<Constraint>& binding : added.second) {
    PlacedConstraint& term = terms.emplace_back(PlacedConstraint{binding.evaluator(), {}, {}});
    for (const Variable v : binding.variables()) {
      const auto own = std::find(added.first.begin(), added.first.end(), v);
      const auto at = std::find(x.begin(), x.end(), v) - x.begin();
      term.places.push_back(own == added.first.end()
                                ? last[static_cast<std::size_t>(at)]
                                : shape.first_slack() +
                                      static_cast<int>(own - added.first.begin()));
    }
  }
  return terms;
}

}  // namespace switchyard
