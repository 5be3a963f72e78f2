#include "core/bridges/smooth_cones.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace switchyard {
namespace {

constexpr double kMostSlope = 2;  // p

double Length(const double* w, std::int32_t count) {
  return std::sqrt(std::inner_product(w, w + count, w, 0.0));
}

// max 2 p |w| - p^2 d over p <= kMostSlope, and where it is.
double BestSlope(double length, double d) {
  return length < kMostSlope * d ? length / d : kMostSlope;
}

constexpr SmoothCone kSecondOrder = {
    SY_CONE_SECOND_ORDER,
    [](std::int32_t dim) { return dim > 1 ? 1 : 0; },
    [](std::int32_t i) { return i == 0; },
    [](std::int32_t i, std::int32_t j) { return i == 0 || i == j; },
    [](const double* s, std::int32_t dim, double, double* c) {
      const double length = Length(s + 1, dim - 1);
      const double p = length == 0 ? 0 : BestSlope(length, s[0]);
      *c = s[0] - p * (2 * length - p * s[0]);
    },
    [](const double* s, std::int32_t dim, double, double* J) {
      const double length = Length(s + 1, dim - 1);
      const double p = length == 0 ? 0 : BestSlope(length, s[0]);
      J[0] = 1 + p * p;
      for (std::int32_t j = 1; j < dim; ++j) J[j] = length == 0 ? 0 : -2 * p * s[j] / length;
    },
    [](const double* s, std::int32_t dim, double, const double* w, double* H) {
      const double length = Length(s + 1, dim - 1);
      const double d = std::max(s[0], length / kMostSlope);
      const double curvature = d > 0 ? -2 * *w / d : 0;
      *H++ = d > 0 ? curvature * (length / d) * (length / d) : 0;
      for (std::int32_t j = 1; j < dim; ++j) {
        *H++ = d > 0 ? -curvature * s[j] / d : 0;
        *H++ = curvature;
      }
    }};

constexpr SmoothCone kExponential = {
    SY_CONE_EXPONENTIAL,
    [](std::int32_t) { return 1; },
    [](std::int32_t i) { return i >= 1; },
    [](std::int32_t i, std::int32_t) { return i >= 1; },
    [](const double* s, std::int32_t, double, double* c) {
      *c = (s[1] == 0 ? 0 : s[1] * std::log(s[2] / s[1])) - s[0];
    },
    [](const double* s, std::int32_t, double, double* J) {
      J[0] = -1;
      J[1] = std::log(s[2] / s[1]) - 1;
      J[2] = s[1] / s[2];
    },
    [](const double* s, std::int32_t, double, const double* w, double* H) {
      H[0] = -*w / s[1];
      H[1] = *w / s[2];
      H[2] = -*w * s[1] / (s[2] * s[2]);
    }};

double Power(const double* s, double a) { return std::pow(s[0], a) * std::pow(s[1], 1 - a); }

constexpr SmoothCone kPower = {
    SY_CONE_POWER,
    [](std::int32_t) { return 2; },
    [](std::int32_t i) { return i <= 1; },
    [](std::int32_t, std::int32_t j) { return j <= 1; },
    [](const double* s, std::int32_t, double a, double* c) {
      c[0] = Power(s, a) - s[2];
      c[1] = Power(s, a) + s[2];
    },
    [](const double* s, std::int32_t, double a, double* J) {
      const double p = Power(s, a);
      J[0] = J[1] = a * p / s[0];
      J[2] = J[3] = (1 - a) * p / s[1];
      J[4] = -1;
      J[5] = 1;
    },
    [](const double* s, std::int32_t, double a, const double* w, double* H) {
      const double p = (w[0] + w[1]) * a * (1 - a) * Power(s, a);
      H[0] = -p / (s[0] * s[0]);
      H[1] = p / (s[0] * s[1]);
      H[2] = -p / (s[1] * s[1]);
    }};

}  // namespace

const SmoothCone* SmoothConeOf(sy_cone_kind kind) {
  static constexpr std::array<const SmoothCone*, 3> kCones = {&kSecondOrder, &kExponential,
                                                              &kPower};
  const auto found = std::find_if(kCones.begin(), kCones.end(),
                                  [&](const SmoothCone* cone) { return cone->kind == kind; });
  return found == kCones.end() ? nullptr : *found;
}

}  // namespace switchyard
