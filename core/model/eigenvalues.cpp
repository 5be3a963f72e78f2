#include "core/model/eigenvalues.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace switchyard {

std::string DescribeNegativeEigenvalues(const Eigen::Ref<const Eigen::MatrixXd>& M,
                                        double tolerance) {
  const Eigen::MatrixXd lower = M.transpose();  // the solver reads the lower triangle
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(lower, Eigen::EigenvaluesOnly).eigenvalues();
  const auto negative =
      std::count_if(values.begin(), values.end(), [&](double v) { return v < -tolerance; });
  if (negative == 0) return "";
  std::string text = Text("eigenvalue 0 of ", values.size(), " is ", values[0]);
  if (negative > 1) text += Text(", ", negative, " are negative");
  return text;
}

}  // namespace switchyard
