#include "shape.hpp"

#include <cmath>

namespace switchyard::ipopt {
namespace {

bool IsFixed(const sy_problem& p, std::int32_t j) { return p.x_lower[j] == p.x_upper[j]; }

bool IsBounded(double lower, double upper) { return std::isfinite(lower) || std::isfinite(upper); }

std::vector<std::int32_t> RowsThatSpeak(const sy_problem& p) {
  std::vector<std::uint8_t> speaks(static_cast<std::size_t>(p.num_rows), 0);
  for (std::int32_t j = 0; p.A != nullptr && j < p.num_vars; ++j) {
    if (IsFixed(p, j)) continue;
    for (std::int32_t k = p.A->start[j]; k < p.A->start[j + 1]; ++k) {
      if (p.A->value[k] != 0) speaks[static_cast<std::size_t>(p.A->row[k])] = 1;
    }
  }
  std::vector<std::int32_t> rows;
  for (std::int32_t i = 0; i < p.num_rows; ++i) {
    const bool bounded = IsBounded(p.row_lower[i], p.row_upper[i]);
    if (bounded && speaks[static_cast<std::size_t>(i)] != 0) rows.push_back(i);
  }
  return rows;
}

std::vector<std::int32_t> ConstraintsThatBind(const sy_problem& p) {
  std::vector<std::int32_t> kept;
  for (std::int32_t i = 0; HasConstraints(p) && i < p.nlp->num_constraints; ++i) {
    if (IsBounded(p.nlp->lower[i], p.nlp->upper[i])) kept.push_back(i);
  }
  return kept;
}

/// The place of each of `count` rows among those `kept`, from `first` on; -1: not there.
std::vector<std::int32_t> PlacesOf(const std::vector<std::int32_t>& kept, std::int32_t count,
                                   std::int32_t first) {
  std::vector<std::int32_t> place(static_cast<std::size_t>(count), -1);
  for (const std::int32_t i : kept) place[static_cast<std::size_t>(i)] = first++;
  return place;
}

/// The upper triangle `m` by columns, as the lower one that Ipopt wants.
void PlaceTriangle(const sy_csc& m, Places& to) {
  for (std::int32_t j = 0; j < m.cols; ++j) {
    for (std::int32_t k = m.start[j]; k < m.start[j + 1]; ++k) to.Add(j, m.row[k]);
  }
}

}  // namespace

bool HasObjective(const sy_problem& problem) {
  return problem.nlp != nullptr && (problem.nlp->provides & SY_OBJECTIVE) != 0;
}

bool HasConstraints(const sy_problem& problem) {
  return problem.nlp != nullptr && problem.nlp->num_constraints > 0;
}

bool HasFunctions(const sy_problem& problem) {
  return HasObjective(problem) || HasConstraints(problem);
}

Shape::Shape(const sy_problem& problem, bool uses_hessian)
    : rows(RowsThatSpeak(problem)), constraints(ConstraintsThatBind(problem)) {
  PlaceRows(problem);
  PlaceConstraints(problem);
  if (uses_hessian && problem.P != nullptr) PlaceTriangle(*problem.P, hessian);
  if (uses_hessian && HasFunctions(problem)) PlaceTriangle(problem.nlp->hessian, hessian);
  for (std::int32_t j = 0; j < problem.num_vars; ++j) unfixed += IsFixed(problem, j) ? 0 : 1;
}

void Shape::PlaceRows(const sy_problem& p) {
  const auto place = PlacesOf(rows, p.num_rows, 0);
  for (const std::int32_t i : rows) Count(p.row_lower[i], p.row_upper[i]);
  for (std::int32_t j = 0; !rows.empty() && j < p.num_vars; ++j) {
    for (std::int32_t k = p.A->start[j]; k < p.A->start[j + 1]; ++k) {
      const std::int32_t to = place[static_cast<std::size_t>(p.A->row[k])];
      if (to < 0) continue;
      jacobian.Add(to, j);
      row_values.push_back(p.A->value[k]);
    }
  }
}

void Shape::PlaceConstraints(const sy_problem& p) {
  if (constraints.empty()) return;
  const sy_nlp& nlp = *p.nlp;
  const auto place =
      PlacesOf(constraints, nlp.num_constraints, static_cast<std::int32_t>(rows.size()));
  for (const std::int32_t i : constraints) Count(nlp.lower[i], nlp.upper[i]);
  for (std::int32_t j = 0; j < p.num_vars; ++j) {
    for (std::int32_t k = nlp.jacobian.start[j]; k < nlp.jacobian.start[j + 1]; ++k) {
      const std::int32_t to = place[static_cast<std::size_t>(nlp.jacobian.row[k])];
      if (to < 0) continue;
      jacobian.Add(to, j);
      entries.push_back(k);
    }
  }
}

}  // namespace switchyard::ipopt
