// How a problem gets into CLP, whole or by its differences; a basis that is there stays.
#include <algorithm>

#include "ClpPackedMatrix.hpp"
#include "clp.hpp"
#include "linear/answer.hpp"

namespace switchyard::clp {

using linear::Given;

void Solver::Load(const sy_problem& problem, std::uint64_t updates) {
  const std::int32_t n = problem.num_vars;
  const std::int32_t m = problem.num_rows;
  const Csc none(m, n);
  const sy_csc a = problem.A != nullptr ? *problem.A : none.View();
  model_.loadProblem(n, m, a.start, a.row, a.value, Given(problem.x_lower, n, -kInfinity).data(),
                     Given(problem.x_upper, n, kInfinity).data(), Given(problem.q, n, 0).data(),
                     Given(problem.row_lower, m, -kInfinity).data(),
                     Given(problem.row_upper, m, kInfinity).data());
  model_.setOptimizationDirection(1);
  model_.setObjectiveOffset(-problem.offset);
  start_ = {};
  start_is_new_ = solved_ = false;
  may_presolve_ = updates == 0;
}

void Solver::Update(const sy_update& update) {
  if (update.whole != 0) TakeWhole(*update.problem, update.whole);
  for (std::int32_t k = 0; k < update.num_x; ++k) {
    model_.setColumnBounds(update.x[k], update.x_lower[k], update.x_upper[k]);
  }
  for (std::int32_t k = 0; k < update.num_rows; ++k) {
    model_.setRowBounds(update.row[k], update.row_lower[k], update.row_upper[k]);
  }
  if (update.num_gone_rows > 0) model_.deleteRows(update.num_gone_rows, update.gone_row);
  if (update.more != nullptr) Append(*update.more);
  start_.Follow(update);
}

void Solver::TakeWhole(const sy_problem& problem, std::uint32_t kinds) {
  const std::int32_t n = problem.num_vars;
  const std::int32_t m = problem.num_rows;
  if ((kinds & SY_UPDATES_BOUNDS) != 0) {
    model_.chgColumnLower(Given(problem.x_lower, n, -kInfinity).data());
    model_.chgColumnUpper(Given(problem.x_upper, n, kInfinity).data());
    model_.chgRowLower(Given(problem.row_lower, m, -kInfinity).data());
    model_.chgRowUpper(Given(problem.row_upper, m, kInfinity).data());
  }
  if ((kinds & SY_UPDATES_VECTORS) != 0) {
    model_.chgObjCoefficients(Given(problem.q, n, 0).data());
    model_.setObjectiveOffset(-problem.offset);
  }
  if ((kinds & SY_UPDATES_VALUES) != 0 && problem.A != nullptr) TakeValues(*problem.A);
}

void Solver::TakeValues(const sy_csc& a) {
  constexpr bool kDeleteTheOld = true;
  model_.replaceMatrix(
      new ClpPackedMatrix(new CoinPackedMatrix(true, a.rows, a.cols, a.start[a.cols], a.value,
                                               a.row, a.start, nullptr)),
      kDeleteTheOld);
  // Every copy and every scale of the old values goes.
  model_.setWhatsChanged(0);
}

void Solver::Append(const sy_more& more) {
  const std::int32_t n = model_.numberColumns();
  if (more.num_vars > 0) {
    const std::vector<CoinBigIndex> no_entries(static_cast<std::size_t>(more.num_vars) + 1, 0);
    model_.addColumns(more.num_vars, Given(more.x_lower, more.num_vars, -kInfinity).data(),
                      Given(more.x_upper, more.num_vars, kInfinity).data(),
                      Given(more.q, more.num_vars, 0).data(), no_entries.data(), nullptr, nullptr);
  }
  if (more.num_rows == 0) return;
  const Csc none(n + more.num_vars, more.num_rows);
  const sy_csc by_rows = more.At != nullptr ? *more.At : none.View();
  model_.addRows(more.num_rows, Given(more.row_lower, more.num_rows, -kInfinity).data(),
                 Given(more.row_upper, more.num_rows, kInfinity).data(), by_rows.start, by_rows.row,
                 by_rows.value);
}

}  // namespace switchyard::clp
