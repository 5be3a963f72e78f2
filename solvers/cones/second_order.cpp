// The second-order cone {s : s_0 >= |s_1..|}, f(s) = -1/2 log <s, s>, with
// <u, v> = u_0 v_0 - u_1'v_1.
//
// Nesterov-Todd scaling (Vandenberghe, "The CVXOPT linear and quadratic cone program solvers",
// 2010): with s and z normalized to <., .> = 1 and J = diag(1, -1, ..., -1),
//
//   w = (s + Jz) / sqrt(2 (1 + s'z)),   H = eta^2 (2 w w' - J),   eta^4 = <s, s> / <z, z>.
//
// As <w, w> = 1, it is kept as w_0 + |w_1| = k and the direction u of w_1: H has the eigenvalues
// eta^2 k^2 and eta^2 / k^2 at q = (1, u) / sqrt 2 and (1, -u) / sqrt 2, and eta^2 elsewhere; so
// its powers, and H + r, are had without cancellation. With u o v = (u'v, u_0 v_1 + v_0 u_1) and W
// = H^1/2, lambda = W z = W^-1 s.
#include <algorithm>
#include <cmath>

#include "solvers/cones/kinds.hpp"

namespace switchyard::cones {
namespace {

using linalg::kLanes;
using linalg::Lanes;
using linalg::Max;
using linalg::Min;
using linalg::Sqrt;

/// Coordinates of L cones side by side, in vectors of that many doubles.
template <int L>
struct Pack;
template <>
struct Pack<1> {
  using V = double;
};
template <>
struct Pack<kLanes> {
  using V = Lanes;
};

template <int L>
SWITCHYARD_INLINE const typename Pack<L>::V* At(const double* p) {
  return reinterpret_cast<const typename Pack<L>::V*>(p);
}
template <int L>
SWITCHYARD_INLINE typename Pack<L>::V* At(double* p) {
  return reinterpret_cast<typename Pack<L>::V*>(p);
}

template <class V>
SWITCHYARD_INLINE V Dot(const V* u, const V* v, Index dim) {  // of u_1.. and v_1..
  V sum = u[0] * 0;
  for (Index i = 1; i < dim; ++i) sum += u[i] * v[i];
  return sum;
}

/// <u, u>, without the cancellation of its two terms.
template <class V>
SWITCHYARD_INLINE V Square(const V* u, Index dim) {
  const V norm = Sqrt(Dot(u, u, dim));
  return (u[0] - norm) * (u[0] + norm);
}

/// The least coefficient by which a step fails: 1 / the step at which u + a d leaves the cone, or
/// 0.
///
/// <u + a d, u + a d> = c + 2 b a + q a^2; in r = 1 / a: c r^2 + 2 b r + q = 0, whose larger root
/// is
/// (-b + sqrt(b^2 - c q)) / c. Where u is inside, c > 0.
template <class V>
SWITCHYARD_INLINE V LeavingRate(const V* u, const V* d, Index dim) {
  const V c = Square(u, dim);
  const V b = u[0] * d[0] - Dot(u, d, dim);
  const V q = d[0] * d[0] - Dot(d, d, dim);
  const V zero = c * 0;
  const V root = Sqrt(Max(b * b - c * q, zero));
  // For b > 0 the sum cancels: then the root is -q / (b + sqrt(...)).
  const V plain = (root - b) / c;
  const V other = -q / (root + b);
  return Max(b > zero ? other : plain, zero);
}

/// A symmetric matrix with eigenvalues `plus` and `minus` at (1, u) and (1, -u), `rest` elsewhere.
template <class V>
struct Spectral {
  V plus, minus, rest;

