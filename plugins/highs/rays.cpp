// Certificates that HiGHS does not leave behind itself: those of quadratic programs, and those that
// presolve proved without a ray. Each is a linear program, solved by a HiGHS of its own.
#include <algorithm>
#include <cmath>
#include <utility>

#include "highs.hpp"

namespace switchyard::highs {
namespace {

// Solves `lp` by the simplex method without presolve, so that a ray is left; false where HiGHS or
// the watch stopped it first.
bool Solves(Highs& solver, HighsLp lp, const HighsOptions& options, const sy_host& host,
            linear::Watch& watch) {
  HighsOptions plain = options;
  plain.presolve = kHighsOffString;
  plain.solver = kSimplexString;
  plain.objective_bound = kHighsInf;
  plain.output_flag = false;
  plain.time_limit = watch.Left();
  solver.passOptions(plain);
  if (solver.passModel(std::move(lp)) == HighsStatus::kError) return false;
  Attach(solver, watch, host);
  const bool ran = solver.run() != HighsStatus::kError;
  solver.setCallback(HighsCallbackFunctionType());
  return ran;
}

// 0 where a side is finite: the side of the cone of directions in which the box recedes.
void Recede(std::vector<double>& lower, std::vector<double>& upper, double most) {
  for (double& l : lower) l = std::isinf(l) ? -most : 0;
  for (double& u : upper) u = std::isinf(u) ? most : 0;
}

// Appends the rows Pd = 0, P given by its upper triangle: by rows it is that triangle's row and,
// where it is off the diagonal, its column.
void AppendRows(const Csc& upper, HighsLp& lp) {
  const Csc lower = Transpose(upper.View());
  std::vector<HighsInt> start = {0};
  std::vector<HighsInt> index;
  std::vector<double> value;
  const auto take = [&](const Csc& half, std::size_t i, bool diagonal) {
    for (auto k = static_cast<std::size_t>(half.start[i]);
         k < static_cast<std::size_t>(half.start[i + 1]); ++k) {
      if (!diagonal && half.row[k] == static_cast<std::int32_t>(i)) continue;
      index.push_back(half.row[k]);
      value.push_back(half.value[k]);
    }
  };
  for (std::size_t i = 0; i < static_cast<std::size_t>(upper.cols); ++i) {
    take(upper, i, true);
    take(lower, i, false);
    start.push_back(static_cast<HighsInt>(index.size()));
  }
  HighsSparseMatrix rows;
  rows.format_ = MatrixFormat::kRowwise;
  rows.num_row_ = rows.num_col_ = lp.num_col_;
  rows.start_ = std::move(start);
  rows.index_ = std::move(index);
  rows.value_ = std::move(value);
  lp.a_matrix_.ensureRowwise();
  lp.a_matrix_.addRows(rows);
  lp.num_row_ += lp.num_col_;
  lp.row_lower_.resize(static_cast<std::size_t>(lp.num_row_), 0);
  lp.row_upper_.resize(static_cast<std::size_t>(lp.num_row_), 0);
}

}  // namespace

std::optional<linear::Duals> FindFarkas(const HighsModel& model, const HighsOptions& options,
                                        const sy_host& host, linear::Watch& watch) {
  HighsLp lp = model.lp_;
  std::fill(lp.col_cost_.begin(), lp.col_cost_.end(), 0);
  Highs solver;
  if (!Solves(solver, std::move(lp), options, host, watch)) return std::nullopt;
  std::vector<double> ray(static_cast<std::size_t>(model.lp_.num_row_));
  bool has_ray = false;
  solver.getDualRay(has_ray, ray.data());
  if (!has_ray) return std::nullopt;
  return linear::Farkas(ModelView(model).problem, ray);
}

std::optional<std::vector<double>> FindRay(const HighsModel& model, const HighsOptions& options,
                                           const sy_host& host, linear::Watch& watch) {
  // min q'd such that d recedes, Pd = 0, -1 <= d <= 1
  HighsLp lp = model.lp_;
  lp.integrality_.clear();
  Recede(lp.col_lower_, lp.col_upper_, 1);
  Recede(lp.row_lower_, lp.row_upper_, kHighsInf);
  const ModelView view(model);
  if (view.problem.P != nullptr) AppendRows(view.P, lp);
  Highs solver;
  if (!Solves(solver, std::move(lp), options, host, watch)) return std::nullopt;
  if (solver.getModelStatus() != HighsModelStatus::kOptimal) return std::nullopt;
  if (solver.getInfo().objective_function_value - model.lp_.offset_ >= 0) return std::nullopt;
  return linear::FallingRay(view.problem, solver.getSolution().col_value);
}

}  // namespace switchyard::highs
