// least_squares.hpp - least squares with unknowns of one sign: where multipliers and proofs come
// from.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace switchyard::nlopt {

/// Dense matrices here, and NLopt's, have at most this many entries.
inline constexpr double kMostEntries = 5e7;

/// Asked at every step of a long computation: give up now?
using Stop = std::function<bool()>;

struct LeastSquares {
  Eigen::VectorXd u;
  Eigen::VectorXd residual;  // f - E u
};

/// min |E u - f| over u with u_k >= 0 unless free[k]: the active set method of Lawson and Hanson
/// (Solving Least Squares Problems, 1974, chapter 23), which keeps the triangular factor of the
/// columns in use. A column that depends on those in use stays out. Nothing where it was stopped.
std::optional<LeastSquares> SolveLeastSquares(const Eigen::MatrixXd& E, const Eigen::VectorXd& f,
                                              const std::vector<std::uint8_t>& free,
                                              const Stop& stop);

/// Either the shortest x with G'x >= h, or weights u >= 0 with G u = 0 and h'u > 0, which say that
/// there is none.
struct Alternative {
  std::optional<Eigen::VectorXd> x;
  Eigen::VectorXd u;  // where x is not there
};

/// Decides between the two, after Lawson and Hanson's chapter 23.4: the residual r of
/// min |[G; h'] u - (0, 1)| over u >= 0 is 0, or x = -r_1..n / r_n+1. Nothing where it was stopped.
std::optional<Alternative> Decide(const Eigen::MatrixXd& G, const Eigen::VectorXd& h,
                                  const Stop& stop);

}  // namespace switchyard::nlopt
