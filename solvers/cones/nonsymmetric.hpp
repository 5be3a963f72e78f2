// solvers/cones/nonsymmetric.hpp - cones in three dimensions that are no symmetric ones.
//
// f(s) = -sum of log psi_i(s) - sum of c_j log s_j with psi_i concave, psi_i'' = -k_i v_i v_i':
// then f''(s) = F F', the columns of F being psi_i' / psi_i, sqrt(k_i / psi_i) v_i and sqrt(c_j) /
// s_j e_j: so known, it is known to high relative accuracy however near the boundary s is.
//
// The scaling of Tuncel (Found. Comput. Math. 1, 2001), as Dahl and Andersen use it (Math.
// Programming 194, 2022). With the shadows s~ = -grad f*(z), z~ = -grad f(s), mu = s'z / 3,
// d_s = s - mu s~, d_z = z - mu z~, the matrix T = H^-1 takes s to z and s~ to z~:
//
//   T = z z' / s'z + d_z d_z' / d_s'd_z + t n n',
//
// n orthogonal to s and d_s, and t of such size that T - mu f''(s) vanishes where the
// other terms do. Where d_s and d_z are all but 0, on the central path,
//
//   T = z z' / s'z + mu (f''(s) - z~z~' / 3).
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "solvers/cones/group.hpp"
#include "solvers/cones/orthogonalized.hpp"

namespace switchyard::cones {

/// One of the psi_i at a point.
struct Psi {
  double value = 0;
  Vector3 gradient;
  double k = 0;
  Vector3 v;
};

/// `Barrier` has
///   kTerms, Psi At(i, s)                   the psi_i
///   Vector3 Third(i, s, u, v)              psi_i'''(s)[u, v]
///   Vector3 weights()                      c; where c_j > 0, the cone has s_j >= 0
///   bool InDual(z)                         inside the dual cone, not on its boundary
///   Vector3 Conjugate(z)                   the s with -grad f(s) = z
///   Vector3 Inside()                       a point of the cone
template <class Barrier>
class Nonsymmetric final : public Group {
 public:
  Nonsymmetric(const Layout& layout, const Barrier& barrier)
      : Group(layout), barrier_(barrier), scaling_(static_cast<std::size_t>(layout.count)) {
    ScaleByIdentity();
  }

  [[nodiscard]] double degree() const override { return 3.0 * layout_.count; }
  [[nodiscard]] bool symmetric() const override { return false; }
  [[nodiscard]] Index rank() const override { return 3; }

  // The least of f(s) + |s|^2 / 2, by Newton steps that are damped as f's self-concordance asks.
  void Center(double* s) const override {
    constexpr int kSteps = 100;
    Vector3 at = barrier_.Inside();
    for (int k = 0; k < kSteps; ++k) {
      const Factor factor = FactorOf(at);
      const Matrix3 hessian = factor * factor.transpose() + Matrix3::Identity();
      const Vector3 gradient = at - Shadow(at);
      const Vector3 step = hessian.llt().solve(gradient);
      const double decrement = std::sqrt(step.dot(gradient));
      at -= step / (1 + decrement);
      if (!(decrement > 1e-15)) break;
    }
    for (Index c = 0; c < layout_.count; ++c) Put(at, c, s);
  }
  [[nodiscard]] double Depth(const double*) const override { return 0; }

  void ScaleByIdentity() override {
    for (Scaling& w : scaling_) {
      w.q = Matrix3::Identity();
      w.t = Vector3::Ones();
      w.s_shadow.setZero();
    }
  }

  bool Scale(const double* s, const double* z, double) override {
    for (Index c = 0; c < layout_.count; ++c) {
      const Vector3 at = Get(s, c), dual = Get(z, c);
      if (!InCone(at) || !barrier_.InDual(dual) || !ScaleOne(at, dual, scaling_[c])) return false;
    }
    return true;
  }

