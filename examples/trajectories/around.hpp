// A polytope along a move from one configuration to another.
#pragma once

#include <Eigen/QR>
#include <algorithm>

#include "switchyard/sets/hpolyhedron.hpp"

/// Along the move, and `width` to each side of it in all directions across, tapered towards `to`.
inline switchyard::HPolyhedron Around(const Eigen::VectorXd& from, const Eigen::VectorXd& to,
                                      double width) {
  const auto n = from.size();
  const Eigen::VectorXd along = (to - from).normalized();
  const double length = (to - from).norm();
  const Eigen::MatrixXd basis =
      Eigen::HouseholderQR<Eigen::MatrixXd>(Eigen::MatrixXd(along)).householderQ() *
      Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd A(2 * n, n);
  Eigen::VectorXd b(2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::VectorXd face = basis.col(i);
    const Eigen::VectorXd taper = (i == 0 ? 0 : 0.3 * width / length) * along;
    const double low = std::min(face.dot(from), face.dot(to));
    const double high = std::max(face.dot(from), face.dot(to));
    A.row(2 * i) = face + taper;
    A.row(2 * i + 1) = -face + taper;
    b[2 * i] = high + width + taper.dot(from);
    b[2 * i + 1] = -low + width + taper.dot(from);
  }
  return {A, b};
}
