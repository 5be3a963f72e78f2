#include "answer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "switchyard/problem.hpp"

namespace switchyard::ipopt {
namespace {

// An objective this low is more likely one without a bound.
constexpr double kAway = 1e15;

/// A x, and of each row the largest term.
struct Rows {
  std::vector<double> value, largest;
};

Rows RowsAt(const sy_problem& p, const std::vector<double>& x) {
  Rows rows;
  rows.value.resize(static_cast<std::size_t>(p.num_rows), 0.0);
  rows.largest = rows.value;
  for (std::int32_t j = 0; p.A != nullptr && j < p.num_vars; ++j) {
    for (std::int32_t k = p.A->start[j]; k < p.A->start[j + 1]; ++k) {
      const auto i = static_cast<std::size_t>(p.A->row[k]);
      const double term = p.A->value[k] * x[static_cast<std::size_t>(j)];
      rows.value[i] += term;
      rows.largest[i] = std::max(rows.largest[i], std::abs(term));
    }
  }
  return rows;
}

double Outside(double value, double lower, double upper) {
  return std::max({0.0, lower - value, value - upper});
}

/// |d| min(1, distance to the side it stands against).
double Slackness(double d, double value, double lower, double upper) {
  const double distance = d > 0 ? value - lower : upper - value;
  return std::abs(d) * std::min(1.0, std::abs(distance));
}

double LargestSlackness(const std::vector<double>& dual, const double* value, const double* lower,
                        const double* upper) {
  double largest = 0;
  for (std::size_t k = 0; k < dual.size(); ++k) {
    largest = std::max(largest, Slackness(dual[k], value[k], lower[k], upper[k]));
  }
  return largest;
}

/// Px + q + grad f(x)
std::optional<std::vector<double>> GradientAt(const sy_problem& p, Functions& functions,
                                              const std::vector<double>& x) {
  std::vector<double> gradient(p.q, p.q + p.num_vars);
  if (p.P != nullptr) SymmetricMultiplyAdd(*p.P, 1, x.data(), gradient.data());
  if (!functions.AddGradient(x.data(), gradient.data())) return std::nullopt;
  return gradient;
}

/// What stationarity leaves, x_dual, against the bounds.
double LargestRest(const sy_problem& p, const Point& point, const std::vector<double>& gradient) {
  double largest = 0;
  for (std::size_t j = 0; j < gradient.size(); ++j) {
    const double rest = Slackness(point.x_dual[j], point.x[j], p.x_lower[j], p.x_upper[j]);
    largest = std::max(largest, rest / (1 + std::abs(gradient[j])));
  }
  return largest;
}

/// What c adds to violation, stationarity and slackness. False where it is not defined.
bool MeasureConstraints(const sy_problem& p, Functions& functions, Measured& at) {
  if (!HasConstraints(p)) return true;
  const sy_nlp& nlp = *p.nlp;
  const double* x = at.point.x.data();
  const double* c = functions.Constraints(x);
  const double* jacobian = c != nullptr ? functions.Jacobian(x) : nullptr;
  if (jacobian == nullptr) return false;
  for (std::int32_t i = 0; i < nlp.num_constraints; ++i) {
    const double outside = Outside(c[i], nlp.lower[i], nlp.upper[i]);
    at.violation = std::max(at.violation, outside / (1 + std::abs(c[i])));
  }
  sy_csc with_values = nlp.jacobian;
  with_values.value = jacobian;
  TransposedMultiplyAdd(with_values, -1, at.point.nlp_dual.data(), at.point.x_dual.data());
  at.optimality =
      LargestSlackness(at.point.nlp_dual, c, nlp.lower, nlp.upper) / (1 + std::abs(at.objective));
  return true;
}

const char* Name(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
      return "Solve_Succeeded";
    case Ipopt::Solved_To_Acceptable_Level:
      return "Solved_To_Acceptable_Level";
    case Ipopt::Infeasible_Problem_Detected:
      return "Infeasible_Problem_Detected";
    case Ipopt::Search_Direction_Becomes_Too_Small:
      return "Search_Direction_Becomes_Too_Small";
    case Ipopt::Diverging_Iterates:
      return "Diverging_Iterates";
    case Ipopt::User_Requested_Stop:
      return "User_Requested_Stop";
    case Ipopt::Feasible_Point_Found:
      return "Feasible_Point_Found";
    case Ipopt::Maximum_Iterations_Exceeded:
      return "Maximum_Iterations_Exceeded";
    case Ipopt::Restoration_Failed:
      return "Restoration_Failed";
    case Ipopt::Error_In_Step_Computation:
      return "Error_In_Step_Computation";
    case Ipopt::Maximum_CpuTime_Exceeded:
      return "Maximum_CpuTime_Exceeded";
    case Ipopt::Not_Enough_Degrees_Of_Freedom:
      return "Not_Enough_Degrees_Of_Freedom";
    case Ipopt::Invalid_Number_Detected:
      return "Invalid_Number_Detected";
    case Ipopt::Insufficient_Memory:
      return "Insufficient_Memory";
    default:
      return "another status";
  }
}

}  // namespace

std::optional<Measured> Measure(const sy_problem& p, Functions& functions, Point point) {
  Measured at;
  at.point = std::move(point);
  const std::vector<double>& x = at.point.x;
  at.objective = Objective(p, x.data());
  if (!functions.AddObjective(x.data(), at.objective)) return std::nullopt;
  const auto gradient = GradientAt(p, functions, x);
  if (!gradient) return std::nullopt;
  at.point.x_dual = *gradient;
  if (p.A != nullptr) {
    TransposedMultiplyAdd(*p.A, -1, at.point.row_dual.data(), at.point.x_dual.data());
  }
  if (!MeasureConstraints(p, functions, at)) return std::nullopt;
  const Rows rows = RowsAt(p, x);
  for (std::size_t i = 0; i < rows.value.size(); ++i) {
    const double outside = Outside(rows.value[i], p.row_lower[i], p.row_upper[i]);
    at.violation = std::max(at.violation, outside / (1 + rows.largest[i]));
  }
  const double of_rows =
      LargestSlackness(at.point.row_dual, rows.value.data(), p.row_lower, p.row_upper);
  at.optimality = std::max(
      {at.optimality, of_rows / (1 + std::abs(at.objective)), LargestRest(p, at.point, *gradient)});
  return at;
}

std::string Words(const Found& found, const std::optional<Measured>& at,
                  const Functions& functions) {
  if (functions.ended()) return "a function ended the solve";
  const std::string name = Name(found.status);
  if (found.status == Ipopt::Invalid_Number_Detected && functions.met_undefined()) {
    return name + (found.began ? ": the functions are not defined at a point on the way"
                               : ": the functions are not defined at the start; give another one");
  }
  if (found.status == Ipopt::Solve_Succeeded && !at) {
    return name + ": the functions are not defined at the last point";
  }
  const bool failed = found.status != Ipopt::Solve_Succeeded;
  if (found.status == Ipopt::Diverging_Iterates || (failed && at && at->objective < -kAway)) {
    return name + ": the points run away; the problem is perhaps unbounded";
  }
  return name;
}

}  // namespace switchyard::ipopt