  /// out = this v; u_0 is not read; v and out may be the same.
  SWITCHYARD_INLINE void Apply(const V* u, const V* v, Index dim, V* out) const {
    const V along = Dot(u, v, dim);
    const V p = 0.5 * (v[0] + along), r = 0.5 * (v[0] - along);
    const V factor = (plus - rest) * p - (minus - rest) * r;
    for (Index i = 1; i < dim; ++i) out[i] = rest * v[i] + factor * u[i];
    out[0] = plus * p + minus * r;
  }
};

class SecondOrder final : public Group {
 public:
  explicit SecondOrder(const Layout& layout)
      : Group(layout),
        eta_(static_cast<std::size_t>(layout.count)),
        k_(static_cast<std::size_t>(layout.count)),
        u_(static_cast<std::size_t>(layout.rows())),
        lambda_(static_cast<std::size_t>(layout.rows())) {}

  [[nodiscard]] double degree() const override { return layout_.count; }
  [[nodiscard]] Index rank() const override { return 2; }

  void Center(double* s) const override {
    std::fill_n(s, layout_.rows(), 0.0);
    for (Index c = 0; c < layout_.count; ++c) s[layout_.Row(c, 0)] = 1;
  }

  [[nodiscard]] double Depth(const double* v) const override {
    double least = HUGE_VAL;
    for (Index c = 0; c < layout_.count; ++c) {
      double square = 0;
      for (Index i = 1; i < layout_.dim; ++i) square += std::pow(v[layout_.Row(c, i)], 2);
      least = std::min(least, v[layout_.Row(c, 0)] - std::sqrt(square));
    }
    return least;
  }

  void ScaleByIdentity() override {
    std::fill(eta_.begin(), eta_.end(), 1.0);
    std::fill(k_.begin(), k_.end(), 1.0);
    std::fill(u_.begin(), u_.end(), 0.0);
    Center(lambda_.data());
  }

  bool Scale(const double* s, const double* z, double) override {
    return layout_.lanes == 1 ? ScaleOne(s, z) : ScaleLanes(s, z);
  }
  void Multiply(const double* v, double* out) const override {
    layout_.lanes == 1 ? MultiplyOne(v, out) : MultiplyLanes(v, out);
  }
  void Divide(const double* v, double r, double* out) const override {
    layout_.lanes == 1 ? DivideOne(v, r, out) : DivideLanes(v, r, out);
  }
  // Along (1, u), by 1 - 1 / k^2.
  void Mend(const double* e, double* ds) const override {
    const Index lanes = layout_.lanes, dim = layout_.dim;
    for (Index c = 0; c < layout_.count; ++c) {
      const Index begin = layout_.Row(c, 0), end = begin + dim * lanes;
      double along = e[begin];
      for (Index i = begin + lanes; i < end; i += lanes) along += u_[i] * e[i];
      along *= 0.5 * (1 - 1 / (k_[c] * k_[c]));
      ds[begin] += along;
      for (Index i = begin + lanes; i < end; i += lanes) ds[i] += along * u_[i];
    }
  }
  void Correct(const double* s, const double*, const double* ds, const double* dz, double target,
               double* xi) const override {
    layout_.lanes == 1 ? CorrectOne(s, ds, dz, target, xi) : CorrectLanes(s, ds, dz, target, xi);
  }
  void Recenter(const double* s, const double* z, double low, double high,
                double* xi) const override {
    layout_.lanes == 1 ? RecenterOne(s, z, low, high, xi) : RecenterLanes(s, z, low, high, xi);
  }
  [[nodiscard]] double Step(const double* s, const double* z, const double* ds, const double* dz,
                            double most) const override {
    const double rate = layout_.lanes == 1 ? RateOne(s, z, ds, dz) : RateLanes(s, z, ds, dz);
    return rate * most > 1 ? 1 / rate : most;
  }

