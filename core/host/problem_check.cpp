#include "core/host/problem_check.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "switchyard/cones.hpp"
#include "switchyard/error.hpp"

namespace switchyard {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

/// By the bits of their exponents: without branches, for there are many, and next to all are.
bool AreFinite(const double* v, std::int32_t count) {
  constexpr std::uint64_t kExponent = 0x7ff0000000000000U;
  std::uint64_t bad = 0;
  for (std::int32_t i = 0; i < count; ++i) {
    bad |=
        static_cast<std::uint64_t>((std::bit_cast<std::uint64_t>(v[i]) & kExponent) == kExponent);
  }
  return bad == 0;
}

/// Entries that are in their rows, ascending in each column, and finite; likewise.
bool AreGood(const sy_csc& m, std::int32_t rows, bool with_values) {
  const auto end = static_cast<std::uint32_t>(rows);
  int bad = 0;
  for (std::int32_t j = 0; j < m.cols; ++j) {
    std::int32_t before = -1;
    for (std::int32_t k = m.start[j]; k < m.start[j + 1]; ++k) {
      bad |= static_cast<int>(static_cast<std::uint32_t>(m.row[k]) >= end) |
             static_cast<int>(m.row[k] <= before);
      before = m.row[k];
    }
  }
  return bad == 0 && (!with_values || AreFinite(m.value, m.start[m.cols]));
}

// The pattern alone, where `with_values` is false.
void CheckMatrix(const char* name, const sy_csc& m, std::int32_t rows, std::int32_t cols,
                 bool with_values = true) {
  Require(m.rows == rows && m.cols == cols, name, " needs ", rows, " x ", cols, ", got ", m.rows,
          " x ", m.cols);
  Require(m.start != nullptr && m.start[0] == 0, name, ": column starts must begin at 0");
  Require(m.start[m.cols] == 0 || (m.row != nullptr && (m.value != nullptr || !with_values)), name,
          " needs rows and values of its entries");
  for (std::int32_t j = 0; j < m.cols; ++j) {
    Require(m.start[j] <= m.start[j + 1], name, ": the starts of column ", j, " do not ascend");
  }
  if (AreGood(m, rows, with_values)) return;
  for (std::int32_t j = 0; j < m.cols; ++j) {
    for (std::int32_t k = m.start[j]; k < m.start[j + 1]; ++k) {
      Require(m.row[k] >= 0 && m.row[k] < rows, name, ": an entry of column ", j, " is in row ",
              m.row[k], " of ", rows);
      Require(k == m.start[j] || m.row[k - 1] < m.row[k], name, ": the rows of column ", j,
              " do not ascend");
      Require(!with_values || std::isfinite(m.value[k]), name, ": the coefficient of x[", j,
              "] in row ", m.row[k], " is ", with_values ? m.value[k] : 0);
    }
  }
}

void CheckVector(const char* name, const double* v, std::int32_t count) {
  if (v == nullptr || AreFinite(v, count)) return;
  for (std::int32_t i = 0; i < count; ++i) {
    Require(std::isfinite(v[i]), name, "[", i, "] must be a finite number, got ", v[i]);
  }
}

/// `index`: of which each pair is; NULL: of the first, the second, ...
void CheckBounds(const char* what, const double* lower, const double* upper, std::int32_t count,
                 const std::int32_t* index = nullptr) {
  for (std::int32_t k = 0; k < count; ++k) {
    const std::int32_t i = index != nullptr ? index[k] : k;
    const double l = lower != nullptr ? lower[k] : -kInf;
    const double u = upper != nullptr ? upper[k] : kInf;
    Require(!std::isnan(l) && !std::isnan(u), what, "[", i, "] has the bounds ", l, " and ", u,
            ", which must be numbers");
    Require(l <= u, what, "[", i, "] has lower bound ", l, " above its upper bound ", u);
    Require(l < kInf && u > -kInf, what, "[", i, "] has the bounds ", l, " and ", u,
            ", which no number satisfies");
  }
}

void CheckCones(const sy_problem& problem) {
  Require(problem.num_cones == 0 || problem.cones != nullptr, "the problem has ", problem.num_cones,
          " cones, but no list of them");
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

void CheckUpperTriangle(const char* name, const sy_csc& P) {
  for (std::int32_t j = 0; j < P.cols; ++j) {
    const std::int32_t end = P.start[j + 1];
    if (end == P.start[j]) continue;
    Require(P.row[end - 1] <= j, name, " is given by its upper triangle, but has an entry in row ",
            P.row[end - 1], " of column ", j);
  }
}

void CheckFunctions(const sy_nlp& nlp, std::int32_t vars) {
  const std::int32_t rows = nlp.num_constraints;
  Require(rows >= 0, "the functions have ", rows, " constraints");
  Require(nlp.evaluate != nullptr, "the problem has functions, but no way to evaluate them");
  Require(rows == 0 || (nlp.lower != nullptr && nlp.upper != nullptr),
          "the functions' constraints need bounds");
  CheckBounds("c", nlp.lower, nlp.upper, rows);
  if ((nlp.provides & SY_JACOBIAN) != 0) {
    CheckMatrix("the Jacobian", nlp.jacobian, rows, vars, false);
  }
  if ((nlp.provides & SY_HESSIAN) == 0) return;
  CheckMatrix("the Hessian", nlp.hessian, vars, vars, false);
  CheckUpperTriangle("the Hessian", nlp.hessian);
}

}  // namespace

void CheckSingleBounds(const sy_update& update) {
  CheckBounds("x", update.x_lower, update.x_upper, update.num_x, update.x);
  CheckBounds("row", update.row_lower, update.row_upper, update.num_rows, update.row);
}

void CheckVectors(const sy_problem& problem) {
  CheckVector("q", problem.q, problem.num_vars);
  CheckVector("g", problem.g, problem.num_cone_rows);
  Require(std::isfinite(problem.offset), "the offset must be a finite number, got ",
          problem.offset);
  CheckBounds("x", problem.x_lower, problem.x_upper, problem.num_vars);
  CheckBounds("row", problem.row_lower, problem.row_upper, problem.num_rows);
}

void CheckProblem(const sy_problem& problem) {
  Require(problem.num_vars >= 0 && problem.num_rows >= 0 && problem.num_cones >= 0 &&
              problem.num_cone_rows >= 0,
          "a problem's counts cannot be negative");
  if (problem.P != nullptr) {
    CheckMatrix("P", *problem.P, problem.num_vars, problem.num_vars);
    CheckUpperTriangle("P", *problem.P);
  }
  if (problem.nlp != nullptr) CheckFunctions(*problem.nlp, problem.num_vars);
  if (problem.num_rows > 0) {
    Require(problem.A != nullptr, "the problem has rows, but no matrix A");
    CheckMatrix("A", *problem.A, problem.num_rows, problem.num_vars);
  }
  if (problem.num_cone_rows > 0) {
    Require(problem.F != nullptr, "the problem has cone rows, but no matrix F");
    CheckMatrix("F", *problem.F, problem.num_cone_rows, problem.num_vars);
  }
  CheckVectors(problem);
  CheckCones(problem);
}

}  // namespace switchyard
