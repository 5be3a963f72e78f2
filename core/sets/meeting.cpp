#include "core/sets/meeting.hpp"

#include <algorithm>
#include <cmath>

#include "core/sets/box_sweep.hpp"
#include "core/sets/section_lp.hpp"
#include "switchyard/sets/cartesian_product.hpp"
#include "switchyard/sets/hyperellipsoid.hpp"
#include "switchyard/sets/hyperrectangle.hpp"

namespace switchyard {
namespace {

/// The radius of an ellipsoid that is a ball: A'A = I / r^2.
std::optional<double> RadiusOf(const Hyperellipsoid& ellipsoid) {
  const Eigen::MatrixXd gram = ellipsoid.A().transpose() * ellipsoid.A();
  if (gram.size() == 0) return std::nullopt;
  const double g = gram(0, 0);
  const auto rest = gram - g * Eigen::MatrixXd::Identity(gram.rows(), gram.cols());
  if (!(g > 0) || rest.cwiseAbs().maxCoeff() > 1e-14 * g) return std::nullopt;
  return 1 / std::sqrt(g);
}

std::optional<RoundedBox> RoundedBoxOf(const ConvexSet& set) {
  if (const auto point = set.MaybeGetPoint()) return RoundedBox{*point, *point, 0};
  if (const auto* box = dynamic_cast<const Hyperrectangle*>(&set)) {
    return RoundedBox{box->lb(), box->ub(), 0};
  }
  if (const auto* ellipsoid = dynamic_cast<const Hyperellipsoid*>(&set)) {
    if (const auto radius = RadiusOf(*ellipsoid)) {
      return RoundedBox{ellipsoid->center(), ellipsoid->center(), *radius};
    }
  }
  return std::nullopt;
}

bool RoundedBoxesMeet(const RoundedBox& a, const RoundedBox& b, const Eigen::VectorXd& tau) {
  const Eigen::ArrayXd below = b.lower.array() - (a.upper + tau).array();
  const Eigen::ArrayXd above = (a.lower + tau).array() - b.upper.array();
  const double reach = a.radius + b.radius;
  return below.max(above).max(0).matrix().norm() <= reach + kTouch * (1 + reach);
}

bool Holds(const ConvexSet& set, const Eigen::VectorXd& x) {
  return set.PointInSet(x, kTouch * (1 + x.lpNorm<Eigen::Infinity>()));
}

}  // namespace

MeetingSet::MeetingSet(const ConvexSet& the_set)
    : set(&the_set), rounded(RoundedBoxOf(the_set)), point(the_set.MaybeGetPoint()) {
  if (IsSmallPolyhedron(set->scaled())) {
    rows = SectionLp(set->scaled(), Eigen::VectorXd::Zero(set->ambient_dimension()));
  }
}

bool MeetingJudge::Meet(const MeetingSet& a, const MeetingSet& b, const Eigen::VectorXd& tau,
                        const MeetingRange& range) {
  proof_ = MeetingProof::kClosedForm;
  if (a.rounded && b.rounded) return RoundedBoxesMeet(*a.rounded, *b.rounded, tau);
  if (a.point) return Holds(*b.set, *a.point + tau);
  if (b.point) return Holds(*a.set, *b.point - tau);
  if (a.rows && b.rows) {
    proof_ = MeetingProof::kLinearProgram;
    if (const auto answer = ByLp(a, b, tau, range)) return *answer;
  }
  proof_ = MeetingProof::kIntersection;
  if (tau.isZero(0)) return a.set->IntersectsWith(*b.set);
  const auto n = tau.size();
  const CartesianProduct moved(MakeConvexSets(*b.set), Eigen::MatrixXd::Identity(n, n), tau);
  return a.set->IntersectsWith(moved);
}

/// The rows of both over (x, w_a, w_b), those of b at x + tau.
std::optional<bool> MeetingJudge::ByLp(const MeetingSet& a, const MeetingSet& b,
                                       const Eigen::VectorXd& tau, const MeetingRange& range) {
  const auto n = static_cast<std::size_t>(tau.size());
  lp_.Clear(a.rows->num_vars() + b.rows->num_vars() - static_cast<int>(n));
  for (std::size_t j = 0; j < n; ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    // Boxes that are apart by rounding leave the range between them.
    lp_.x_lower[j] = std::min(range.lower[at], range.upper[at]);
    lp_.x_upper[j] = std::max(range.lower[at], range.upper[at]);
  }
  const auto append = [&](const DenseLp& rows, std::size_t first_aux, bool moved) {
    const std::size_t width = rows.c.size();
    for (std::size_t i = 0; i < rows.row_lower.size(); ++i) {
      const double* from = rows.row(i);
      double shift = 0;
      for (std::size_t j = 0; j < n && moved; ++j) {
        shift += from[j] * tau[static_cast<Eigen::Index>(j)];
      }
      double* to = lp_.AddRow(rows.row_lower[i] - shift, rows.row_upper[i] - shift);
      std::copy(from, from + n, to);
      std::copy(from + n, from + width, to + first_aux);
    }
  };
  append(*a.rows, n, false);
  append(*b.rows, a.rows->c.size(), true);
  switch (simplex_.Solve(lp_).status) {
    case DenseLpStatus::kOptimal:
      return true;
    case DenseLpStatus::kInfeasible:
      return false;
    default:
      return std::nullopt;
  }
}

}  // namespace switchyard
