// solvers/cones/orthogonalized.hpp - eigenvalues of F F' in three dimensions, the small ones as
// accurate as the large.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace switchyard::cones {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

/// q diag(square) q', the columns of q of length 1, square descending.
struct Orthogonal {
  Matrix3 q;
  Vector3 square;
};

/// Turns two columns so that they are orthogonal. False where they were.
template <class Columns>
bool Rotate(Columns& columns, int i, int j) {
  constexpr double kOrthogonal = 1e-15;
  const Vector3 a = columns.col(i), b = columns.col(j);
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  if (!(std::abs(ab) > kOrthogonal * std::sqrt(aa * bb))) return false;
  const double zeta = (bb - aa) / (2 * ab);
  const double tangent = std::copysign(1 / (std::abs(zeta) + std::hypot(1, zeta)), zeta);
  const double cosine = 1 / std::hypot(1, tangent), sine = cosine * tangent;
  columns.col(i) = cosine * a - sine * b;
  columns.col(j) = sine * a + cosine * b;
  return true;
}

/// Of F F', F three rows and any number of columns, by rotations that make the columns orthogonal:
/// that gives small eigenvalues to high relative accuracy, too (Demmel and Veselic, SIAM J. Matrix
/// Anal. Appl. 13, 1992).
template <class Columns>
Orthogonal Orthogonalized(Columns columns) {
  constexpr int kSweeps = 30;
  constexpr int kCount = Columns::ColsAtCompileTime;
  for (int sweep = 0, turned = 1; sweep < kSweeps && turned > 0; ++sweep) {
    turned = 0;
    for (int i = 0; i < kCount - 1; ++i) {
      for (int j = i + 1; j < kCount; ++j) turned += Rotate(columns, i, j) ? 1 : 0;
    }
  }
  // Of more than three, all but the longest three have become 0.
  std::array<int, kCount> order;
  for (int k = 0; k < kCount; ++k) order[static_cast<std::size_t>(k)] = k;
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return columns.col(a).squaredNorm() > columns.col(b).squaredNorm();
  });
  Orthogonal made;
  for (int k = 0; k < 3; ++k) {
    const Vector3 column = columns.col(order[static_cast<std::size_t>(k)]);
    made.square[k] = column.squaredNorm();
    made.q.col(k) = column / std::sqrt(made.square[k]);
  }
  return made;
}

}  // namespace switchyard::cones
