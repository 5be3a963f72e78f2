// switchyard/sets/hpolyhedron.hpp - {x : Ax <= b}.
#pragma once

#include <set>

#include "switchyard/sets/convex_set.hpp"

namespace switchyard {

class Hyperellipsoid;
class VPolytope;

/// A polyhedron by its halfspaces. Tolerances are absolute, in units of b.
class SWITCHYARD_EXPORT HPolyhedron final : public ConvexSet {
 public:
  HPolyhedron() : HPolyhedron(Eigen::MatrixXd(0, 0), Eigen::VectorXd()) {}
  /// A is rows x dimension. Throws InvalidArgument where sizes differ, a coefficient is not finite,
  /// or an entry of b is NaN or -inf (+inf: no halfspace).
  HPolyhedron(const CoefficientMatrix& A, const VectorRef& b);
  /// The facets, and for points that are flat to a part `tol` of their spread their affine hull, an
  /// equality as two rows. Each row is moved to hold every vertex. Throws InvalidArgument for a
  /// polytope without points.
  explicit HPolyhedron(const VPolytope& vpoly, double tol = 1e-9);
  /// The rows of a program all of whose constraints are linear, else throws InvalidArgument.
  explicit HPolyhedron(const MathematicalProgram& prog);
  [[nodiscard]] Eigen::MatrixXd A() const { return A_; }
  [[nodiscard]] const SparseMatrix& sparse_A() const { return A_; }
  [[nodiscard]] const Eigen::VectorXd& b() const { return b_; }

  /// Is max a'x over this one at most b + tol for each row of `other`? So is one without points.
  [[nodiscard]] bool ContainedIn(const HPolyhedron& other, double tol = 1e-9) const;
  /// The rows of both; with `check_for_redundancy` without those that are implied by the others.
  [[nodiscard]] HPolyhedron Intersection(const HPolyhedron& other,
                                         bool check_for_redundancy = false,
                                         double tol = 1e-9) const;
  /// Rows that can all be left out at once: row by row, is max a'x over the rows that are left,
  /// without this one, at most b + tol? Where rounding leaves that undecided, it is needed.
  [[nodiscard]] std::set<int> FindRedundant(double tol = 1e-9) const;
  /// Without the rows of FindRedundant.
  [[nodiscard]] HPolyhedron ReduceInequalities(double tol = 1e-9) const;
  /// Each row's distance to `center` times scale^(1 / dimension), so that the volume is `scale`
  /// times as large. `center`: the Chebyshev center unless given, a point of the set. Throws
  /// InvalidArgument where scale < 0.
  [[nodiscard]] HPolyhedron Scale(
      double scale, const std::optional<Eigen::VectorXd>& center = std::nullopt) const;
  /// {(x, y) : x here, y there}.
  [[nodiscard]] HPolyhedron CartesianProduct(const HPolyhedron& other) const;
  [[nodiscard]] HPolyhedron CartesianPower(int n) const;
  /// {x : x + y here for all y of `other`}. Throws InvalidArgument where `other` has no point, or
  /// there is no such x, a row being open here and `other` unbounded that way.
  [[nodiscard]] HPolyhedron PontryaginDifference(const HPolyhedron& other) const;
  /// The center of a largest ball inside. Throws InvalidArgument where there is no point, or balls
  /// of every radius are inside.
  [[nodiscard]] Eigen::VectorXd ChebyshevCenter() const;

  /// The ellipsoid of largest volume inside, its volume to a part in 1e5. Throws InvalidArgument
  /// where the set is not bounded or holds no ball.
  [[nodiscard]] Hyperellipsoid MaximumVolumeInscribedEllipsoid() const;

  /// Hit and run: `mixing_steps` times, a random line through the point, and on it an even draw
  /// from the part inside. Steps go along the columns of `subspace` where it is given. The start is
  /// `previous_sample`, inside by `tol` per row, or the Chebyshev center. Throws InvalidArgument
  /// where the start is outside or a line does not leave the set.
  [[nodiscard]] Eigen::VectorXd UniformSample(
      RandomGenerator* generator, const VectorRef& previous_sample, int mixing_steps = 10,
      const std::optional<Eigen::MatrixXd>& subspace = std::nullopt, double tol = 1e-8) const;
  [[nodiscard]] Eigen::VectorXd UniformSample(
      RandomGenerator* generator, int mixing_steps = 10,
      const std::optional<Eigen::MatrixXd>& subspace = std::nullopt, double tol = 1e-8) const;

  /// Throws InvalidArgument where sizes differ or lb[i] > ub[i].
  [[nodiscard]] static HPolyhedron MakeBox(const VectorRef& lb, const VectorRef& ub);
  [[nodiscard]] static HPolyhedron MakeUnitBox(int dim);
  /// {x : |x|_1 <= 1}, 2^dim rows; at most 20 dimensions, else throws InvalidArgument.
  [[nodiscard]] static HPolyhedron MakeL1Ball(int dim);
  [[nodiscard]] std::string Kind() const override { return "hpolyhedron"; }

 private:
  [[nodiscard]] std::unique_ptr<ConvexSet> DoClone() const override;
  [[nodiscard]] ScaledSet DoScaled() const override;
  [[nodiscard]] bool DoHasExactVolume() const override { return true; }
  [[nodiscard]] std::optional<double> DoCalcVolume() const override;
  SparseMatrix A_;
  Eigen::VectorXd b_;
};

}  // namespace switchyard
