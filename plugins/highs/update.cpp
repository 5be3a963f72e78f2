// How a problem gets into HiGHS, whole or by its differences; a basis that is there stays.
#include <algorithm>
#include <numeric>
#include <utility>

#include "highs.hpp"
#include "linear/answer.hpp"
#include "switchyard/plugin.hpp"

namespace switchyard::highs {
namespace {

using linear::Given;
using plugin::Failure;

bool AnyInteger(const std::uint8_t* integer, std::int32_t count) {
  return integer != nullptr && std::any_of(integer, integer + count, [](auto i) { return i != 0; });
}

void RefuseMixedQuadratic(bool quadratic, bool integers) {
  if (quadratic && integers) {
    throw Failure(SY_E_UNSUPPORTED,
                  "HiGHS takes a quadratic objective or integer variables, not both at once");
  }
}

HighsSparseMatrix Columns(const sy_problem& problem) {
  HighsSparseMatrix a;
  a.format_ = MatrixFormat::kColwise;
  a.num_col_ = problem.num_vars;
  a.num_row_ = problem.num_rows;
  a.start_.assign(static_cast<std::size_t>(problem.num_vars) + 1, 0);
  if (problem.A == nullptr) return a;
  const sy_csc& given = *problem.A;
  const std::int32_t count = given.start[given.cols];
  a.start_.assign(given.start, given.start + given.cols + 1);
  a.index_.assign(given.row, given.row + count);
  a.value_.assign(given.value, given.value + count);
  return a;
}

HighsModel Model(const sy_problem& problem) {
  HighsModel model;
  HighsLp& lp = model.lp_;
  lp.num_col_ = problem.num_vars;
  lp.num_row_ = problem.num_rows;
  lp.col_cost_ = Given(problem.q, problem.num_vars, 0);
  lp.offset_ = problem.offset;
  lp.col_lower_ = Given(problem.x_lower, problem.num_vars, -kInfinity);
  lp.col_upper_ = Given(problem.x_upper, problem.num_vars, kInfinity);
  lp.row_lower_ = Given(problem.row_lower, problem.num_rows, -kInfinity);
  lp.row_upper_ = Given(problem.row_upper, problem.num_rows, kInfinity);
  lp.a_matrix_ = Columns(problem);
  if (AnyInteger(problem.integer, problem.num_vars)) {
    for (std::int32_t j = 0; j < problem.num_vars; ++j) {
      lp.integrality_.push_back(problem.integer[j] != 0 ? HighsVarType::kInteger
                                                        : HighsVarType::kContinuous);
    }
  }
  model.hessian_ = LowerTriangle(problem.P, problem.num_vars);
  return model;
}

}  // namespace

HighsHessian LowerTriangle(const sy_csc* p, std::int32_t num_vars) {
  HighsHessian hessian;
  if (p == nullptr || p->start[p->cols] == 0) return hessian;
  Csc lower = Transpose(*p);
  hessian.dim_ = num_vars;
  hessian.format_ = HessianFormat::kTriangular;
  hessian.start_ = std::move(lower.start);
  hessian.index_ = std::move(lower.row);
  hessian.value_ = std::move(lower.value);
  return hessian;
}

ModelView::ModelView(const HighsModel& model) : A{}, p{}, problem{} {
  const HighsLp& lp = model.lp_;
  const HighsSparseMatrix* a = &lp.a_matrix_;
  if (!a->isColwise()) {
    by_columns_ = *a;
    by_columns_.ensureColwise();
    a = &by_columns_;
  }
  A = {lp.num_row_, lp.num_col_, a->start_.data(), a->index_.data(), a->value_.data()};
  problem.size = sizeof problem;
  problem.num_vars = lp.num_col_;
  problem.num_rows = lp.num_row_;
  problem.q = lp.col_cost_.data();
  problem.offset = lp.offset_;
  problem.x_lower = lp.col_lower_.data();
  problem.x_upper = lp.col_upper_.data();
  problem.row_lower = lp.row_lower_.data();
  problem.row_upper = lp.row_upper_.data();
  if (lp.num_row_ > 0) problem.A = &A;
  const HighsHessian& h = model.hessian_;
  if (h.dim_ == 0) return;
  P = Transpose({h.dim_, h.dim_, h.start_.data(), h.index_.data(), h.value_.data()});
  p = P.View();
  problem.P = &p;
}

void Solver::Load(const sy_problem& problem, std::uint64_t) {
  RefuseMixedQuadratic(problem.P != nullptr, AnyInteger(problem.integer, problem.num_vars));
  start_ = {};
  start_is_new_ = false;
  worker_.Run([&] {
    Must(highs_->clearModel(), "to let go of a model");
    Must(highs_->passModel(Model(problem)), "the problem");
  });
}

void Solver::Update(const sy_update& update) {
  worker_.Run([&] {
    if (update.whole != 0) TakeWhole(*update.problem, update.whole);
    for (std::int32_t k = 0; k < update.num_x; ++k) {
      Must(highs_->changeColBounds(update.x[k], update.x_lower[k], update.x_upper[k]), "a bound");
    }
    for (std::int32_t k = 0; k < update.num_rows; ++k) {
      Must(highs_->changeRowBounds(update.row[k], update.row_lower[k], update.row_upper[k]),
           "a row's bound");
    }
    Remove(update);
    if (update.more != nullptr) Append(*update.more);
    start_.Follow(update);
  });
}

void Solver::TakeWhole(const sy_problem& problem, std::uint32_t kinds) {
  const std::int32_t n = problem.num_vars;
  const std::int32_t m = problem.num_rows;
  if ((kinds & SY_UPDATES_BOUNDS) != 0 && n > 0) {
    Must(highs_->changeColsBounds(0, n - 1, Given(problem.x_lower, n, -kInfinity).data(),
                                  Given(problem.x_upper, n, kInfinity).data()),
         "the bounds");
  }
  if ((kinds & SY_UPDATES_BOUNDS) != 0 && m > 0) {
    Must(highs_->changeRowsBounds(0, m - 1, Given(problem.row_lower, m, -kInfinity).data(),
                                  Given(problem.row_upper, m, kInfinity).data()),
         "the rows' bounds");
  }
  if ((kinds & SY_UPDATES_VECTORS) != 0) {
    if (n > 0) Must(highs_->changeColsCost(0, n - 1, Given(problem.q, n, 0).data()), "the costs");
    Must(highs_->changeObjectiveOffset(problem.offset), "the offset");
  }
  if ((kinds & SY_UPDATES_VALUES) != 0) TakeValues(problem);
}

// Few changed entries go in one by one; for many, or where HiGHS has dropped tiny ones and its
// pattern is another, the matrix goes in anew.
void Solver::TakeValues(const sy_problem& problem) {
  if (highs_->getHessianNumNz() > 0 || problem.P != nullptr) {
    Must(highs_->passHessian(LowerTriangle(problem.P, problem.num_vars)),
         "the quadratic objective");
  }
  if (problem.A == nullptr) return;
  const sy_csc& a = *problem.A;
  const auto count = static_cast<std::size_t>(a.start[a.cols]);
  const HighsLp& lp = highs_->getLp();
  const std::vector<double>& own = lp.a_matrix_.value_;
  const bool aligned = lp.a_matrix_.isColwise() && own.size() == count &&
                       std::equal(a.row, a.row + count, lp.a_matrix_.index_.begin()) &&
                       std::equal(a.start, a.start + a.cols + 1, lp.a_matrix_.start_.begin());
  const std::vector<double> before = own;
  std::size_t changed = count;
  if (aligned)
    changed -= std::inner_product(own.begin(), own.end(), a.value, std::size_t{0}, std::plus<>(),
                                  std::equal_to<>());
  if (!aligned || changed > count / 8) {
    const HighsBasis basis = highs_->getBasis();
    HighsModel model = highs_->getModel();
    model.lp_.a_matrix_ = Columns(problem);
    Must(highs_->passModel(std::move(model)), "the values");
    if (basis.valid) Must(highs_->setBasis(basis, "switchyard"), "its own basis");
    return;
  }
  for (std::int32_t j = 0; j < a.cols; ++j) {
    for (std::int32_t k = a.start[j]; k < a.start[j + 1]; ++k) {
      if (a.value[k] == before[static_cast<std::size_t>(k)]) continue;
      Must(highs_->changeCoeff(a.row[k], j, a.value[k]), "a value");
    }
  }
}

void Solver::Remove(const sy_update& update) {
  if (update.num_gone_rows == 0) return;
  Must(highs_->deleteRows(update.num_gone_rows, update.gone_row), "to remove rows");
}

void Solver::Append(const sy_more& more) {
  const std::int32_t first = highs_->getNumCol();
  RefuseMixedQuadratic(highs_->getHessianNumNz() > 0, AnyInteger(more.integer, more.num_vars));
  if (more.num_vars > 0) {
    const std::vector<HighsInt> no_entries(static_cast<std::size_t>(more.num_vars) + 1, 0);
    Must(highs_->addCols(more.num_vars, Given(more.q, more.num_vars, 0).data(),
                         Given(more.x_lower, more.num_vars, -kInfinity).data(),
                         Given(more.x_upper, more.num_vars, kInfinity).data(), 0, no_entries.data(),
                         nullptr, nullptr),
         "new variables");
    for (std::int32_t j = 0; AnyInteger(more.integer, more.num_vars) && j < more.num_vars; ++j) {
      if (more.integer[j] == 0) continue;
      Must(highs_->changeColIntegrality(first + j, HighsVarType::kInteger), "an integer variable");
    }
  }
  if (more.num_rows == 0) return;
  const Csc none(first + more.num_vars, more.num_rows);
  const sy_csc by_rows = more.At != nullptr ? *more.At : none.View();
  Must(highs_->addRows(more.num_rows, Given(more.row_lower, more.num_rows, -kInfinity).data(),
                       Given(more.row_upper, more.num_rows, kInfinity).data(),
                       by_rows.start[more.num_rows], by_rows.start, by_rows.row, by_rows.value),
       "new rows");
}

}  // namespace switchyard::highs
