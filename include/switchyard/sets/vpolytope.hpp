// switchyard/sets/vpolytope.hpp - the convex hull of finitely many points.
#pragma once

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

class HPolyhedron;

/// A polytope by its vertices; without any it is empty.
class SWITCHYARD_EXPORT VPolytope final : public ConvexSet {
 public:
  VPolytope() : VPolytope(Eigen::MatrixXd(0, 0)) {}
  /// Columns; some may lie in the hull of others. Throws InvalidArgument where an entry is not
  /// finite.
  explicit VPolytope(const Eigen::Ref<const Eigen::MatrixXd>& vertices);
  /// The vertices of a bounded polyhedron. What is thinner than `tol`, with rows of A of length 1,
  /// is taken for flat. Throws InvalidArgument for one that is not bounded.
  explicit VPolytope(const HPolyhedron& H, double tol = 1e-9);
  [[nodiscard]] const Eigen::MatrixXd& vertices() const { return vertices_; }
  /// Without the points that are in the hull of others, and with each once. Where all points are
  /// within `tol` of a subspace, by a part of their spread, vertices are those of their images
  /// there.
  [[nodiscard]] VPolytope GetMinimalRepresentation(double tol = 1e-9) const;
  /// 2^dim vertices. Throws InvalidArgument where sizes differ, lb[i] > ub[i], a side is infinite,
  /// or there are more than 20 dimensions.
  [[nodiscard]] static VPolytope MakeBox(const VectorRef& lb, const VectorRef& ub);
  [[nodiscard]] static VPolytope MakeUnitBox(int dim);
  [[nodiscard]] std::string Kind() const override { return "vpolytope"; }

 private:
  [[nodiscard]] std::unique_ptr<ConvexSet> DoClone() const override;
  [[nodiscard]] ScaledSet DoScaled() const override;
  [[nodiscard]] std::optional<SetBox> DoBoundingBox() const override;
  [[nodiscard]] std::optional<Eigen::VectorXd> DoMaybeGetPoint() const override;
  [[nodiscard]] std::optional<Eigen::VectorXd> DoMaybeGetFeasiblePoint() const override;
  [[nodiscard]] bool DoIsBounded(Parallelism /*parallelism*/) const override { return true; }
  [[nodiscard]] double DoSupport(const Eigen::VectorXd& direction) const override;
  [[nodiscard]] bool DoHasExactVolume() const override { return true; }
  [[nodiscard]] std::optional<double> DoCalcVolume() const override;
  Eigen::MatrixXd vertices_;
};

}  // namespace switchyard