  void Multiply(const double* v, double* out) const override {
    for (Index c = 0; c < layout_.count; ++c) Put(scaling_[c].H(Get(v, c)), c, out);
  }
  void Divide(const double* v, double r, double* out) const override {
    for (Index c = 0; c < layout_.count; ++c) {
      const Scaling& w = scaling_[c];
      const Vector3 part = w.q.transpose() * Get(v, c);
      Put(w.q * Vector3(w.t.array() / (1 + r * w.t.array()) * part.array()), c, out);
    }
  }
  void Inverse(double r, double* d, double* v, double* w) const override {
    std::fill_n(d, layout_.rows(), 0.0);
    for (Index c = 0; c < layout_.count; ++c) {
      for (Index k = 0; k < 3; ++k) {
        Put(scaling_[c].q.col(k), c, v + std::ptrdiff_t{k} * layout_.rows());
        w[k * layout_.count + c] = scaling_[c].t[k] / (1 + r * scaling_[c].t[k]);
      }
    }
  }

  // Where H is larger than on average, by 1 - average / H.
  void Mend(const double* e, double* ds) const override {
    for (Index c = 0; c < layout_.count; ++c) {
      const Scaling& w = scaling_[c];
      const double mean = std::cbrt(w.t.prod());
      const Vector3 share = (1 - w.t.array() / mean).max(0.0);
      const Vector3 part = w.q.transpose() * Get(e, c);
      Put(Get(ds, c) + w.q * Vector3(share.cwiseProduct(part)), c, ds);
    }
  }

  // xi = s - target s~ - H f'''(s)[ds, f''(s)^-1 dz] / 2.
  void Correct(const double* s, const double*, const double* ds, const double* dz, double target,
               double* xi) const override {
    for (Index c = 0; c < layout_.count; ++c) {
      const Vector3 at = Get(s, c);
      const Scaling& w = scaling_[c];
      const Orthogonal f = Orthogonalized(FactorOf(at));
      const Vector3 other =
          f.q * Vector3((f.q.transpose() * Get(dz, c)).array() / f.square.array());
      Vector3 second = w.H(Third(at, Get(ds, c), other));
      if (!second.allFinite()) second.setZero();
      Put(at - target * w.s_shadow - 0.5 * second, c, xi);
    }
  }

  [[nodiscard]] double Step(const double* s, const double* z, const double* ds, const double* dz,
                            double most) const override {
    constexpr double kBack = 0.9, kLeast = 1e-12;
    double step = most;
    for (Index c = 0; c < layout_.count; ++c) {
      const Vector3 at = Get(s, c), dual = Get(z, c), move = Get(ds, c), dual_move = Get(dz, c);
      while (step > kLeast &&
             !(InCone(at + step * move) && barrier_.InDual(dual + step * dual_move))) {
        step *= kBack;
      }
    }
    return step > kLeast ? step : 0;
  }

  // mu s~'z~ / 3 is 1 on the path, and grows without bound off it.
  [[nodiscard]] bool NearPath(const double* s, const double* z, double mu) const override {
    constexpr double kFar = 1e6;
    for (Index c = 0; c < layout_.count; ++c) {
      const Vector3 at = Get(s, c), dual = Get(z, c);
      const double shadows = barrier_.Conjugate(dual).dot(Shadow(at)) / 3;
      if (!(std::max(mu, at.dot(dual) / 3) * shadows <= kFar)) return false;
    }
    return true;
  }

  // What the barrier's derivatives are, for those who check them.
  /// -grad f(s).
  [[nodiscard]] Vector3 Shadow(const Vector3& s) const {
    Vector3 z = Vector3::Zero();
    for (int i = 0; i < Barrier::kTerms; ++i) {
      const Psi psi = barrier_.At(i, s);
      z += psi.gradient / psi.value;
    }
    const Vector3 c = barrier_.weights();
    for (int j = 0; j < 3; ++j) z[j] += c[j] > 0 ? c[j] / s[j] : 0;
    return z;
  }
  using Factor = Eigen::Matrix<double, 3, 2 * Barrier::kTerms + 3>;
  /// f''(s) is this times its transpose.
  [[nodiscard]] Factor FactorOf(const Vector3& s) const {
    Factor f = Factor::Zero();
    for (int i = 0; i < Barrier::kTerms; ++i) {
      const Psi psi = barrier_.At(i, s);
      f.col(2 * i) = psi.gradient / psi.value;
      f.col(2 * i + 1) = std::sqrt(psi.k / psi.value) * psi.v;
    }
    const Vector3 c = barrier_.weights();
    for (int j = 0; j < 3; ++j) {
      if (c[j] > 0) f(j, 2 * Barrier::kTerms + j) = std::sqrt(c[j]) / s[j];
    }
    return f;
  }
  /// f'''(s)[u, v].
  [[nodiscard]] Vector3 Third(const Vector3& s, const Vector3& u, const Vector3& v) const {
    Vector3 third = Vector3::Zero();
    for (int i = 0; i < Barrier::kTerms; ++i) {
      const Psi psi = barrier_.At(i, s);
      const Vector3 g = psi.gradient / psi.value;
      const double gu = g.dot(u), gv = g.dot(v), vu = psi.v.dot(u), vv = psi.v.dot(v);
      const double k = psi.k / psi.value;
      third -= (2 * gu * gv + k * vu * vv) * g + k * (gv * vu + gu * vv) * psi.v +
               barrier_.Third(i, s, u, v) / psi.value;
    }
    const Vector3 c = barrier_.weights();
    for (int j = 0; j < 3; ++j) {
      if (c[j] > 0) third[j] -= 2 * c[j] * u[j] * v[j] / (s[j] * s[j] * s[j]);
    }
    return third;
  }

