#include "core/sets/polytope_conversions.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <vector>

#include "core/linalg/dense_lp.hpp"
#include "core/sets/convex_hull_of_points.hpp"
#include "core/sets/set_program.hpp"
#include "switchyard/error.hpp"
#include "switchyard/solve/solve.hpp"

namespace switchyard {
namespace {

constexpr double kRounding = 1e-14;  // of the largest entry of a row
constexpr double kSameRow = 1e-9;    // of rows of length 1: what they may differ by and be one
constexpr double kCopy = 1e-13;
constexpr double kFlatPolar = 1e-14;
constexpr double kHolds = 1e-3;    // of the largest multiplier: a row that holds a ball
constexpr double kFewTimes = 100;  // what equalities within a tolerance may add up to

/// Without the entries that are rounding of 0, as turning the coordinates leaves them: a linear
/// program that takes them for numbers scales its columns by them.
Eigen::MatrixXd WithoutRounding(const Eigen::MatrixXd& rows) {
  if (rows.size() == 0) return rows;
  const Eigen::ArrayXXd size = rows.cwiseAbs().rowwise().maxCoeff().replicate(1, rows.cols());
  return (rows.cwiseAbs().array() > kRounding * size).select(rows, 0.0);
}

/// Rows of length 1, each direction once: between points that are one but for rounding, or along an
/// edge, there are facets that differ by it.
Eigen::MatrixXd WithoutCopies(const Eigen::MatrixXd& rows) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const bool copy = std::any_of(kept.begin(), kept.end(), [&](Eigen::Index k) {
      return (rows.row(k) - rows.row(i)).squaredNorm() <= kCopy * kCopy;
    });
    if (!copy) kept.push_back(i);
  }
  return rows(kept, Eigen::all);
}

/// Coordinates y in which points of R^n have a spread of order 1 on each axis and span the space:
/// x = origin + axes diag(scale) y, up to what is flat.
struct Inertia {
  Eigen::VectorXd origin;
  Eigen::MatrixXd axes;  // n x r, orthonormal
  Eigen::VectorXd scale;
  Eigen::MatrixXd flat;  // n x (n - r), orthonormal, orthogonal to the axes
  [[nodiscard]] Eigen::MatrixXd Local(const Eigen::MatrixXd& points) const {
    return scale.cwiseInverse().asDiagonal() * (axes.transpose() * (points.colwise() - origin));
  }
  /// a'y as a function of x, up to a constant.
  [[nodiscard]] Eigen::MatrixXd Global(const Eigen::MatrixXd& normals) const {
    Eigen::MatrixXd a = normals * scale.cwiseInverse().asDiagonal() * axes.transpose();
    return a.rowwise().normalized();
  }
};

Inertia InertiaOf(const Eigen::MatrixXd& points, double tol) {
  const Eigen::Index n = points.rows();
  Inertia found;
  found.origin = points.rowwise().mean();
  const Eigen::MatrixXd centered = points.colwise() - found.origin;
  if (n == 0) return found;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(centered, Eigen::ComputeFullU);
  const Eigen::VectorXd& sigma = svd.singularValues();
  Eigen::Index rank = 0;
  while (rank < sigma.size() && sigma[rank] > tol * sigma[0]) ++rank;
  found.axes = svd.matrixU().leftCols(rank);
  found.flat = svd.matrixU().rightCols(n - rank);
  found.scale = sigma.head(rank);
  return found;
}

/// An orthonormal basis of {y : Ey = 0}.
Eigen::MatrixXd Kernel(const Eigen::MatrixXd& E) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(E.rowwise().normalized(), Eigen::ComputeFullV);
  Eigen::Index rank = 0;
  while (rank < svd.singularValues().size() && svd.singularValues()[rank] > kSameRow) ++rank;
  return svd.matrixV().rightCols(E.cols() - rank);
}

/// A polyhedron with an interior in coordinates of its affine hull: x = origin + axes y, gy <=
/// room, all of room above 0.
struct Body {
  Eigen::VectorXd origin;
  Eigen::MatrixXd axes;  // orthonormal columns
  Eigen::MatrixXd g;
  Eigen::VectorXd room;
};