  void Inverse(double r, double* d, double* v, double* w) const override {
    const Index lanes = layout_.lanes, dim = layout_.dim;
    double* other = v + layout_.rows();
    for (Index c = 0; c < layout_.count; ++c) {
      const Spectral<double> inverse = Inverse(eta_[c], k_[c], r);
      w[c] = 0.5 * (inverse.plus - inverse.rest);
      w[layout_.count + c] = 0.5 * (inverse.minus - inverse.rest);
      const Index at = layout_.Row(c, 0);
      d[at] = inverse.rest;
      v[at] = other[at] = 1;
      for (Index i = at + lanes; i < at + dim * lanes; i += lanes) {
        d[i] = inverse.rest;
        v[i] = u_[i];
        other[i] = -u_[i];
      }
    }
  }

 private:
  template <class V>
  SWITCHYARD_INLINE static Spectral<V> Inverse(const V& eta, const V& k, double r) {
    const V square = eta * eta, ratio = k * k;
    return {1 / (square * ratio + r), 1 / (square / ratio + r), 1 / (square + r)};
  }
  template <class V>
  SWITCHYARD_INLINE static Spectral<V> Root(const V& eta, const V& k) {
    return {eta * k, eta / k, eta};
  }
  template <class V>
  SWITCHYARD_INLINE static Spectral<V> InverseRoot(const V& eta, const V& k) {
    return {1 / (eta * k), k / eta, 1 / eta};
  }

  template <int L>
  SWITCHYARD_INLINE bool ScaleBy(const double* s, const double* z) {
    using V = typename Pack<L>::V;
    const Index dim = layout_.dim;
    double inside = HUGE_VAL;
    for (Index c = 0; c < layout_.count; c += L, s += L * dim, z += L * dim) {
      const V* sc = At<L>(s);
      const V* zc = At<L>(z);
      V* u = At<L>(u_.data() + c * dim);
      const V ss = Square(sc, dim), zz = Square(zc, dim);
      inside = std::min({inside, linalg::Least(ss), linalg::Least(zz), linalg::Least(sc[0]),
                         linalg::Least(zc[0])});
      const V root_s = Sqrt(ss), root_z = Sqrt(zz);
      const V product = sc[0] * zc[0] + Dot(sc, zc, dim);
      const V length = Sqrt(2 + 2 * product / (root_s * root_z));
      const V of_s = 1 / (length * root_s), of_z = 1 / (length * root_z);
      for (Index i = 1; i < dim; ++i) u[i] = sc[i] * of_s - zc[i] * of_z;  // w_1
      const V square = Dot(u, u, dim);
      const V norm = Sqrt(square);
      const V inverse = 1 / Max(norm, norm * 0 + 1e-300);
      for (Index i = 1; i < dim; ++i) u[i] *= inverse;
      const V k = norm + Sqrt(1 + square), eta = Sqrt(root_s / root_z);
      *At<L>(k_.data() + c) = k;
      *At<L>(eta_.data() + c) = eta;
      Root(eta, k).Apply(u, zc, dim, At<L>(lambda_.data() + c * dim));
    }
    return inside > 0;
  }

  template <int L>
  SWITCHYARD_INLINE void MultiplyBy(const double* v, double* out) const {
    for (Index c = 0; c < layout_.count; c += L, v += L * layout_.dim, out += L * layout_.dim) {
      const auto& eta = *At<L>(eta_.data() + c);
      const auto& k = *At<L>(k_.data() + c);
      Root(eta * eta, k * k)
          .Apply(At<L>(u_.data() + c * layout_.dim), At<L>(v), layout_.dim, At<L>(out));
    }
  }
  template <int L>
  SWITCHYARD_INLINE void DivideBy(const double* v, double r, double* out) const {
    for (Index c = 0; c < layout_.count; c += L, v += L * layout_.dim, out += L * layout_.dim) {
      Inverse(*At<L>(eta_.data() + c), *At<L>(k_.data() + c), r)
          .Apply(At<L>(u_.data() + c * layout_.dim), At<L>(v), layout_.dim, At<L>(out));
    }
  }

