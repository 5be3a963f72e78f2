#include "core/sets/affine_hull.hpp"

#include <Eigen/QR>
#include <cmath>

#include "core/linalg/implicit_equalities.hpp"
#include "core/sets/section_lp.hpp"
#include "core/sets/set_program.hpp"
#include "switchyard/error.hpp"
#include "switchyard/solve/solve.hpp"

namespace switchyard {
namespace {

/// The step from p, with entries of at most 1, to a point of the set that is farthest along d.
Eigen::VectorXd FarthestStep(const ConvexSet& set, const Eigen::VectorXd& p,
                             const Eigen::VectorXd& d) {
  const auto n = static_cast<int>(p.size());
  MathematicalProgram program;
  const VectorXDecisionVariable step = program.NewContinuousVariables(n, "step");
  set.AddPointInNonnegativeScalingConstraints(&program, Eigen::MatrixXd::Identity(n, n), p,
                                              Eigen::VectorXd(), 1, step, VariableList());
  program.AddBoundingBoxConstraint(-1, 1, step);
  program.AddLinearCost(-d, step);
  const MathematicalProgramResult result = Solve(program);
  if (!result.is_success()) CouldNotTell(set.Kind(), "the affine hull", result);
  return result.GetSolution(step);
}

/// Of a small polyhedron over x alone: what is orthogonal to the rows that hold with equality
/// everywhere, at a point where all others are strict.
std::optional<AffineHull> ByImplicitEqualities(const ConvexSet& set) {
  const ScaledSet& scaled = set.scaled();
  const Eigen::Index n = set.ambient_dimension();
  if (n == 0 || scaled.num_aux > 0 || !IsSmallPolyhedron(scaled)) return std::nullopt;
  const DenseLp lp = SectionLp(scaled, Eigen::VectorXd::Zero(n));
  const ImplicitEqualities found = FindImplicitEqualities(lp);
  if (found.status != DenseLpStatus::kOptimal) return std::nullopt;
  Eigen::MatrixXd across(n, static_cast<Eigen::Index>(found.equalities.size()));
  for (Eigen::Index k = 0; k < across.cols(); ++k) {
    const int row = found.equalities[static_cast<std::size_t>(k)].row;
    across.col(k) = row < lp.num_rows()
                        ? Eigen::VectorXd(Eigen::VectorXd::Map(lp.A.data() + row * n, n))
                        : Eigen::VectorXd(Eigen::VectorXd::Unit(n, row - lp.num_rows()));
    if (across.col(k).squaredNorm() > 0) across.col(k).normalize();
  }
  Eigen::MatrixXd Q = Eigen::MatrixXd::Identity(n, n);
  Eigen::Index rank = 0;
  if (across.cols() > 0) {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(across);
    qr.setThreshold(1e-9);
    rank = qr.rank();
    Q = qr.householderQ();
  }
  return AffineHull{Eigen::VectorXd::Map(found.x.data(), n), Q.rightCols(n - rank)};
}

}  // namespace

// Each direction that is orthogonal to all found so far either has a point of the set off the
// hyperplane through p, and then the step there is a new direction of the hull, or the hull is
// orthogonal to it; n directions in all.
AffineHull AffineHullOf(const ConvexSet& set, double tol) {
  Require(tol >= 0, "an affine hull needs a tolerance of at least 0, got ", tol);
  if (tol == kAffineHullTolerance) {  // which is that of the rows found there
    if (auto hull = ByImplicitEqualities(set)) return std::move(*hull);
  }
  const std::optional<Eigen::VectorXd> p = set.MaybeGetFeasiblePoint();
  Require(p.has_value(), "an affine hull needs a set with a point, got an empty ", set.Kind());
  const Eigen::Index n = p->size();
  Eigen::MatrixXd found(n, 0);  // orthonormal: first those of the hull, then those across it
  Eigen::MatrixXd across(n, 0);
  const auto append = [](Eigen::MatrixXd& columns, const Eigen::VectorXd& column) {
    columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
    columns.rightCols(1) = column;
  };
  while (!set.MaybeGetPoint() && found.cols() + across.cols() < n) {
    Eigen::MatrixXd all(n, found.cols() + across.cols());
    all << found, across;
    const Eigen::MatrixXd Q = all.cols() > 0 ? Eigen::MatrixXd(all.householderQr().householderQ())
                                             : Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n));
    const Eigen::VectorXd d = Q.col(all.cols());
    Eigen::VectorXd step = FarthestStep(set, *p, d);
    if (d.dot(step) <= tol) step = FarthestStep(set, *p, -d);
    if (std::abs(d.dot(step)) <= tol) {
      append(across, d);
      continue;
    }
    // Twice, so that a short part across the others is orthogonal to rounding.
    for (int pass = 0; pass < 2; ++pass) step -= all * (all.transpose() * step);
    append(found, step.normalized());
  }
  return {*p, found};
}

}  // namespace switchyard