/// About the center of a largest ball inside. Where that has no radius, the rows that hold it so
/// are equalities: their multipliers l > 0 with sum l_i |g_i| = 1, sum l_i g_i = 0 say
/// sum l_i (room_i - g_i y) = radius for every y. Then the same with fewer coordinates.
std::optional<Body> FindBody(const Halfspaces& rows, double tol) {
  const Eigen::Index n = rows.A.cols();
  Body body{Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Identity(n, n), {}, {}};
  while (true) {
    const Eigen::MatrixXd turned = WithoutRounding(rows.A * body.axes);
    const Eigen::VectorXd slack = rows.b - rows.A * body.origin;
    std::vector<Eigen::Index> kept;
    for (Eigen::Index i = 0; i < slack.size(); ++i) {
      const bool constant = turned.cols() == 0 || turned.row(i).norm() <= kSameRow;
      if (constant && slack[i] < -kFewTimes * tol) return std::nullopt;
      if (!constant) kept.push_back(i);
    }
    body.g = turned(kept, Eigen::all);
    body.room = slack(kept);
    if (body.axes.cols() == 0) return body;
    const std::optional<InnerBall> ball = LargestInnerBall(body.g, body.room);
    if (!ball || ball->radius < -tol) return std::nullopt;
    body.origin += body.axes * ball->center;
    body.room -= body.g * ball->center;
    if (ball->radius > tol) return body;
    std::vector<Eigen::Index> equal;
    const Eigen::VectorXd weights = ball->multipliers.cwiseProduct(body.g.rowwise().norm());
    for (Eigen::Index i = 0; i < weights.size(); ++i) {
      if (weights[i] > kHolds * weights.maxCoeff()) equal.push_back(i);
    }
    body.axes = body.axes * Kernel(body.g(equal, Eigen::all));
  }
}

/// Where rounding leaves the dense method undecided.
std::optional<InnerBall> BallByBackend(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  MathematicalProgram program;
  const VectorXDecisionVariable center = program.NewContinuousVariables(static_cast<int>(A.cols()));
  const VectorXDecisionVariable radius = program.NewContinuousVariables(1, "radius");
  Eigen::MatrixXd rows(A.rows(), A.cols() + 1);
  rows << A, A.rowwise().norm();
  const auto constraint = program.AddLinearConstraint(
      rows, Eigen::VectorXd::Constant(A.rows(), -kInfinity), b, VariableList({center, radius}));
  program.AddLinearCost(-Eigen::VectorXd::Ones(1), radius);
  const MathematicalProgramResult result = Solve(program);
  if (result.termination == Termination::kInfeasible) return std::nullopt;
  if (result.termination == Termination::kUnbounded) {
    return InnerBall{Eigen::VectorXd::Zero(A.cols()), kInfinity, {}};
  }
  if (!result.is_success()) CouldNotTell("hpolyhedron", "the largest ball inside", result);
  return InnerBall{result.GetSolution(center), result.GetSolution(radius[0]),
                   -result.GetDualSolution(Binding<Constraint>(constraint))};
}

}  // namespace

Halfspaces NormalizedRows(const HPolyhedron& polyhedron) {
  const Eigen::MatrixXd A = polyhedron.A();
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const bool everywhere = A.row(i).isZero(0) && polyhedron.b()[i] >= 0;
    if (!everywhere && polyhedron.b()[i] < kInfinity) kept.push_back(i);
  }
  Halfspaces rows{Eigen::MatrixXd(A(kept, Eigen::all)), Eigen::VectorXd(polyhedron.b()(kept))};
  for (Eigen::Index i = 0; i < rows.b.size(); ++i) {
    const double norm = rows.A.row(i).norm();
    if (norm == 0) continue;
    rows.A.row(i) /= norm;
    rows.b[i] /= norm;
  }
  return rows;
}

Halfspaces HalfspacesOf(const Eigen::MatrixXd& points, double tol) {
  const Inertia inertia = InertiaOf(points, tol);
  const Eigen::Index n = points.rows();
  const Eigen::Index flat = inertia.flat.cols();
  Eigen::MatrixXd facets(0, n);
  if (inertia.axes.cols() > 0) {
    facets = WithoutCopies(inertia.Global(ConvexHullOfPoints(inertia.Local(points)).normals));
  }
  Halfspaces rows;
  rows.A.resize(facets.rows() + 2 * flat, n);
  rows.A << facets, inertia.flat.transpose(), -inertia.flat.transpose();
  rows.A = WithoutRounding(rows.A);
  rows.b = rows.A.rows() > 0 ? Eigen::VectorXd((rows.A * points).rowwise().maxCoeff())
                             : Eigen::VectorXd();
  return rows;
}