  /// b <- W (lambda \ b).
  template <class V>
  SWITCHYARD_INLINE static void DivideByLambda(const V* lambda, const V* u, const V& eta,
                                               const V& k, Index dim, V* b) {
    const V x0 = (lambda[0] * b[0] - Dot(lambda, b, dim)) / Square(lambda, dim);
    const V inverse = 1 / lambda[0];
    for (Index i = 1; i < dim; ++i) b[i] = (b[i] - x0 * lambda[i]) * inverse;
    b[0] = x0;
    Root(eta, k).Apply(u, b, dim, b);
  }

  /// b <- (W^-1 s) o (W z), with room for one more vector behind it.
  template <class V>
  SWITCHYARD_INLINE static void Product(const V* s, const V* z, const V* u, const V& eta,
                                        const V& k, Index dim, V* b) {
    V* a = b + dim;
    InverseRoot(eta, k).Apply(u, s, dim, a);
    Root(eta, k).Apply(u, z, dim, b);
    const V first = a[0] * b[0] + Dot(a, b, dim);
    for (Index i = 1; i < dim; ++i) b[i] = a[0] * b[i] + b[0] * a[i];
    b[0] = first;
  }

  /// The eigenvalues of v are v_0 + |v_1| at (1, v_1 / |v_1|) / 2 and v_0 - |v_1| at the other.
  template <int L>
  SWITCHYARD_INLINE void RecenterBy(const double* s, const double* z, double low, double high,
                                    double* xi) const {
    using V = typename Pack<L>::V;
    const Index dim = layout_.dim;
    scratch_.resize(static_cast<std::size_t>(dim) * 2 * L);
    V* b = At<L>(scratch_.data());
    for (Index c = 0; c < layout_.count; c += L) {
      const Index at = c * dim;
      const V* u = At<L>(u_.data() + at);
      const V& eta = *At<L>(eta_.data() + c);
      const V& k = *At<L>(k_.data() + c);
      Product(At<L>(s + at), At<L>(z + at), u, eta, k, dim, b);
      const V norm = Sqrt(Dot(b, b, dim));
      const V plus = IntoRange<V>(b[0] + norm, low, high);
      const V minus = IntoRange<V>(b[0] - norm, low, high);
      const V share = 0.5 * (plus - minus) / Max(norm, norm * 0 + 1e-300);
      b[0] = 0.5 * (plus + minus);
      for (Index i = 1; i < dim; ++i) b[i] *= share;
      DivideByLambda(At<L>(lambda_.data() + at), u, eta, k, dim, b);
      for (Index i = 0; i < dim; ++i) At<L>(xi + at)[i] -= b[i];
    }
  }

  /// xi = s + W (lambda \ ((W^-1 ds) o (W dz) - target e)).
  template <int L>
  SWITCHYARD_INLINE void CorrectBy(const double* s, const double* ds, const double* dz,
                                   double target, double* xi) const {
    using V = typename Pack<L>::V;
    const Index dim = layout_.dim;
    scratch_.resize(static_cast<std::size_t>(dim) * 2 * L);
    V* b = At<L>(scratch_.data());
    for (Index c = 0; c < layout_.count; c += L) {
      const Index at = c * dim;
      const V* u = At<L>(u_.data() + at);
      const V& eta = *At<L>(eta_.data() + c);
      const V& k = *At<L>(k_.data() + c);
      Product(At<L>(ds + at), At<L>(dz + at), u, eta, k, dim, b);
      b[0] -= target;
      DivideByLambda(At<L>(lambda_.data() + at), u, eta, k, dim, b);
      for (Index i = 0; i < dim; ++i) At<L>(xi + at)[i] = At<L>(s + at)[i] + b[i];
    }
  }

