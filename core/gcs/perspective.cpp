// The perspectives of mathematics: norms keep their form with b times t, squares become a rotated
// cone, linear costs need nothing.
#include "core/gcs/perspective.hpp"

#include <cmath>

#include "core/linalg/semidefinite_factor.hpp"
#include "core/sets/scaled_constraint.hpp"
#include "switchyard/error.hpp"
#include "switchyard/sets/scaled_rows.hpp"

namespace switchyard {
namespace {

using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;

Perspective Linear(const LinearCost& cost) {
  Perspective p;
  p.cone = ScaledRows(cost.num_vars()).Finish();
  p.cost.assign(1, cost.b());
  p.cost.insert(p.cost.end(), cost.a().data(), cost.a().data() + cost.a().size());
  return p;
}

Perspective Quadratic(const QuadraticCost& cost) {
  const int n = cost.num_vars();
  Csc P(n, n);
  for (int j = 0; j < n; ++j) {
    for (SparseMatrix::InnerIterator e(cost.Q(), j); e && e.row() <= j; ++e) {
      P.row.push_back(static_cast<std::int32_t>(e.row()));
      P.value.push_back(e.value());
    }
    P.start[static_cast<std::size_t>(j) + 1] = static_cast<std::int32_t>(P.row.size());
  }
  SemidefiniteFactor factor = FactorSemidefinite(P);
  if (const auto& negative = factor.not_semidefinite) {
    Refuse(cost.Name(), " is not convex (a pivot of its matrix is ", negative->pivot,
           "): a relaxation and a mixed-integer program take convex costs");
  }
  Perspective p;
  p.cone = ScaledRows(n).Finish();
  p.cost.assign(1, cost.c());
  p.cost.insert(p.cost.end(), cost.b().data(), cost.b().data() + n);
  p.S = std::move(factor.S);
  return p;
}

/// sign z_i at row `row`, z = Ax + bt.
void SetRow(const NormCost& cost, const RowMajor& A, int i, double sign, int row,
            ScaledRows& rows) {
  rows.Set(row, 0, sign * cost.b()[i]);
  for (RowMajor::InnerIterator e(A, i); e; ++e) {
    rows.Set(row, 1 + static_cast<int>(e.col()), sign * e.value());
  }
}

/// l_i >= |z_i|, or l >= |z_i| for every i where there is one l.
ScaledSet Sides(const NormCost& cost, const RowMajor& A, int num_epigraphs) {
  const int n = cost.num_vars();
  ScaledRows rows(n, num_epigraphs);
  for (int i = 0; i < A.rows(); ++i) {
    for (const double sign : {1.0, -1.0}) {
      const int row = rows.AddRow(0, kInfinity);
      SetRow(cost, A, i, sign, row, rows);
      rows.Set(row, 1 + n + (num_epigraphs == 1 ? 0 : i), 1);
    }
  }
  return rows.Finish();
}

/// (l, z) in the second-order cone, or (l, z_0, sqrt2 z_1..) in the rotated one.
ScaledSet Cone(const NormCost& cost, const RowMajor& A, sy_cone_kind kind) {
  const int n = cost.num_vars();
  const auto m = static_cast<int>(A.rows());
  ScaledRows rows(n, 1);
  const int first = rows.AddCone({kind, m + 1, 0});
  rows.SetCone(first, 1 + n, 1);
  for (int i = 0; i < m; ++i) {
    const double scale = kind == SY_CONE_ROTATED && i > 0 ? std::sqrt(2.0) : 1;
    rows.SetCone(first + 1 + i, 0, scale * cost.b()[i]);
    for (RowMajor::InnerIterator e(A, i); e; ++e) {
      rows.SetCone(first + 1 + i, 1 + static_cast<int>(e.col()), scale * e.value());
    }
  }
  return rows.Finish();
}

Perspective Norm(const NormCost& cost) {
  const RowMajor A = cost.A();
  Perspective p;
  switch (cost.norm()) {
    case NormCost::Norm::kL1:
      p.cone = Sides(cost, A, static_cast<int>(A.rows()));
      break;
    case NormCost::Norm::kLInf:
      p.cone = Sides(cost, A, 1);
      break;
    case NormCost::Norm::kL2:
      p.cone = A.rows() == 1 ? Sides(cost, A, 1) : Cone(cost, A, SY_CONE_SECOND_ORDER);
      break;
    case NormCost::Norm::kPerspectiveQuadratic:
      p.cone = Cone(cost, A, SY_CONE_ROTATED);
      break;
  }
  p.cost.assign(static_cast<std::size_t>(1 + p.cone.dim), 0.0);
  p.cost.resize(static_cast<std::size_t>(p.cone.num_columns()), 1.0);
  return p;
}

}  // namespace

bool HasPerspective(const Cost& cost) {
  const auto* quadratic = dynamic_cast<const QuadraticCost*>(&cost);
  return (quadratic != nullptr && quadratic->is_convex()) ||
         dynamic_cast<const LinearCost*>(&cost) != nullptr ||
         dynamic_cast<const NormCost*>(&cost) != nullptr;
}

Perspective PerspectiveOf(const Cost& cost) {
  if (const auto* linear = dynamic_cast<const LinearCost*>(&cost)) return Linear(*linear);
  if (const auto* quadratic = dynamic_cast<const QuadraticCost*>(&cost)) {
    return Quadratic(*quadratic);
  }
  if (const auto* norm = dynamic_cast<const NormCost*>(&cost)) return Norm(*norm);
  Refuse(cost.Name(),
         " has no perspective: a relaxation and a mixed-integer program take linear, "
         "convex quadratic and norm costs");
}

Perspective PerspectiveOf(const Constraint& constraint) {
  ScaledRows rows(constraint.num_vars());
  WriteScaled(constraint, rows);
  return {rows.Finish(), {}, {}};
}

}  // namespace switchyard
