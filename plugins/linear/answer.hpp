// linear/answer.hpp - fills a sy_result. A NULL buffer is not wanted.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "linear/duals.hpp"
#include "switchyard/abi.h"

namespace switchyard::linear {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The result of a solve that has found nothing yet.
inline void Clear(sy_result& result) {
  result.termination = SY_NOT_SOLVED;
  result.primal = result.dual = SY_NO_POINT;
  result.objective = kNaN;
  result.bound = -kInfinity;
  result.seconds = 0;
  result.iterations = result.nodes = 0;
  result.relaxed = kNaN;
  if (result.text != nullptr && result.text_size > 0) result.text[0] = '\0';
}

template <class T>
void Put(T* buffer, const std::vector<T>& values) {
  if (buffer != nullptr) std::copy(values.begin(), values.end(), buffer);
}

inline void Put(sy_result& result, const Duals& duals, sy_point_kind kind) {
  result.dual = kind;
  Put(result.x_dual, duals.x);
  Put(result.row_dual, duals.row);
}

inline void Say(sy_result& result, const std::string& text) {
  if (result.text == nullptr || result.text_size == 0) return;
  std::snprintf(result.text, result.text_size, "%s", text.c_str());
}

/// What is true of a problem without variables: the rows are 0 and fit, or they are a certificate.
inline void AnswerWithoutVariables(const sy_problem& p, double tolerance, sy_result& result) {
  Duals duals = {{}, std::vector<double>(static_cast<std::size_t>(p.num_rows), 0.0)};
  result.termination = SY_OPTIMAL;
  for (std::int32_t i = 0; i < p.num_rows; ++i) {
    const double lower = p.row_lower != nullptr ? p.row_lower[i] : -kInfinity;
    const double upper = p.row_upper != nullptr ? p.row_upper[i] : kInfinity;
    if (lower <= tolerance && upper >= -tolerance) continue;
    result.termination = SY_INFEASIBLE;
    duals.row[static_cast<std::size_t>(i)] = lower > 0 ? 1 : -1;
    break;
  }
  const bool feasible = result.termination == SY_OPTIMAL;
  Put(result, duals, feasible ? SY_FEASIBLE : SY_CERTIFICATE);
  if (result.row_basis != nullptr) std::fill_n(result.row_basis, p.num_rows, SY_BASIS_BASIC);
  Say(result, feasible ? "no variables" : "no variables, and a row that 0 does not satisfy");
  if (!feasible) return;
  result.primal = SY_FEASIBLE;
  result.objective = result.bound = p.offset;
}

/// The bounds or costs a problem leaves out, as the vectors they stand for.
inline std::vector<double> Given(const double* values, std::int32_t count, double absent) {
  return values != nullptr ? std::vector<double>(values, values + count)
                           : std::vector<double>(static_cast<std::size_t>(count), absent);
}

}  // namespace switchyard::linear
