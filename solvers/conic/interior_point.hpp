// solvers/conic/interior_point.hpp - the primal-dual method.
#pragma once

#include <functional>
#include <optional>

#include "solvers/conic/form.hpp"
#include "solvers/conic/iterate.hpp"
#include "solvers/conic/kkt.hpp"
#include "solvers/conic/product_cone.hpp"

namespace switchyard::conic {

struct InteriorPointOptions {
  double tolerance = 1e-8;  // on each relative residual and on the gap
  int iteration_limit = 200;
  double step_fraction = 0.99;  // of the way to the boundary
  int threads = 1;
  int recentering = 3;  // most corrections of what stands out, an iteration
};

enum class Ending {
  kOptimal,
  kInfeasible,  // y and z are a certificate
  kUnbounded,   // x is a ray
  kIterationLimit,
  kStopped,  // by `watch`
  kTrouble,  // no more progress
};

struct Solution {
  Ending ending = Ending::kTrouble;
  Iterate at;  // the best one
  Distance distance;
  int iterations = 0;
};

/// Told of every iteration; true: stop.
using Watch = std::function<bool(int iteration, const Iterate&, const Distance&)>;
/// Asked before an iterate is called optimal or a certificate; false: a better one is looked for.
using Judge = std::function<bool(Ending, const Iterate&)>;

/// A homogeneous embedding of the optimality conditions (Andersen and Ye, Math. Programming 84,
/// 1999, here with the quadratic objective as it stands),
///
///   P x + q tau - E'y - G'z = 0,   E x - e tau = 0,   G x - h tau - s = 0,
///   -q'x - x'Px / tau + e'y + h'z - kappa = 0,   s'z = 0,  tau kappa = 0,
///
/// followed to its end by a predictor and a corrector (Mehrotra, SIAM J. Optim. 2, 1992) and, where
/// these do not lead far, corrections of what stands in the way (Gondzio, Comput. Optim. Appl. 6,
/// 1996): tau > 0 at the end is an optimum, kappa > 0 a certificate that there is none.
class InteriorPoint {
 public:
  InteriorPoint(const Form& form, Kkt& kkt, const InteriorPointOptions& options, Watch watch,
                Judge judge = {});

  /// `from`: an iterate near which the solution may be, of a problem like this one; or nullptr.
  Solution Solve(const Iterate* from = nullptr);

 private:
  struct Direction {
    KktStep d;
    Vector ds;
    double tau = 0, kappa = 0;
  };

  void Start();
  void BlendIn(const Iterate& from);
  void Shift(Vector& v) const;
  [[nodiscard]] std::optional<Ending> Finished(int iteration);
  [[nodiscard]] std::optional<Ending> Arrived();
  void KeepBest(int iteration);
  Solution Conclude(Ending ending, int iteration);

  bool FindDirection();
  double TryDirection(double proximal, bool whole);
  void PrepareNext();
  [[nodiscard]] Kkt::Goal StepGoal() const;
  bool Predict();
  bool Correct();
  bool Recenter(double sigma, double& tau_kappa);
  bool Solve(Direction& direction, double share, double tau_kappa);
  void PrepareWhole();
  Kkt::Outcome SolveWhole(Direction& direction, double fourth);
  [[nodiscard]] double Fourth(const KktStep& d) const;
  [[nodiscard]] double Step(const Direction& direction, double most) const;
  [[nodiscard]] double LongStep();
  void Advance();

  const Form& form_;
  Kkt& kkt_;
  linalg::Workers workers_;
  ProductCone cones_;
  const InteriorPointOptions options_;
  const Watch watch_;
  const Judge judge_;

  Iterate at_;
  Residuals residuals_;
  double mu_ = 0;  // (s'z + tau kappa) / (degree + 1)

  Direction constant_;  // (x, y, z) of dtau = 1
  Direction predictor_, corrector_, recentered_;
  double curvature_ = 0;  // of the fourth equation, along the constant
  Vector xi_;             // ds = -(xi + H dz)
  double left_ = 0;  // of the equations, by the worst solve of this iteration: see Kkt::Outcome
  double constant_left_ = 0;  // by the constant's solve, for dtau = 1
  bool whole_ = false;        // all equations are solved together
  Triple constant_rest_;      // what then is left of the constant's
  KktStep more_;
  int corrections_ = 0;  // most that one needed
  double contraction_ = 0;
  Triple right_;
  Vector p_x_, h_z_, trial_s_, trial_z_;

  Iterate best_;
  Distance best_distance_;
  double best_worst_ = kInfinity;  // the product of both measures
  int best_iteration_ = -1;
  int rejected_ = 0;  // by the judge
};

}  // namespace switchyard::conic
