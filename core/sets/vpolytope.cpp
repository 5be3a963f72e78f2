#include "switchyard/sets/vpolytope.hpp"

#include <cmath>

#include "core/sets/convex_hull_of_points.hpp"
#include "core/sets/polytope_conversions.hpp"
#include "switchyard/error.hpp"
#include "switchyard/sets/hpolyhedron.hpp"
#include "switchyard/sets/scaled_rows.hpp"

namespace switchyard {
namespace {

constexpr int kMostBoxDimensions = 20;
constexpr double kFlat = 1e-12;  // of the spread: then the volume is 0

}  // namespace

VPolytope::VPolytope(const Eigen::Ref<const Eigen::MatrixXd>& vertices)
    : ConvexSet(static_cast<int>(vertices.rows())), vertices_(vertices) {
  Require(vertices.allFinite(), "vpolytope: an entry of the vertices is not a finite number");
}

VPolytope::VPolytope(const HPolyhedron& H, double tol) : VPolytope(VerticesOf(H, tol)) {}

VPolytope VPolytope::GetMinimalRepresentation(double tol) const {
  return VPolytope(ExtremePointsOf(vertices_, tol));
}

VPolytope VPolytope::MakeBox(const VectorRef& lb, const VectorRef& ub) {
  const Eigen::Index n = lb.size();
  Require(n == ub.size(), "box: lb has ", n, " entries, ub ", ub.size());
  Require(n <= kMostBoxDimensions, "a box by its vertices has at most ", kMostBoxDimensions,
          " dimensions, got ", n);
  for (Eigen::Index i = 0; i < n; ++i) {
    Require(lb[i] <= ub[i] && std::isfinite(lb[i]) && std::isfinite(ub[i]), "box: lb[", i,
            "] = ", lb[i], " must be at most ub[", i, "] = ", ub[i], ", both finite");
  }
  Eigen::MatrixXd vertices(n, Eigen::Index{1} << n);
  for (Eigen::Index k = 0; k < vertices.cols(); ++k) {
    for (Eigen::Index i = 0; i < n; ++i) vertices(i, k) = (k >> i) % 2 == 0 ? lb[i] : ub[i];
  }
  return VPolytope(vertices);
}

VPolytope VPolytope::MakeUnitBox(int dim) {
  return MakeBox(Eigen::VectorXd::Constant(dim, -1), Eigen::VectorXd::Ones(dim));
}

std::unique_ptr<ConvexSet> VPolytope::DoClone() const { return std::make_unique<VPolytope>(*this); }

// x = V a, 1'a = t, a >= 0.
ScaledSet VPolytope::DoScaled() const {
  const auto k = static_cast<int>(vertices_.cols());
  ScaledRows rows(ambient_dimension(), k);
  const int first = 1 + ambient_dimension();
  for (int i = 0; i < ambient_dimension(); ++i) {
    const int row = rows.AddRow(0, 0);
    rows.Set(row, 1 + i, -1);
    for (int j = 0; j < k; ++j) rows.Set(row, first + j, vertices_(i, j));
  }
  const int sum = rows.AddRow(0, 0);
  rows.Set(sum, 0, -1);
  for (int j = 0; j < k; ++j) {
    rows.Set(sum, first + j, 1);
    rows.Set(rows.AddRow(0, kInfinity), first + j, 1);
  }
  return rows.Finish();
}

std::optional<SetBox> VPolytope::DoBoundingBox() const {
  const int n = ambient_dimension();
  if (vertices_.cols() == 0) {
    return SetBox{Eigen::VectorXd::Constant(n, kInfinity), Eigen::VectorXd::Constant(n, -kInfinity),
                  true};
  }
  return SetBox{vertices_.rowwise().minCoeff(), vertices_.rowwise().maxCoeff(), false};
}

std::optional<Eigen::VectorXd> VPolytope::DoMaybeGetPoint() const {
  for (Eigen::Index k = 1; k < vertices_.cols(); ++k) {
    if (vertices_.col(k) != vertices_.col(0)) return std::nullopt;
  }
  return DoMaybeGetFeasiblePoint();
}

std::optional<Eigen::VectorXd> VPolytope::DoMaybeGetFeasiblePoint() const {
  if (vertices_.cols() == 0) return std::nullopt;
  return vertices_.col(0);
}

double VPolytope::DoSupport(const Eigen::VectorXd& direction) const {
  if (vertices_.cols() == 0) return -kInfinity;
  return (direction.transpose() * vertices_).maxCoeff();
}

std::optional<double> VPolytope::DoCalcVolume() const { return VolumeOfHull(vertices_, kFlat); }

}  // namespace switchyard
