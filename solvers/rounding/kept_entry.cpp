#include "solvers/rounding/kept_entry.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "switchyard/cones.hpp"

namespace switchyard::rounding {
namespace {

constexpr double kJustInside = 1 - 0x1p-48;  // of a norm, over the rounding of its evaluation

double Norm(std::span<const double> v) {
  long double square = 0;
  for (const double e : v) square += static_cast<long double>(e) * e;
  return static_cast<double>(std::sqrt(square));
}

/// |tail| <= head.
void Shorten(std::span<double> tail, double head) {
  const double norm = Norm(tail);
  if (norm <= head * kJustInside) return;
  const double factor = head * kJustInside / norm;
  for (double& v : tail) v *= factor;
  if (!(factor > 0) || !(Norm(tail) <= head)) std::fill(tail.begin(), tail.end(), 0.0);
}

/// 2 head other >= |tail|^2.
void RaiseOther(double& other, double head, std::span<double> tail) {
  const double norm = Norm(tail);
  const double needed = norm == 0 ? 0 : norm * norm / (2 * head) / kJustInside;
  if (std::isfinite(needed)) {
    other = std::max({other, needed, 0.0});
  } else {
    std::fill(tail.begin(), tail.end(), 0.0);
    other = std::max(other, 0.0);
  }
}

/// -y_0 exp(y_1 / y_0 - 1) <= y_2 for y_0 < 0, by a larger y_1.
void RaiseSecond(double* y) {
  if (!(y[0] < 0)) return;
  const double needed = y[0] * (1 + std::log(y[2] / -y[0]));
  if (std::isfinite(needed)) {
    y[1] = std::max(y[1], needed + (1 - kJustInside) * (std::abs(needed) - y[0]));
  } else {
    y[0] = 0;
  }
}

/// (y_i / a)^a (y_k / b)^b >= |y_2| for a + b = 1, by a larger y_k.
void RaiseHead(double& y_k, double b, double y_i, double a, double& tail) {
  const double needed =
      tail == 0 ? 0 : b * std::exp((std::log(std::abs(tail)) - a * std::log(y_i / a)) / b);
  if (std::isfinite(needed)) {
    y_k = std::max(y_k, needed * (1 + 64 * (1 - kJustInside)));
  } else {
    tail = 0;
  }
}

/// The entry of rows i <= j.
int AtOf(int i, int j) { return j * (j + 1) / 2 + i; }

/// Row and column `place` scaled, and then scaled down, while other diagonals are raised, by more
/// and more until the eigenvalues are positive by more than their rounding; 0 in the end.
void KeepDiagonal(const sy_cone& cone, int row, double kept, double* y) {
  const int order = cones_detail::OrderOf(cone.dim);
  const auto scale = [&](double factor) {
    for (int i = 0; i < order; ++i) {
      if (i != row) y[AtOf(std::min(i, row), std::max(i, row))] *= factor;
    }
  };
  const double old = y[AtOf(row, row)];
  scale(kept > 0 && old > 0 ? std::sqrt(kept / old) : 0);
  y[AtOf(row, row)] = kept;
  const double radius = *std::max_element(y, y + cone.dim);
  for (const double share : {0.0, 0x1p-40, 0x1p-32, 0x1p-26, 0x1p-20, 1.0}) {
    scale(1 - share);
    for (int i = 0; i < order; ++i) {
      if (i != row && y[AtOf(i, i)] > 0) y[AtOf(i, i)] += share < 1 ? share * radius : 0;
    }
    std::vector<double> moved(y, y + cone.dim);
    FactsOf(cone.kind).into_dual(moved.data(), cone.dim, cone.parameter);
    if (moved[static_cast<std::size_t>(AtOf(row, row))] == kept) return;
  }
}

/// j where `place` is the diagonal's entry of row j, else -1.
int DiagonalRow(int place) {
  const int row = cones_detail::OrderOf(place + 1) - 1;
  return row >= 0 && AtOf(row, row) == place ? row : -1;
}

void Mend(const sy_cone& cone, int place, double* y) {
  const double kept = y[place];
  if (cone.kind == SY_CONE_SECOND_ORDER && place == 0) {
    Shorten({y + 1, y + cone.dim}, kept);
  } else if (cone.kind == SY_CONE_ROTATED && place <= 1) {
    RaiseOther(y[1 - place], kept, {y + 2, y + cone.dim});
  } else if (cone.kind == SY_CONE_EXPONENTIAL && place == 2) {
    RaiseSecond(y);
  } else if (cone.kind == SY_CONE_POWER) {
    const double exponent[] = {cone.parameter, 1 - cone.parameter};
    const int raised = place == 0 ? 1 : 0;
    RaiseHead(y[raised], exponent[raised], y[1 - raised], exponent[1 - raised], y[2]);
  }
}

}  // namespace

bool IsHead(const sy_cone& cone, int place) {
  switch (cone.kind) {
    case SY_CONE_NONNEGATIVE:
      return true;
    case SY_CONE_SECOND_ORDER:
      return place == 0;
    case SY_CONE_ROTATED:
    case SY_CONE_POWER:
      return place <= 1;
    case SY_CONE_EXPONENTIAL:
      return place >= 1;
    case SY_CONE_PSD:
      return DiagonalRow(place) >= 0;
    default:
      return false;
  }
}

bool KeepEntry(const sy_cone& cone, int place, double kept, double* y) {
  std::vector<double> moved(y, y + cone.dim);
  const int row = cone.kind == SY_CONE_PSD ? DiagonalRow(place) : -1;
  if (row >= 0) {
    KeepDiagonal(cone, row, kept, moved.data());
  } else {
    moved[static_cast<std::size_t>(place)] = kept;
    Mend(cone, place, moved.data());
  }
  FactsOf(cone.kind).into_dual(moved.data(), cone.dim, cone.parameter);
  if (moved[static_cast<std::size_t>(place)] != kept) return false;
  std::copy(moved.begin(), moved.end(), y);
  return true;
}

}  // namespace switchyard::rounding
