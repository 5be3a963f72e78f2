// solvers/cones/group.hpp - what an interior-point method asks of a cone.
#pragma once

#include <cstdint>
#include <memory>

#include "solvers/linalg/simd.hpp"
#include "solvers/linalg/symmetric_pattern.hpp"
#include "switchyard/abi.h"

namespace switchyard::cones {

using linalg::Index;

/// Where the coordinates of `count` cones of one kind, dimension and parameter stand. `lanes` of
/// them stand side by side: first their coordinates 0, then their coordinates 1, and so on.
struct Layout {
  Index count = 0;
  Index dim = 0;
  Index lanes = 1;
  bool operator==(const Layout&) const = default;

  [[nodiscard]] Index rows() const { return count * dim; }
  [[nodiscard]] Index Row(Index cone, Index coordinate) const {
    return (cone / lanes * dim + coordinate) * lanes + cone % lanes;
  }
};

/// Equal cones K, with what their barriers say at the current point (s, z) in int K x int K*.
///
/// The linearized complementarity is ds = -(xi + H dz), H symmetric and positive definite with
/// H z = s: for a symmetric cone the Nesterov-Todd scaling H = W'W. All vectors are those of the
/// group's rows, by its layout.
class Group {
 public:
  explicit Group(const Layout& layout) : layout_(layout) {}
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;
  virtual ~Group() = default;

  [[nodiscard]] const Layout& layout() const { return layout_; }
  /// The parameter of the barrier, of all cones: s'z = degree where s and z are central, mu = 1.
  [[nodiscard]] virtual double degree() const = 0;
  /// Self-dual and homogeneous: steps need only stay inside, and correctors are Mehrotra's.
  [[nodiscard]] virtual bool symmetric() const { return true; }

  /// The point with s = z = -grad f(s).
  virtual void Center(double* s) const = 0;
  /// How deep v is inside, in units of the center; negative: how far outside. Symmetric cones only.
  [[nodiscard]] virtual double Depth(const double* v) const = 0;

  /// H at (s, z); false where they are not inside, to rounding.
  virtual bool Scale(const double* s, const double* z, double mu) = 0;
  /// H = 1.
  virtual void ScaleByIdentity() = 0;
  virtual void Multiply(const double* v, double* h_v) const = 0;
  /// out = (H + r)^-1 v.
  virtual void Divide(const double* v, double r, double* out) const = 0;

  /// ds is one of complementarity, ds + e one of feasibility. Where H is so much larger along some
  /// direction than across it that rounding of dz shows in ds, e is to be believed: adds that.
  virtual void Mend(const double* /*e*/, double* /*ds*/) const {}

  /// xi of a step that aims at complementarity `target` (sigma mu) and takes what the predictor
  /// (ds, dz) shows of second order into account.
  virtual void Correct(const double* s, const double* z, const double* ds, const double* dz,
                       double target, double* xi) const = 0;

  /// Where the eigenvalues of (W^-1 s) o (W z) at a trial point (s, z) leave [low, high], what
  /// would bring them there, but for at most `high` down: subtracts W (lambda \ that) from xi
  /// (Gondzio, Comput. Optim. Appl. 6, 1996). Symmetric cones only.
  virtual void Recenter(const double* /*s*/, const double* /*z*/, double /*low*/, double /*high*/,
                        double* /*xi*/) const {}

  /// The largest step in [0, most] along (ds, dz) on which (s, z) stays inside.
  [[nodiscard]] virtual double Step(const double* s, const double* z, const double* ds,
                                    const double* dz, double most) const = 0;
  /// Is (s, z) near enough to the central path, at complementarity mu, for Scale to do well there?
  [[nodiscard]] virtual bool NearPath(const double*, const double*, double) const { return true; }

  /// (H + r)^-1 of each cone as diag(d) + sum of w_k v_k v_k', k < rank(): `d` and each v by the
  /// layout, one v behind the other; w by cone, likewise.
  [[nodiscard]] virtual Index rank() const = 0;
  virtual void Inverse(double r, double* d, double* v, double* w) const = 0;

 protected:
  Layout layout_;
};

/// What the method asks of an array of numbers s, z > 0: the cone that has no coordinates to
/// couple, and most of all rows.
struct Orthant {
  static double Step(const double* s, const double* z, const double* ds, const double* dz,
                     Index count, double most);
  /// h = s / z.
  static void Scale(const double* s, const double* z, Index count, double* h);
  static void Recenter(const double* trial_s, const double* trial_z, const double* z, Index count,
                       double low, double high, double* xi);
  /// xi = s + (ds dz - target) / z.
  static void Correct(const double* s, const double* z, const double* ds, const double* dz,
                      Index count, double target, double* xi);
};

/// What brings `value` into [low, high], but for at most `high` down.
template <class V>
SWITCHYARD_INLINE V IntoRange(const V& value, double low, double high) {
  const V zero = value * 0;
  return linalg::Max(linalg::Min(linalg::Max(value, zero + low), zero + high) - value, zero - high);
}

}  // namespace switchyard::cones
