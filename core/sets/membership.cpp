// A point in a set, or in a multiple of it, as constraints of a program: the scaled form with its
// columns replaced by affine functions of the program's variables.
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "core/sets/cone_constraint_of.hpp"
#include "switchyard/error.hpp"
#include "switchyard/sets/convex_set.hpp"

namespace switchyard {
namespace {

SparseMatrix ToEigen(const Csc& m) {
  const sy_csc v = m.View();
  static const double none = 0;
  return Eigen::Map<const SparseMatrix>(m.rows, m.cols, m.nonzeros(), v.start, v.row,
                                        v.value != nullptr ? v.value : &none);
}

/// M over (t, x, w) as N over (x, t, w) of the user's and a constant: t = c't + d, x = Ax + b.
struct Substituted {
  SparseMatrix N;
  Eigen::VectorXd constant;
};

struct Affine {
  SparseMatrix A;
  Eigen::VectorXd b;
  Eigen::VectorXd c;
  double d;
};

Substituted Substitute(const Csc& m, int dim, int num_aux, const Affine& by) {
  const SparseMatrix M = ToEigen(m);
  const SparseMatrix t = M.leftCols(1);
  const SparseMatrix x = M.middleCols(1, dim);
  const SparseMatrix scale = t * SparseMatrix(by.c.transpose().sparseView());
  const SparseMatrix point = x * by.A;
  SparseMatrix N(M.rows(), point.cols() + scale.cols() + num_aux);
  std::vector<Eigen::Triplet<double>> entries;
  const auto put = [&entries](const SparseMatrix& part, Eigen::Index first_column) {
    for (int j = 0; j < part.outerSize(); ++j) {
      for (SparseMatrix::InnerIterator e(part, j); e; ++e) {
        entries.emplace_back(e.row(), first_column + j, e.value());
      }
    }
  };
  put(point, 0);
  put(scale, point.cols());
  put(M.rightCols(num_aux), point.cols() + scale.cols());
  N.setFromTriplets(entries.begin(), entries.end());
  return {std::move(N), Eigen::VectorXd(t * Eigen::VectorXd::Constant(1, by.d) + x * by.b)};
}

struct Added {
  VectorXDecisionVariable aux;
  std::vector<Binding<Constraint>> constraints;
};

Added AddScaled(MathematicalProgram* prog, const ScaledSet& set, const Affine& by,
                const VariableList& x, const VariableList& t) {
  Added added;
  added.aux = prog->NewContinuousVariables(set.num_aux, "w");
  const VariableList vars({x.vector(), t.vector(), added.aux});
  if (set.A.rows > 0) {
    const Substituted rows = Substitute(set.A, set.dim, set.num_aux, by);
    const Eigen::VectorXd lower =
        Eigen::Map<const Eigen::VectorXd>(set.lower.data(), set.A.rows) - rows.constant;
    const Eigen::VectorXd upper =
        Eigen::Map<const Eigen::VectorXd>(set.upper.data(), set.A.rows) - rows.constant;
    added.constraints.emplace_back(prog->AddLinearConstraint(rows.N, lower, upper, vars));
  }
  const Substituted cones = Substitute(set.F, set.dim, set.num_aux, by);
  Eigen::Index first = 0;
  for (const sy_cone& cone : set.cones) {
    const SparseMatrix rows =
        SparseMatrix(SparseMatrix(cones.N.transpose()).middleCols(first, cone.dim)).transpose();
    const auto constraint = ConeConstraintOf(cone, rows, cones.constant.segment(first, cone.dim));
    added.constraints.push_back(prog->AddConstraint(Binding<Constraint>(constraint, vars)));
    first += cone.dim;
  }
  return added;
}

SparseMatrix Identity(int n) {
  SparseMatrix I(n, n);
  I.setIdentity();
  return I;
}

}  // namespace

std::pair<VectorXDecisionVariable, std::vector<Binding<Constraint>>>
ConvexSet::AddPointInSetConstraints(MathematicalProgram* prog, const VariableList& x) const {
  const int n = ambient_dimension();
  Require(x.vector().size() == n, "a point of a ", Kind(), " in R^", n, " needs ", n,
          " variables, got ", x.vector().size());
  Added added = AddScaled(prog, scaled(), {Identity(n), Eigen::VectorXd::Zero(n), {}, 1}, x, {});
  return {std::move(added.aux), std::move(added.constraints)};
}

std::vector<Binding<Constraint>> ConvexSet::AddPointInNonnegativeScalingConstraints(
    MathematicalProgram* prog, const VariableList& x, Variable t) const {
  const int n = ambient_dimension();
  return AddPointInNonnegativeScalingConstraints(prog, Eigen::MatrixXd::Identity(n, n),
                                                 Eigen::VectorXd::Zero(n), Eigen::VectorXd::Ones(1),
                                                 0, x, t);
}

std::vector<Binding<Constraint>> ConvexSet::AddPointInNonnegativeScalingConstraints(
    MathematicalProgram* prog, const Eigen::Ref<const Eigen::MatrixXd>& A, const VectorRef& b,
    const VectorRef& c, double d, const VariableList& x, const VariableList& t) const {
  const int n = ambient_dimension();
  Require(A.rows() == n && b.size() == n, "a scaled ", Kind(), " in R^", n, " needs A with ", n,
          " rows and b with ", n, " entries, got ", A.rows(), " and ", b.size());
  Require(A.cols() == x.vector().size() && c.size() == t.vector().size(), "A has ", A.cols(),
          " columns for ", x.vector().size(), " variables x, c ", c.size(), " entries for ",
          t.vector().size(), " variables t");
  Added added = AddScaled(prog, scaled(), {A.sparseView(1.0, 0.0), b, c, d}, x, t);
  if (c.size() > 0) {
    added.constraints.emplace_back(
        prog->AddLinearConstraint(Eigen::RowVectorXd(c.transpose()), -d, kInfinity, t));
  } else {
    Require(d >= 0, "a set cannot be scaled by ", d);
  }
  return std::move(added.constraints);
}

}  // namespace switchyard
