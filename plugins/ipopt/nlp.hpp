// nlp.hpp - a program as Ipopt asks for it.
#pragma once

#include <cstdint>
#include <vector>

#include "IpIpoptApplication.hpp"
#include "IpTNLP.hpp"
#include "functions.hpp"
#include "linear/watch.hpp"
#include "shape.hpp"
#include "switchyard/abi.h"

namespace switchyard::ipopt {

/// A point and its duals in the signs of switchyard/abi.h. Empty, or NaN, where unknown.
struct Point {
  std::vector<double> x, x_dual, row_dual, nlp_dual;

  [[nodiscard]] bool Complete(const sy_problem& problem) const;
};

/// What a run ended with; the point's x_dual stays empty.
struct Found {
  Ipopt::ApplicationReturnStatus status = Ipopt::Internal_Error;
  bool began = false;  // the functions were defined where it started
  bool has_point = false;
  Point point;
  std::int64_t iterations = 0;
};

/// How a program is given to Ipopt.
struct Setting {
  std::int64_t before = 0;  // iterations of earlier runs
  double widening = 0;      // of all sides by Ipopt, relative
};

/// The linear rows and the quadratic objective are data and never asked of the functions. With row
/// duals y, Ipopt's multipliers are -y.
class Program : public Ipopt::TNLP {
 public:
  using Index = Ipopt::Index;
  using Number = Ipopt::Number;

  /// Borrows all but the setting; the problem has all its bounds and q, and `shape` is its own.
  Program(const sy_problem& problem, const Shape& shape, Functions& functions, const Point& start,
          linear::Watch& watch, const Setting& setting);

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian,
                    IndexStyleEnum& style) override;
  bool get_bounds_info(Index n, Number* x_l, Number* x_u, Index m, Number* g_l,
                       Number* g_u) override;
  bool get_starting_point(Index n, bool init_x, Number* x, bool init_z, Number* z_L, Number* z_U,
                          Index m, bool init_lambda, Number* lambda) override;
  bool eval_f(Index n, const Number* x, bool new_x, Number& value) override;
  bool eval_grad_f(Index n, const Number* x, bool new_x, Number* gradient) override;
  bool eval_g(Index n, const Number* x, bool new_x, Index m, Number* g) override;
  bool eval_jac_g(Index n, const Number* x, bool new_x, Index m, Index entries, Index* row,
                  Index* col, Number* values) override;
  bool eval_h(Index n, const Number* x, bool new_x, Number factor, Index m, const Number* lambda,
              bool new_lambda, Index entries, Index* row, Index* col, Number* values) override;
  bool intermediate_callback(Ipopt::AlgorithmMode mode, Index iteration, Number objective,
                             Number primal, Number dual, Number mu, Number step,
                             Number regularization, Number alpha_dual, Number alpha_primal,
                             Index trials, const Ipopt::IpoptData* data,
                             Ipopt::IpoptCalculatedQuantities* quantities) override;
  void finalize_solution(Ipopt::SolverReturn status, Index n, const Number* x, const Number* z_L,
                         const Number* z_U, Index m, const Number* g, const Number* lambda,
                         Number value, const Ipopt::IpoptData* data,
                         Ipopt::IpoptCalculatedQuantities* quantities) override;

  [[nodiscard]] const Found& found() const { return found_; }

 private:
  /// Calls visit(k, lower, upper, i, is_row) for each of Ipopt's constraints k: the sides of row i,
  /// or of c_i.
  template <class Visit>
  void ForEachConstraint(Visit&& visit) const;

  const sy_problem& p_;
  const Shape& shape_;
  Functions& functions_;
  const Point& start_;
  linear::Watch& watch_;
  const Setting setting_;
  std::vector<Number> activity_;     // of all rows
  std::vector<Number> multipliers_;  // of all of c
  Found found_;
};

}  // namespace switchyard::ipopt
