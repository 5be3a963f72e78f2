// nlp.hpp - one run of Ipopt on a linear or quadratic program.
#pragma once

#include <cstdint>
#include <vector>

#include "IpIpoptApplication.hpp"
#include "IpTNLP.hpp"
#include "linear/watch.hpp"
#include "options.hpp"
#include "switchyard/abi.h"

namespace switchyard::ipopt {

/// A point and its duals in the signs of switchyard/abi.h. Empty, or NaN, where unknown.
struct Point {
  std::vector<double> x, x_dual, row_dual;

  [[nodiscard]] bool Complete(std::int32_t num_vars, std::int32_t num_rows) const;
};

/// What a run ended with; the point's x_dual stays empty.
struct Found {
  Ipopt::ApplicationReturnStatus status = Ipopt::Internal_Error;
  bool has_point = false;
  Point point;
  std::int64_t iterations = 0;
};

/// The program as Ipopt asks for it. Rows that say nothing of the variables stay behind: those
/// without a finite side, and those whose variables are all fixed. With row duals y, Ipopt's
/// multipliers are -y.
class Program : public Ipopt::TNLP {
 public:
  using Index = Ipopt::Index;
  using Number = Ipopt::Number;

  /// Borrows all three; the problem has all its bounds and q. Iterations count from `before`.
  Program(const sy_problem& problem, const Point& start, linear::Watch& watch, std::int64_t before);

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
  const sy_problem& p_;
  const Point& start_;
  linear::Watch& watch_;
  const std::int64_t before_;
  std::vector<std::int32_t> kept_;   // the rows that Ipopt sees
  std::vector<std::int32_t> place_;  // of each row among them; -1: not there
  std::vector<Index> entry_row_, entry_col_;
  std::vector<Number> entry_value_;
  std::vector<Number> activity_;  // of all rows
  bool loosens_equations_ = false;
  Found found_;
};

/// Runs Ipopt from `start`: a convex program without a line search first, which is fast and mostly
/// succeeds, and again with one where that led nowhere. Throws Failure where Ipopt broke down.
Found Run(const sy_problem& problem, const Point& start, const Options& options,
          const sy_host& host, linear::Watch& watch, std::int64_t before = 0);

}  // namespace switchyard::ipopt
