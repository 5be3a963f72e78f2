// judge.hpp - what a point is worth: that NLopt says it has converged is not enough.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "functions.hpp"
#include "stationarity.hpp"

namespace switchyard::nlopt {

/// A point, measured.
struct Measured {
  bool known = false;
  std::vector<double> x;
  double objective = 0;
  double violation = 0;
  std::optional<Multipliers> multipliers;  // where the point is feasible, and has derivatives
};

class Judge {
 public:
  /// Borrows the functions. A violation up to `feasible` is none, as is a residual up to
  /// `optimal`, both relative.
  Judge(Functions& functions, double feasible, double optimal, Stop stop)
      : functions_(functions), feasible_(feasible), optimal_(optimal), stop_(std::move(stop)) {}

  [[nodiscard]] double feasible() const { return feasible_; }
  [[nodiscard]] bool IsFeasible(const Measured& m) const {
    return m.known && m.violation <= feasible_;
  }
  /// Does it meet the optimality conditions of first order?
  [[nodiscard]] bool IsStationary(const Measured& m) const;

  /// Takes x as the point where it is better: feasible rather than not, then stationary.
  void Keep(const std::vector<double>& x, Measured& point);
  /// A few steps of Newton's method, where they lead on from a point that is nearly stationary.
  void Refine(Measured& point);

 private:
  [[nodiscard]] bool IsBetter(const Measured& a, const Measured& b) const;

  Functions& functions_;
  const double feasible_;
  const double optimal_;
  const Stop stop_;
};

}  // namespace switchyard::nlopt
