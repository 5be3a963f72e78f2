// The exponential cone, the closure of {s : s_1 exp(s_0 / s_1) <= s_2, s_1 > 0}, with
// f(s) = -log psi - log s_1 - log s_2, psi = s_1 log(s_2 / s_1) - s_0 (Nesterov, Optim. Methods
// Softw. 27, 2012). Its dual is the closure of {z : z_0 < 0, -z_0 exp(z_1 / z_0 - 1) <= z_2}.
#include "solvers/cones/kinds.hpp"
#include "solvers/cones/nonsymmetric.hpp"

namespace switchyard::cones {
namespace {

struct Exponential {
  static constexpr int kTerms = 1;

  static bool InDual(const Vector3& z) {
    return z[0] < 0 && z[2] > 0 && 1 - z[1] / z[0] + std::log(-z[2] / z[0]) > 0;
  }

  static Psi At(int, const Vector3& s) {
    const double y = s[1], w = s[2], log = std::log(w / y);
    return {y * log - s[0], {-1, log - 1, y / w}, y, {0, 1 / y, -1 / w}};
  }
  static Vector3 Third(int, const Vector3& s, const Vector3& u, const Vector3& v) {
    const double y = s[1], w = s[2], ww = u[2] * v[2] / (w * w);
    return {0, u[1] * v[1] / (y * y) - ww, 2 * y * ww / w - (u[1] * v[2] + u[2] * v[1]) / (w * w)};
  }
  static Vector3 weights() { return {0, 1, 1}; }
  static Vector3 Inside() { return {-1, 1, 1}; }

  // z_0 = -1 / psi, z_1 = (log(s_2 / s_1) - 1) / psi + 1 / s_1, z_2 = (s_1 / psi + 1) / s_2: with
  // a = -z_0 and tau = 1 / (a s_1), tau + log(1 + tau) = z_1 / a + 1 + log(z_2 / a).
  static Vector3 Conjugate(const Vector3& z) {
    constexpr int kSteps = 50;
    const double a = -z[0];
    const double depth = z[1] / a + 1 + std::log(z[2] / a);
    double tau = depth < 1 ? depth / 2 : std::max(0.5, depth - std::log(depth));
    for (int k = 0; k < kSteps; ++k) {
      const double step = (tau + std::log1p(tau) - depth) / (1 + 1 / (1 + tau));
      tau = std::max(tau - step, tau / 8);
      if (std::abs(step) <= 1e-15 * tau) break;
    }
    const double y = 1 / (a * tau), w = (1 + a * y) / z[2];
    return {y * std::log(w / y) - 1 / a, y, w};
  }
};

}  // namespace

std::unique_ptr<Group> MakeExponential(const Layout& layout, double) {
  return std::make_unique<Nonsymmetric<Exponential>>(layout, Exponential{});
}

}  // namespace switchyard::cones