 private:
  struct Scaling {
    Matrix3 q;  // T = q diag(t) q'
    Vector3 t;
    Vector3 s_shadow;

    // H as one matrix would be rounded as its largest entry is.
    [[nodiscard]] Vector3 H(const Vector3& v) const {
      return q * Vector3((q.transpose() * v).cwiseQuotient(t));
    }
  };
  [[nodiscard]] bool InCone(const Vector3& s) const {
    const Vector3 c = barrier_.weights();
    for (int j = 0; j < 3; ++j) {
      if (c[j] > 0 && !(s[j] > 0)) return false;
    }
    for (int i = 0; i < Barrier::kTerms; ++i) {
      if (!(barrier_.At(i, s).value > 0)) return false;
    }
    return true;
  }

  bool ScaleOne(const Vector3& s, const Vector3& z, Scaling& w) const {
    constexpr double kCentral = 1e-6;
    w.s_shadow = barrier_.Conjugate(z);
    const Vector3 z_shadow = Shadow(s);
    const double sz = s.dot(z), mu = sz / 3;
    const Factor f = FactorOf(s);
    const Vector3 d_s = s - mu * w.s_shadow, d_z = z - mu * z_shadow;
    const double dd = d_s.dot(d_z);
    // mu s~'z~ / 3 - 1 = d_s'd_z / s'z.
    if (dd > kCentral * sz) {
      Vector3 n = s.cross(d_s).normalized();
      n -= s * (n.dot(s) / s.squaredNorm());  // s and d_s may be all but parallel
      const Vector3 of_d = f * (f.transpose() * d_s);
      const Vector3 beside = z_shadow.cross(of_d - z_shadow * (z_shadow.dot(d_s) / 3));
      const double t = mu * (f.transpose() * beside).squaredNorm() / std::pow(n.dot(beside), 2);
      Matrix3 columns;
      columns << z / std::sqrt(sz), d_z / std::sqrt(dd), std::sqrt(t) * n;
      if (columns.allFinite() && Take(Orthogonalized(columns), w)) return true;
    }
    // F - z~ (F's)' / 3, as z~ = F F's.
    Eigen::Matrix<double, 3, Factor::ColsAtCompileTime + 1> columns;
    columns << z / std::sqrt(sz),
        std::sqrt(mu) * (f - z_shadow * (f.transpose() * s).transpose() / 3);
    return columns.allFinite() && Take(Orthogonalized(columns), w);
  }

  static bool Take(const Orthogonal& of, Scaling& w) {
    w.q = of.q;
    w.t = of.square;
    return w.q.allFinite() && w.t.minCoeff() > 0;
  }

  [[nodiscard]] Vector3 Get(const double* v, Index c) const {
    return {v[layout_.Row(c, 0)], v[layout_.Row(c, 1)], v[layout_.Row(c, 2)]};
  }
  void Put(const Vector3& from, Index c, double* v) const {
    for (Index i = 0; i < 3; ++i) v[layout_.Row(c, i)] = from[i];
  }

  Barrier barrier_;
  std::vector<Scaling> scaling_;
};

}  // namespace switchyard::cones
