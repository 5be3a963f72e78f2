#include "core/sets/scaled_constraint.hpp"

#include "switchyard/error.hpp"

namespace switchyard {
namespace {

void WriteLinear(const LinearConstraint& linear, ScaledRows& rows) {
  const SparseMatrix by_columns = linear.get_sparse_A();
  const Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows = by_columns;
  for (int i = 0; i < by_rows.outerSize(); ++i) {
    rows.AddTwoSided(linear.lower_bound()[i], linear.upper_bound()[i], [&](int row) {
      for (decltype(by_rows)::InnerIterator e(by_rows, i); e; ++e) {
        rows.Set(row, 1 + static_cast<int>(e.col()), e.value());
      }
    });
  }
}

void WriteCone(const ConeConstraint& cone, ScaledRows& rows) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> A = cone.A();
  const int first = rows.AddCone(cone.cone());
  for (int i = 0; i < cone.cone().dim; ++i) {
    const ConeConstraint::FrameRow& from = cone.frame()[static_cast<std::size_t>(i)];
    rows.SetCone(first + i, 0, from.scale * cone.b()[from.row]);
    for (decltype(A)::InnerIterator e(A, from.row); e; ++e) {
      rows.SetCone(first + i, 1 + static_cast<int>(e.col()), from.scale * e.value());
    }
  }
}

}  // namespace

void RequireConvex(const Constraint& constraint) {
  const bool known = dynamic_cast<const LinearConstraint*>(&constraint) != nullptr ||
                     dynamic_cast<const ConeConstraint*>(&constraint) != nullptr;
  Require(known, constraint.Name(),
          " has no perspective: a set, a relaxation and a mixed-integer "
          "program take linear and conic constraints");
}

void WriteScaled(const Constraint& constraint, ScaledRows& rows) {
  if (const auto* linear = dynamic_cast<const LinearConstraint*>(&constraint)) {
    return WriteLinear(*linear, rows);
  }
  RequireConvex(constraint);
  WriteCone(dynamic_cast<const ConeConstraint&>(constraint), rows);
}

}  // namespace switchyard
