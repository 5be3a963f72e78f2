// core/model/checks.hpp - what the numbers of a cost or constraint must be, and how it is said.
#pragma once

#include <string_view>

#include "switchyard/model/evaluator.hpp"

namespace switchyard {

/// Throws InvalidArgument, in the words of `name`, where an entry is infinite or NaN.
void CheckFinite(std::string_view name, std::string_view what, double number);
void CheckFinite(std::string_view name, std::string_view what, const VectorRef& v);
void CheckFinite(std::string_view name, std::string_view what, const SparseMatrix& M);

/// Throws InvalidArgument where the matrix is not rows x cols.
void CheckShape(std::string_view name, std::string_view what, const SparseMatrix& M,
                Eigen::Index rows, Eigen::Index cols);
void CheckSize(std::string_view name, std::string_view what, const VectorRef& v, Eigen::Index size);

/// How far y is outside of lower <= y <= upper, the largest of its rows.
double BoxViolation(const Eigen::VectorXd& y, const Eigen::VectorXd& lower,
                    const Eigen::VectorXd& upper);

}  // namespace switchyard