  template <int L>
  SWITCHYARD_INLINE double RateBy(const double* s, const double* z, const double* ds,
                                  const double* dz) const {
    const Index dim = layout_.dim;
    auto largest = *At<L>(s) * 0;
    for (Index c = 0; c < layout_.count; c += L) {
      const Index at = c * dim;
      largest = Max(largest, LeavingRate(At<L>(s + at), At<L>(ds + at), dim));
      largest = Max(largest, LeavingRate(At<L>(z + at), At<L>(dz + at), dim));
    }
    return -linalg::Least(-largest);
  }

  bool ScaleOne(const double* s, const double* z);
  bool ScaleLanes(const double* s, const double* z);
  void MultiplyOne(const double* v, double* out) const;
  void MultiplyLanes(const double* v, double* out) const;
  void DivideOne(const double* v, double r, double* out) const;
  void DivideLanes(const double* v, double r, double* out) const;
  void CorrectOne(const double* s, const double* ds, const double* dz, double target,
                  double* xi) const;
  void CorrectLanes(const double* s, const double* ds, const double* dz, double target,
                    double* xi) const;
  void RecenterOne(const double* s, const double* z, double low, double high, double* xi) const;
  void RecenterLanes(const double* s, const double* z, double low, double high, double* xi) const;
  double RateOne(const double* s, const double* z, const double* ds, const double* dz) const;
  double RateLanes(const double* s, const double* z, const double* ds, const double* dz) const;

  linalg::Vector eta_, k_, u_, lambda_;
  mutable linalg::Vector scratch_;
};

SWITCHYARD_EACH_ISA bool SecondOrder::ScaleOne(const double* s, const double* z) {
  return ScaleBy<1>(s, z);
}
SWITCHYARD_EACH_ISA bool SecondOrder::ScaleLanes(const double* s, const double* z) {
  return ScaleBy<kLanes>(s, z);
}
SWITCHYARD_EACH_ISA void SecondOrder::MultiplyOne(const double* v, double* out) const {
  MultiplyBy<1>(v, out);
}
SWITCHYARD_EACH_ISA void SecondOrder::MultiplyLanes(const double* v, double* out) const {
  MultiplyBy<kLanes>(v, out);
}
SWITCHYARD_EACH_ISA void SecondOrder::DivideOne(const double* v, double r, double* out) const {
  DivideBy<1>(v, r, out);
}
SWITCHYARD_EACH_ISA void SecondOrder::DivideLanes(const double* v, double r, double* out) const {
  DivideBy<kLanes>(v, r, out);
}
SWITCHYARD_EACH_ISA void SecondOrder::CorrectOne(const double* s, const double* ds,
                                                 const double* dz, double target,
                                                 double* xi) const {
  CorrectBy<1>(s, ds, dz, target, xi);
}
SWITCHYARD_EACH_ISA void SecondOrder::CorrectLanes(const double* s, const double* ds,
                                                   const double* dz, double target,
                                                   double* xi) const {
  CorrectBy<kLanes>(s, ds, dz, target, xi);
}
SWITCHYARD_EACH_ISA void SecondOrder::RecenterOne(const double* s, const double* z, double low,
                                                  double high, double* xi) const {
  RecenterBy<1>(s, z, low, high, xi);
}
SWITCHYARD_EACH_ISA void SecondOrder::RecenterLanes(const double* s, const double* z, double low,
                                                    double high, double* xi) const {
  RecenterBy<kLanes>(s, z, low, high, xi);
}
SWITCHYARD_EACH_ISA double SecondOrder::RateOne(const double* s, const double* z, const double* ds,
                                                const double* dz) const {
  return RateBy<1>(s, z, ds, dz);
}
SWITCHYARD_EACH_ISA double SecondOrder::RateLanes(const double* s, const double* z,
                                                  const double* ds, const double* dz) const {
  return RateBy<kLanes>(s, z, ds, dz);
}

}  // namespace

std::unique_ptr<Group> MakeSecondOrder(const Layout& layout, double) {
  return std::make_unique<SecondOrder>(layout);
}

}  // namespace switchyard::cones
