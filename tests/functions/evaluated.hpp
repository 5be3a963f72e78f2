// tests/functions/evaluated.hpp - all that a function says at a point, as dense matrices.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "switchyard/functions/function.hpp"

namespace switchyard {

struct Evaluated {
  Eigen::VectorXd values;
  Eigen::MatrixXd jacobian;  // 0 where there is none
  Eigen::MatrixXd hessian;   // both triangles
};

inline Evaluated At(const Function& f, const Eigen::VectorXd& x, Eigen::VectorXd weights = {}) {
  if (weights.size() == 0) weights = Eigen::VectorXd::Ones(f.num_outputs());
  Evaluated out;
  out.values.resize(f.num_outputs());
  std::vector<double> J(f.jacobian().row.size());
  std::vector<double> H(f.hessian().row.size());
  f.Evaluate({.x = x.data(),
              .values = out.values.data(),
              .jacobian = f.has_jacobian() ? J.data() : nullptr,
              .weights = weights.data(),
              .hessian = f.has_hessian() ? H.data() : nullptr});
  out.jacobian.setZero(f.num_outputs(), f.num_vars());
  for (int k = 0; k < f.jacobian().size(); ++k) {
    out.jacobian(f.jacobian().row[k], f.jacobian().col[k]) = J[k];
  }
  out.hessian.setZero(f.num_vars(), f.num_vars());
  for (int k = 0; k < f.hessian().size(); ++k) {
    out.hessian(f.hessian().row[k], f.hessian().col[k]) = H[k];
    out.hessian(f.hessian().col[k], f.hessian().row[k]) = H[k];
  }
  return out;
}

inline SparsityPattern Pattern(int rows, int cols, const std::vector<std::pair<int, int>>& places) {
  SparsityPattern pattern{.rows = rows, .cols = cols, .row = {}, .col = {}};
  for (const auto& [i, j] : places) pattern.Add(i, j);
  return pattern;
}

}  // namespace switchyard
