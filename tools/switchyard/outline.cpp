#include "outline.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "switchyard/sets/hyperellipsoid.hpp"
#include "switchyard/sets/hyperrectangle.hpp"
#include "switchyard/sets/point.hpp"

namespace switchyard::cli {
namespace {

using Eigen::Vector2d;
using Polygon = std::vector<Vector2d>;
constexpr double kVisible = 5e-4;  // of the set's diameter: half a pixel of a thousand
constexpr int kMostCuts = 256;     // of one cone

/// {x : a'x <= b}.
struct HalfPlane {
  Vector2d a;
  double b;
  [[nodiscard]] double Excess(const Vector2d& x) const { return a.dot(x) - b; }
};

/// The part of a convex polygon in a half-plane, by its sides in turn.
Polygon Cut(const Polygon& polygon, const HalfPlane& h) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d& p = polygon[i];
    const Vector2d& q = polygon[(i + 1) % polygon.size()];
    const double at_p = h.Excess(p);
    const double at_q = h.Excess(q);
    if (at_p <= 0) kept.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) {
      kept.emplace_back(p + (at_p / (at_p - at_q)) * (q - p));
    }
  }
  return kept;
}

double Diameter(const Polygon& polygon) {
  Frame frame;
  for (const Vector2d& p : polygon) frame.Add(p);
  return frame.empty() ? 0 : (frame.upper - frame.lower).norm();
}

/// An equation's part of the plane is a line; it keeps the width of a hair.
void CutByRow(HalfPlane h, bool equation, Polygon& polygon) {
  if (equation) {
    const double hair = kVisible * Diameter(polygon) * h.a.norm();
    polygon = Cut(polygon, {-h.a, -h.b + hair});
    h.b += hair;
  }
  polygon = Cut(polygon, h);
}

/// F x + g of the plane in one cone. Points (x) where |tail| > head are outside.
struct PlaneCone {
  Eigen::MatrixXd F;
  Eigen::VectorXd g;

  /// The tangent at p of |(Fx + g)_1..n| - (Fx + g)_0 <= 0, which is convex: the half-plane where
  /// its linearization is not positive has the whole set.
  [[nodiscard]] HalfPlane Tangent(const Vector2d& p) const {
    const Eigen::VectorXd z = F * p + g;
    const Eigen::Index n = z.size() - 1;
    const double norm = z.tail(n).norm();
    Vector2d slope = -F.row(0).transpose();
    if (norm > 0) slope += F.bottomRows(n).transpose() * (z.tail(n) / norm);
    return {slope, slope.dot(p) - (norm - z[0])};
  }
};

/// Cuts the corner that is furthest outside, again and again.
Polygon CutByCone(Polygon polygon, const PlaneCone& cone) {
  const double tolerance = kVisible * Diameter(polygon);
  for (int k = 0; k < kMostCuts && !polygon.empty(); ++k) {
    double worst = tolerance;
    std::optional<HalfPlane> deepest;
    for (const Vector2d& p : polygon) {
      const HalfPlane tangent = cone.Tangent(p);
      const double distance = tangent.Excess(p) / std::max(tangent.a.norm(), 1e-300);
      if (distance <= worst) continue;
      worst = distance;
      deepest = tangent;
    }
    if (!deepest.has_value()) break;
    polygon = Cut(polygon, *deepest);
  }
  return polygon;
}

Eigen::MatrixXd Dense(const Csc& m) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(m.rows, m.cols);
  for (std::int32_t j = 0; j < m.cols; ++j) {
    for (std::int32_t k = m.start[static_cast<std::size_t>(j)];
         k < m.start[static_cast<std::size_t>(j) + 1]; ++k) {
      dense(m.row[static_cast<std::size_t>(k)], j) = m.value[static_cast<std::size_t>(k)];
    }
  }
  return dense;
}

