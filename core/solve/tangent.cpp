#include "core/solve/tangent.hpp"

#include <numeric>
#include <utility>

namespace switchyard {

std::optional<Problem> TangentProblem(const sy_problem& problem, const std::vector<double>& x) {
  const sy_nlp& nlp = *problem.nlp;
  constexpr std::uint32_t kNeeded = SY_GRADIENT | SY_JACOBIAN;
  if ((nlp.provides & kNeeded) != kNeeded) return std::nullopt;
  double value = 0;
  std::vector<double> gradient(x.size());
  std::vector<double> constraints(static_cast<std::size_t>(nlp.num_constraints));
  Csc J(nlp.jacobian);
  J.value.resize(J.row.size());
  sy_evaluation e{};
  e.size = sizeof e;
  e.want = SY_OBJECTIVE | SY_GRADIENT | SY_CONSTRAINTS | SY_JACOBIAN;
  e.x = x.data();
  e.objective = &value;
  e.gradient = gradient.data();
  e.constraints = constraints.data();
  e.jacobian = J.value.data();
  if (nlp.evaluate(nlp.context, &e) != SY_EVALUATED) return std::nullopt;
  ProblemData d(problem);
  d.nlp = nullptr;
  d.hints = nullptr;
  for (std::size_t j = 0; j < x.size(); ++j) d.q[j] += gradient[j];
  d.offset += value - std::inner_product(x.begin(), x.end(), gradient.begin(), 0.0);
  std::vector<double> linear(constraints.size(), 0.0);
  MultiplyAdd(J.View(), 1, x.data(), linear.data());
  d.A = StackRows(d.A, J);
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    d.row_lower.push_back(nlp.lower[i] - constraints[i] + linear[i]);
    d.row_upper.push_back(nlp.upper[i] - constraints[i] + linear[i]);
  }
  return Problem(std::move(d));
}

void DualsOfTangentProblem(Vectors& v) {
  v.row_dual.insert(v.row_dual.end(), v.nlp_dual.begin(), v.nlp_dual.end());
  v.nlp_dual.clear();
}

}  // namespace switchyard
