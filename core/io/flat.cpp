#include "core/io/flat.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>

namespace switchyard::io {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
using Triplets = std::vector<Eigen::Triplet<double>>;

void AddEntries(const SparseMatrix& M, int first_row, const std::vector<int>& columns,
                Triplets* triplets) {
  for (int j = 0; j < M.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(M, j); it; ++it) {
      triplets->emplace_back(first_row + static_cast<int>(it.row()),
                             columns[static_cast<std::size_t>(j)], it.value());
    }
  }
}

void AddBounds(const MathematicalProgram& program, FlatProgram* flat) {
  const int n = program.num_vars();
  flat->lower = Eigen::VectorXd::Constant(n, -kInfinity);
  flat->upper = Eigen::VectorXd::Constant(n, kInfinity);
  for (int j = 0; j < n; ++j) {
    if (program.variable_type(j) != VariableType::kBinary) continue;
    flat->lower(j) = 0;
    flat->upper(j) = 1;
  }
  for (const auto& binding : program.bounding_box_constraints()) {
    const std::vector<int> index = IndicesOf(program, binding);
    for (std::size_t k = 0; k < index.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      double& lower = flat->lower(index[k]);
      double& upper = flat->upper(index[k]);
      lower = std::max(lower, binding.evaluator()->lower_bound()(i));
      upper = std::min(upper, binding.evaluator()->upper_bound()(i));
    }
  }
}

void AddRows(const MathematicalProgram& program, FlatProgram* flat) {
  Triplets triplets;
  for (const auto& binding : program.affine_constraints()) {
    const LinearConstraint& rows = *binding.evaluator();
    AddEntries(rows.get_sparse_A(), static_cast<int>(flat->row_lower.size()),
               IndicesOf(program, binding), &triplets);
    for (int i = 0; i < rows.num_constraints(); ++i) {
      flat->row_lower.push_back(rows.lower_bound()(i));
      flat->row_upper.push_back(rows.upper_bound()(i));
      flat->row_names.push_back(rows.row_names().empty() ? "" : rows.RowName(i));
    }
  }
  flat->A.resize(static_cast<Eigen::Index>(flat->row_lower.size()), program.num_vars());
  flat->A.setFromTriplets(triplets.begin(), triplets.end());
  flat->A.prune([](Eigen::Index, Eigen::Index, double value) { return value != 0; });
}

void AddCosts(const MathematicalProgram& program, FlatProgram* flat) {
  const int n = program.num_vars();
  flat->c = Eigen::VectorXd::Zero(n);
  const auto add = [&](const std::vector<int>& index, const Eigen::VectorXd& a, double b) {
    for (std::size_t k = 0; k < index.size(); ++k) {
      flat->c(index[k]) += a(static_cast<Eigen::Index>(k));
    }
    flat->constant += b;
  };
  for (const auto& binding : program.linear_costs()) {
    add(IndicesOf(program, binding), binding.evaluator()->a(), binding.evaluator()->b());
  }
  Triplets triplets;
  for (const auto& binding : program.quadratic_costs()) {
    const std::vector<int> index = IndicesOf(program, binding);
    add(index, binding.evaluator()->b(), binding.evaluator()->c());
    const SparseMatrix& Q = binding.evaluator()->Q();
    for (int j = 0; j < Q.outerSize(); ++j) {
      for (SparseMatrix::InnerIterator it(Q, j); it; ++it) {
        triplets.emplace_back(index[static_cast<std::size_t>(it.row())],
                              index[static_cast<std::size_t>(j)], it.value());
      }
    }
  }
  flat->Q.resize(n, n);
  flat->Q.setFromTriplets(triplets.begin(), triplets.end());
  flat->Q.prune([](Eigen::Index, Eigen::Index, double value) { return value != 0; });
}

}  // namespace

FlatProgram Flattened(const MathematicalProgram& program) {
  FlatProgram flat;
  AddBounds(program, &flat);
  AddRows(program, &flat);
  AddCosts(program, &flat);
  return flat;
}

void AppendNumber(double value, std::string* text) {
  std::array<char, 32> digits;
  // The sign of a zero says nothing in a problem.
  const auto [end, error] =
      std::to_chars(digits.data(), digits.data() + digits.size(), value == 0 ? 0.0 : value);
  Require(error == std::errc(), "a number is too long to write: ", value);
  text->append(digits.data(), end);
}

std::vector<std::string> OtherTermsInWords(const MathematicalProgram& program) {
  std::vector<std::string> words;
  const auto count = [&words](const char* what, const auto& bindings) {
    std::map<std::string, int> kinds;
    for (const auto& binding : bindings) ++kinds[binding.evaluator()->Kind()];
    for (const auto& [kind, number] : kinds) {
      words.push_back(Text(what, ": ", number, " of kind ", kind));
    }
  };
  count("costs that are norms", program.norm_costs());
  count("costs that are functions", program.generic_costs());
  count("constraints that are quadratic", program.quadratic_constraints());
  count("constraints that are functions", program.generic_constraints());
  return words;
}

}  // namespace switchyard::io