/// The cones of a set in the plane as second-order ones, rows where they are linear.
void CutByCones(const ProblemData& set, Outline& outline) {
  const Eigen::MatrixXd F = Dense(set.F);
  const Eigen::VectorXd g =
      Eigen::Map<const Eigen::VectorXd>(set.g.data(), static_cast<Eigen::Index>(set.g.size()));
  Eigen::Index first = 0;
  for (const sy_cone& cone : set.cones) {
    const Eigen::Index dim = cone.dim;
    PlaneCone part{F.middleRows(first, dim), g.segment(first, dim)};
    first += dim;
    if (cone.kind == SY_CONE_ZERO || cone.kind == SY_CONE_NONNEGATIVE) {
      for (Eigen::Index i = 0; i < dim; ++i) {
        const bool equation = cone.kind == SY_CONE_ZERO;
        CutByRow({-part.F.row(i).transpose(), part.g[i]}, equation, outline.corners);
      }
    } else if (cone.kind == SY_CONE_SECOND_ORDER || cone.kind == SY_CONE_ROTATED) {
      if (cone.kind == SY_CONE_ROTATED) {  // 2ab >= |w|^2 is a + b >= |(a - b, sqrt(2) w)|
        const auto turn = [](auto&& row) {
          const auto a = row.row(0).eval();
          const auto b = row.row(1).eval();
          row.row(0) = a + b;
          row.row(1) = a - b;
          row.bottomRows(row.rows() - 2) *= std::sqrt(2.0);
        };
        turn(part.F);
        turn(part.g);
      }
      outline.corners = CutByCone(std::move(outline.corners), part);
    } else {
      outline.exact = false;
    }
  }
}

Polygon Box(const Frame& f) {
  if (f.lower == f.upper) return {f.lower};
  return {f.lower, {f.upper[0], f.lower[1]}, f.upper, {f.lower[0], f.upper[1]}};
}

/// A set in the plane without variables of its own, cut out of its box.
Outline PlanarOutline(const ConvexSet& set, const Frame& box) {
  Outline outline;
  outline.corners = Box(box);
  if (outline.corners.size() == 1) return outline;
  const ProblemData data = AtScaleOne(set.scaled());
  const Eigen::MatrixXd A = Dense(data.A);
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Vector2d a = A.row(i);
    const double upper = data.row_upper[at];
    const double lower = data.row_lower[at];
    if (std::isfinite(upper)) CutByRow({a, upper}, lower == upper, outline.corners);
    if (std::isfinite(lower) && lower < upper) CutByRow({-a, -lower}, false, outline.corners);
  }
  CutByCones(data, outline);
  return outline;
}

/// The shadow of {c + u : |A u| <= 1} is {c + u : u' Q^-1 u <= 1} with Q the first two rows and
/// columns of (A'A)^-1; its radii are the roots of Q's eigenvalues. None where A has a kernel.
std::optional<Ellipse> ShadowOf(const Hyperellipsoid& set) {
  if (set.ambient_dimension() < 2) return std::nullopt;
  const Eigen::MatrixXd gram = set.A().transpose() * set.A();
  const Eigen::LLT<Eigen::MatrixXd> factor(gram);
  if (factor.info() != Eigen::Success || factor.rcond() < 1e-14) return std::nullopt;
  const Eigen::MatrixXd some = factor.solve(Eigen::MatrixXd::Identity(gram.rows(), 2));
  const Eigen::Matrix2d Q = some.topRows(2);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(0.5 * (Q + Q.transpose()));
  const Vector2d main = eigen.eigenvectors().col(0);
  constexpr double kHalfTurn = 180;
  return Ellipse{set.center().head<2>(), eigen.eigenvalues().cwiseSqrt(),
                 std::atan2(main[1], main[0]) * kHalfTurn / std::acos(-1.0)};
}

}  // namespace

Eigen::Vector2d Outline::Center() const {
  if (ellipse.has_value()) return ellipse->center;
  Frame frame;
  for (const Vector2d& p : corners) frame.Add(p);
  return frame.Center();
}

Eigen::Vector2d Shadow(const Eigen::VectorXd& x) {
  Vector2d p = Vector2d::Zero();
  const Eigen::Index n = std::min<Eigen::Index>(2, x.size());
  p.head(n) = x.head(n);
  return p;
}

Frame FrameOf(const ConvexSet& set) {
  const SetBox& box = set.bounding_box();
  Frame frame;
  if (box.empty) return frame;
  return {Shadow(box.lower), Shadow(box.upper)};
}

Outline OutlineOf(const ConvexSet& set, const Frame& frame) {
  Outline outline;
  if (const auto* ellipsoid = dynamic_cast<const Hyperellipsoid*>(&set)) {
    outline.ellipse = ShadowOf(*ellipsoid);
    if (outline.ellipse.has_value()) return outline;
  }
  Frame box = FrameOf(set);
  if (box.empty()) return outline;
  box = {box.lower.cwiseMax(frame.lower), box.upper.cwiseMin(frame.upper)};
  if (box.empty()) return outline;
  if (set.ambient_dimension() == 2 && set.scaled().num_aux == 0) return PlanarOutline(set, box);
  outline.corners = Box(box);
  outline.exact = set.ambient_dimension() < 2 ||
                  dynamic_cast<const Hyperrectangle*>(&set) != nullptr ||
                  dynamic_cast<const Point*>(&set) != nullptr;
  return outline;
}

}  // namespace switchyard::cli
