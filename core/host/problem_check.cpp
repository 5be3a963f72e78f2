#include "core/host/problem_check.hpp"

#include <cmath>
#include <limits>

#include "switchyard/cones.hpp"
#include "switchyard/error.hpp"

namespace switchyard {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

void CheckMatrix(const char* name, const sy_csc& m, std::int32_t rows, std::int32_t cols) {
  Require(m.rows == rows && m.cols == cols, name, " needs ", rows, " x ", cols, ", got ", m.rows,
          " x ", m.cols);
  Require(m.start != nullptr && m.start[0] == 0, name, ": column starts must begin at 0");
  for (std::int32_t j = 0; j < m.cols; ++j) {
    Require(m.start[j] <= m.start[j + 1], name, ": the starts of column ", j, " do not ascend");
    for (std::int32_t k = m.start[j]; k < m.start[j + 1]; ++k) {
      Require(m.row[k] >= 0 && m.row[k] < rows, name, ": an entry of column ", j, " is in row ",
              m.row[k], " of ", rows);
      Require(k == m.start[j] || m.row[k - 1] < m.row[k], name, ": the rows of column ", j,
              " do not ascend");
      Require(std::isfinite(m.value[k]), name, ": the coefficient of x[", j, "] in row ", m.row[k],
              " is ", m.value[k]);
    }
  }
}

void CheckVector(const char* name, const double* v, std::int32_t count) {
  for (std::int32_t i = 0; v != nullptr && i < count; ++i) {
    Require(std::isfinite(v[i]), name, "[", i, "] must be a finite number, got ", v[i]);
  }
}

void CheckBounds(const char* what, const double* lower, const double* upper, std::int32_t count) {
  for (std::int32_t i = 0; i < count; ++i) {
    const double l = lower != nullptr ? lower[i] : -kInf;
    const double u = upper != nullptr ? upper[i] : kInf;
    Require(l <= u, what, "[", i, "] has lower bound ", l, " above its upper bound ", u);
    Require(l < kInf && u > -kInf, what, "[", i, "] has the bounds ", l, " and ", u,
            ", which no number satisfies");
  }
}

void CheckCones(const sy_problem& problem) {
  std::int64_t rows = 0;
  for (std::int32_t c = 0; c < problem.num_cones; ++c) {
    const sy_cone& cone = problem.cones[c];
    const char* need = FactsOf(cone.kind).need(cone.dim, cone.parameter);
    Require(need == nullptr, "cone[", c, "] (", FactsOf(cone.kind).name, ") needs ",
            need != nullptr ? need : "", ", got dimension ", cone.dim, " and parameter ",
            cone.parameter);
    rows += cone.dim;
  }
  Require(rows == problem.num_cone_rows, "the cones take ", rows, " rows, the problem has ",
          problem.num_cone_rows);
}

}  // namespace

void CheckProblem(const sy_problem& problem) {
  Require(problem.num_vars >= 0 && problem.num_rows >= 0 && problem.num_cones >= 0 &&
              problem.num_cone_rows >= 0,
          "a problem's counts cannot be negative");
  if (problem.P != nullptr) CheckMatrix("P", *problem.P, problem.num_vars, problem.num_vars);
  if (problem.num_rows > 0) {
    Require(problem.A != nullptr, "the problem has rows, but no matrix A");
    CheckMatrix("A", *problem.A, problem.num_rows, problem.num_vars);
  }
  if (problem.num_cone_rows > 0) {
    Require(problem.F != nullptr, "the problem has cone rows, but no matrix F");
    CheckMatrix("F", *problem.F, problem.num_cone_rows, problem.num_vars);
  }
  CheckVector("q", problem.q, problem.num_vars);
  CheckVector("g", problem.g, problem.num_cone_rows);
  Require(std::isfinite(problem.offset), "the offset must be a finite number, got ",
          problem.offset);
  CheckBounds("x", problem.x_lower, problem.x_upper, problem.num_vars);
  CheckBounds("row", problem.row_lower, problem.row_upper, problem.num_rows);
  CheckCones(problem);
}

}  // namespace switchyard
