// Functions of doubles, with the derivatives that they bring.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/functions/pattern_index.hpp"
#include "core/functions/probe.hpp"
#include "switchyard/error.hpp"
#include "switchyard/functions/make_function.hpp"

namespace switchyard {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using functions_detail::AnyMatrix;
using SparseMatrix = Eigen::SparseMatrix<double>;

// Calls visit(i, j, value) for every number that is stored.
template <class Visit>
void ForEach(const AnyMatrix& matrix, Visit&& visit) {
  if (const auto* M = std::get_if<MatrixXd>(&matrix)) {
    for (int j = 0; j < M->cols(); ++j) {
      for (int i = 0; i < M->rows(); ++i) visit(i, j, (*M)(i, j));
    }
  } else {
    const auto& S = std::get<SparseMatrix>(matrix);
    for (int j = 0; j < S.outerSize(); ++j) {
      for (SparseMatrix::InnerIterator it(S, j); it; ++it) {
        visit(static_cast<int>(it.row()), j, it.value());
      }
    }
  }
}

double At(const AnyMatrix& matrix, int i, int j) {
  return std::visit([&](const auto& M) { return M.coeff(i, j); }, matrix);
}

void CheckShape(std::string_view what, const AnyMatrix& matrix, int rows, int cols) {
  std::visit(
      [&](const auto& M) {
        Require(M.rows() == rows && M.cols() == cols, what, ": needs to be ", rows, " x ", cols,
                ", got ", M.rows(), " x ", M.cols());
      },
      matrix);
}

// To 1e-8 of the largest entry: what a caller computes twice may differ by its rounding.
void CheckSymmetric(const AnyMatrix& H) {
  double largest = 0;
  ForEach(H, [&](int, int, double h) { largest = std::max(largest, std::abs(h)); });
  ForEach(H, [&](int i, int j, double h) {
    if (i == j) return;
    const double mirrored = At(H, j, i);
    Require(!(std::abs(h - mirrored) > 1e-8 * largest), "Hessian: needs to be symmetric, but row ",
            i, " and column ", j, " has ", h, ", row ", j, " and column ", i, " has ", mirrored);
  });
}

// Writes the numbers of `matrix` where the pattern has them. Zeros may be anywhere.
void Place(std::string_view what, const AnyMatrix& matrix, bool upper_only,
           const PatternIndex& index, int size, double* target) {
  std::fill_n(target, size, 0.0);
  ForEach(matrix, [&](int i, int j, double value) {
    if (value == 0 || (upper_only && i > j)) return;
    target[index.Need(what, i, j)] = value;
  });
}

class FunctionOfDoubles final : public Function {
 public:
  FunctionOfDoubles(int num_vars, int num_outputs, PlainFunction f, const FunctionOptions& options)
      : Function(num_vars, num_outputs), f_(std::move(f)) {
    set_is_thread_safe(options.is_thread_safe);
    if (f_.jacobian) {
      SetJacobian(options.jacobian ? *options.jacobian
                                   : SparsityPattern::Dense(num_outputs, num_vars));
      jacobian_index_ = std::make_unique<PatternIndex>(jacobian());
    }
    if (f_.jacobian && f_.hessian) {
      SetHessian(options.hessian ? *options.hessian
                                 : SparsityPattern::DenseUpperTriangle(num_vars));
      hessian_index_ = std::make_unique<PatternIndex>(hessian());
    }
  }

  void Evaluate(const Evaluation& wanted) const override {
    Require(wanted.jacobian == nullptr || has_jacobian(), "function: it has no Jacobian");
    Require(wanted.hessian == nullptr || has_hessian(), "function: it has no Hessian");
    const VectorXd x = Eigen::Map<const VectorXd>(wanted.x, num_vars());
    if (wanted.values != nullptr) {
      const std::vector<double> y = f_.values(x);
      Require(std::ssize(y) == num_outputs(), "function: needs to return ", num_outputs(),
              " numbers as at first, got ", y.size());
      std::ranges::copy(y, wanted.values);
    }
    if (wanted.jacobian != nullptr) {
      const AnyMatrix J = f_.jacobian(x);
      CheckShape("Jacobian", J, num_outputs(), num_vars());
      Place("Jacobian", J, false, *jacobian_index_, jacobian().size(), wanted.jacobian);
    }
    if (wanted.hessian != nullptr) {
      const AnyMatrix H = f_.hessian(x, Eigen::Map<const VectorXd>(wanted.weights, num_outputs()));
      CheckShape("Hessian", H, num_vars(), num_vars());
      CheckSymmetric(H);
      Place("Hessian", H, true, *hessian_index_, hessian().size(), wanted.hessian);
    }
  }

 private:
  PlainFunction f_;
  std::unique_ptr<const PatternIndex> jacobian_index_;
  std::unique_ptr<const PatternIndex> hessian_index_;
};

}  // namespace

std::shared_ptr<const Function> FunctionAsItIs(int num_vars, PlainFunction f,
                                               const FunctionOptions& options) {
  const auto num_outputs =
      AtProbe(num_vars, options, [&](const VectorXd& x) { return f.values(x).size(); });
  options.Check(num_vars, static_cast<int>(num_outputs));
  return std::make_shared<FunctionOfDoubles>(num_vars, static_cast<int>(num_outputs), std::move(f),
                                             options);
}

}  // namespace switchyard
