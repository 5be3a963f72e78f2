// The power cone {s : s_0^a s_1^b >= |s_2|, s_0, s_1 >= 0}, b = 1 - a, with
// f(s) = -log(psi_0 psi_1) - b log s_0 - a log s_1, psi_i = s_0^a s_1^b +- s_2 (Chares, Cones and
// interior-point algorithms for structured convex optimization involving powers and exponentials,
// 2009). Its dual is {z : (z_0 / a)^a (z_1 / b)^b >= |z_2|, z_0, z_1 >= 0}.
#include "solvers/cones/kinds.hpp"
#include "solvers/cones/nonsymmetric.hpp"

namespace switchyard::cones {
namespace {

struct Power {
  double a, b;

  static constexpr int kTerms = 2;

  [[nodiscard]] bool InDual(const Vector3& z) const {
    return z[0] > 0 && z[1] > 0 && std::pow(z[0] / a, a) * std::pow(z[1] / b, b) > std::abs(z[2]);
  }

  [[nodiscard]] Psi At(int i, const Vector3& s) const {
    const double mean = std::pow(s[0], a) * std::pow(s[1], b), sign = i == 0 ? 1 : -1;
    return {mean + sign * s[2],
            {a * mean / s[0], b * mean / s[1], sign},
            a * b * mean,
            {1 / s[0], -1 / s[1], 0}};
  }
  [[nodiscard]] Vector3 Third(int, const Vector3& s, const Vector3& u, const Vector3& v) const {
    const double mean = std::pow(s[0], a) * std::pow(s[1], b);
    const double ux = u[0] / s[0], uy = u[1] / s[1], vx = v[0] / s[0], vy = v[1] / s[1];
    const double mixed = ux * vy + uy * vx;
    const double x = (a - 1) * ((a - 2) * ux * vx + b * mixed) + b * (b - 1) * uy * vy;
    const double y = (b - 1) * ((b - 2) * uy * vy + a * mixed) + a * (a - 1) * ux * vx;
    return {a * mean * x / s[0], b * mean * y / s[1], 0};
  }
  [[nodiscard]] Vector3 weights() const { return {b, a, 0}; }
  [[nodiscard]] static Vector3 Inside() { return {1, 1, 0}; }

  // With e = psi_0 psi_1 / s_2^2, z_0 s_0 = 2 a / e + a + 1, z_1 s_1 = 2 b / e + b + 1, and
  // 2 a log(1 + k_a e) + 2 b log(1 + k_b e) - log(1 + e) = 2 log((z_0 / a)^a (z_1 / b)^b / |z_2|),
  // k_c = (1 + c) / (2 c).
  [[nodiscard]] Vector3 Conjugate(const Vector3& z) const {
    const double depth =
        2 * (a * std::log(z[0] / a) + b * std::log(z[1] / b) - std::log(std::abs(z[2])));
    const double share = depth < kDeep ? Inverse(SolveForLog(depth)) : 0;  // s_2^2 / psi
    const double x = (2 * a * share + 1 + a) / z[0], y = (2 * b * share + 1 + b) / z[1];
    const double psi = std::pow(x, 2 * a) * std::pow(y, 2 * b) / (1 + share);
    return {x, y, -0.5 * z[2] * psi};
  }

 private:
  static constexpr double kDeep = 600;  // exp of it is finite; s_2 makes no difference there

  static double Inverse(double log) { return std::exp(-log); }

  /// log e: the function rises with it.
  [[nodiscard]] double SolveForLog(double depth) const {
    constexpr int kSteps = 100;
    const double ka = (1 + a) / (2 * a), kb = (1 + b) / (2 * b);
    double low = -800, high = 800;
    double log = depth < 1 ? std::log(depth / 2) : depth;
    for (int k = 0; k < kSteps; ++k) {
      const double e = std::exp(log);
      const double value = 2 * a * std::log1p(ka * e) + 2 * b * std::log1p(kb * e) - std::log1p(e);
      const double slope =
          2 * a * ka * e / (1 + ka * e) + 2 * b * kb * e / (1 + kb * e) - e / (1 + e);
      (value > depth ? high : low) = log;
      const double next = log - (value - depth) / slope;
      const double inside = next > low && next < high ? next : 0.5 * (low + high);
      const double change = std::abs(inside - log);
      log = inside;
      if (change <= 1e-15 * std::max(1.0, std::abs(log))) break;
    }
    return log;
  }
};

}  // namespace

std::unique_ptr<Group> MakePower(const Layout& layout, double parameter) {
  return std::make_unique<Nonsymmetric<Power>>(layout, Power{parameter, 1 - parameter});
}

}  // namespace switchyard::cones
