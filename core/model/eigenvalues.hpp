// core/model/eigenvalues.hpp - in what way a symmetric matrix is not positive semidefinite.
#pragma once

#include <string>

#include "switchyard/model/evaluator.hpp"

namespace switchyard {

/// "eigenvalue 0 of 3 is -0.5" and how many more are negative; ascending, the upper triangle is
/// read. "" where none is below -tolerance.
std::string DescribeNegativeEigenvalues(const Eigen::Ref<const Eigen::MatrixXd>& M,
                                        double tolerance = 0);

}  // namespace switchyard
