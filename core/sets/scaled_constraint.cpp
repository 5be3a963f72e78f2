#include "core/sets/scaled_constraint.hpp"

#include <optional>
#include <utility>

#include "core/model/quadratic_cone.hpp"
#include "switchyard/error.hpp"
#include "switchyard/model/function_terms.hpp"

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

[[noreturn]] void RefuseIt(const Constraint& constraint) {
  Refuse(constraint.Name(),
         " has no perspective: a set, a relaxation and a mixed-integer program take linear, conic "
         "and convex quadratic constraints");
}

// The side of a form that has one, as z_0 z_1 >= z_2^2 + ...; none where it is not convex.
std::optional<RotatedCone> ConeOf(const QuadraticConstraint& form) {
  if (!form.is_convex()) return std::nullopt;
  const bool mirrored = form.lower_bound()[0] > -kInfinity;
  const double sign = mirrored ? -1 : 1;
  try {
    return RotatedConeOf(sign * form.Q(), sign * form.b(),
                         mirrored ? -form.lower_bound()[0] : form.upper_bound()[0]);
  } catch (const InvalidArgument&) {  // it was only said to be convex
    return std::nullopt;
  }
}

bool IsFree(const QuadraticConstraint& form) {
  return form.lower_bound()[0] == -kInfinity && form.upper_bound()[0] == kInfinity;
}

bool IsLinear(const QuadraticConstraint& form) {
  return Eigen::VectorXd::Map(form.Q().valuePtr(), form.Q().nonZeros()).isZero(0);
}

void WriteRow(const QuadraticConstraint& form, ScaledRows& rows) {
  rows.AddTwoSided(form.lower_bound()[0], form.upper_bound()[0], [&](int row) {
    for (int j = 0; j < form.num_vars(); ++j) rows.Set(row, 1 + j, form.b()[j]);
  });
}

}  // namespace

bool HasPerspective(const Constraint& constraint) {
  if (const auto* form = dynamic_cast<const QuadraticConstraint*>(&constraint)) {
    return IsFree(*form) || IsLinear(*form) || ConeOf(*form).has_value();
  }
  return dynamic_cast<const LinearConstraint*>(&constraint) != nullptr ||
         dynamic_cast<const ConeConstraint*>(&constraint) != nullptr;
}

void RequirePerspective(const Constraint& constraint) {
  if (!HasPerspective(constraint)) RefuseIt(constraint);
}

void WriteScaled(const Constraint& constraint, ScaledRows& rows) {
  if (const auto* linear = dynamic_cast<const LinearConstraint*>(&constraint)) {
    return WriteLinear(*linear, rows);
  }
  if (const auto* cone = dynamic_cast<const ConeConstraint*>(&constraint)) {
    return WriteCone(*cone, rows);
  }
  const auto* form = dynamic_cast<const QuadraticConstraint*>(&constraint);
  if (form == nullptr) RefuseIt(constraint);
  if (IsFree(*form)) return;
  if (IsLinear(*form)) return WriteRow(*form, rows);
  std::optional<RotatedCone> z = ConeOf(*form);
  if (!z) RefuseIt(constraint);
  WriteCone(RotatedLorentzConeConstraint(std::move(z->A), z->b), rows);
}

}  // namespace switchyard