// Qhull keeps points within merged facets: a vertex is one whose facets have normals that span R^n.
Eigen::MatrixXd ExtremePointsOf(const Eigen::MatrixXd& points, double tol) {
  if (points.cols() == 0) return points;
  const Inertia inertia = InertiaOf(points, tol);
  if (inertia.axes.cols() == 0) return points.leftCols(1);
  const Eigen::MatrixXd local = inertia.Local(points);
  const HullOfPoints hull = ConvexHullOfPoints(local);
  std::vector<int> vertices;
  for (const int k : hull.extreme) {
    const Eigen::VectorXd slack = hull.offsets - hull.normals * local.col(k);
    std::vector<Eigen::Index> facets;
    for (Eigen::Index i = 0; i < slack.size(); ++i) {
      if (slack[i] <= tol) facets.push_back(i);
    }
    const Eigen::MatrixXd normals = hull.normals(facets, Eigen::all);
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(normals);
    if (normals.rows() >= local.rows() && svd.singularValues()[local.rows() - 1] > tol) {
      vertices.push_back(k);
    }
  }
  return points(Eigen::all, vertices);
}

double VolumeOfHull(const Eigen::MatrixXd& points, double tol) {
  if (points.cols() == 0) return 0;
  const Inertia inertia = InertiaOf(points, tol);
  if (inertia.axes.cols() < points.rows()) return 0;
  if (points.rows() == 0) return 1;
  return ConvexHullOfPoints(inertia.Local(points)).volume * inertia.scale.prod();
}

// By polarity: with 0 strictly inside {y : g_i'y <= s_i}, s > 0, its vertices are n / o for the
// facets n'z <= o of the hull of the points g_i / s_i.
Eigen::MatrixXd VerticesOf(const HPolyhedron& polyhedron, double tol) {
  Require(tol > 0, "the vertices of a polyhedron need a tolerance above 0, got ", tol);
  const Halfspaces rows = NormalizedRows(polyhedron);
  if (polyhedron.IsEmpty()) return {rows.A.cols(), 0};
  Require(polyhedron.IsBounded(), "the vertices of a polyhedron need a bounded one, got one in R^",
          rows.A.cols(), " with ", rows.A.rows(), " rows that is not");
  const std::optional<Body> body = FindBody(rows, tol);
  if (!body) return {rows.A.cols(), 0};
  if (body->axes.cols() == 0) return body->origin;
  const Eigen::MatrixXd polar = body->room.cwiseInverse().asDiagonal() * body->g;
  const Halfspaces facets = HalfspacesOf(polar.transpose(), kFlatPolar);
  const Eigen::MatrixXd y = facets.A.transpose() * facets.b.cwiseInverse().asDiagonal();
  // Rows that differ by rounding alone meet somewhere along a face, which is no vertex.
  return (body->axes * ExtremePointsOf(y, tol)).colwise() + body->origin;
}

std::optional<InnerBall> LargestInnerBall(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  const auto n = static_cast<std::size_t>(A.cols());
  DenseLp lp(static_cast<int>(n + 1));
  lp.c[n] = -1;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    double* const row = lp.AddRow(-kInfinity, b[i]);
    for (std::size_t j = 0; j < n; ++j) row[j] = A(i, static_cast<Eigen::Index>(j));
    row[n] = A.row(i).norm();
  }
  DenseSimplex simplex;
  const DenseLpAnswer& answer = simplex.Solve(lp);
  if (answer.status == DenseLpStatus::kUndecided) return BallByBackend(A, b);
  if (answer.status == DenseLpStatus::kInfeasible) return std::nullopt;
  const Eigen::VectorXd center = Eigen::VectorXd::Map(answer.x.data(), A.cols());
  if (answer.status == DenseLpStatus::kUnbounded) return InnerBall{center, kInfinity, {}};
  return InnerBall{center, answer.x[n], -Eigen::VectorXd::Map(answer.row_dual.data(), A.rows())};
}

}  // namespace switchyard
