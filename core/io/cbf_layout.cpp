#include "core/io/cbf_layout.hpp"

#include <algorithm>
#include <tuple>

#include "core/io/flat.hpp"

namespace switchyard::io {
namespace {

bool IsSemidefinite(const Binding<ConeConstraint>& binding) {
  return binding.evaluator()->cone().kind == SY_CONE_PSD;
}

// How many semidefinite constraints each variable is in.
std::vector<int> Uses(const MathematicalProgram& program) {
  std::vector<int> uses(static_cast<std::size_t>(program.num_vars()), 0);
  std::vector<int> last(uses.size(), -1);
  int number = 0;
  for (const auto& binding : program.cone_constraints()) {
    if (!IsSemidefinite(binding)) continue;
    for (const int j : IndicesOf(program, binding)) {
      const auto at = static_cast<std::size_t>(j);
      if (last[at] != number) ++uses[at];
      last[at] = number;
    }
    ++number;
  }
  return uses;
}

// Are the n x n `index`, column by column, one variable for each pair of places, continuous and in
// one semidefinite constraint?
bool IsMatrixOfItsOwn(const MathematicalProgram& program, const std::vector<int>& index, int n,
                      const std::vector<int>& uses) {
  std::vector<int> triangle;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i <= j; ++i) {
      const int variable = index[static_cast<std::size_t>(i + j * n)];
      if (variable != index[static_cast<std::size_t>(j + i * n)]) return false;
      if (uses[static_cast<std::size_t>(variable)] != 1) return false;
      if (program.variable_type(variable) != VariableType::kContinuous) return false;
      triangle.push_back(variable);
    }
  }
  std::sort(triangle.begin(), triangle.end());
  return std::adjacent_find(triangle.begin(), triangle.end()) == triangle.end();
}

}  // namespace

CbfLayout::CbfLayout(const MathematicalProgram& program)
    : places_(static_cast<std::size_t>(program.num_vars())) {
  const std::vector<int> uses = Uses(program);
  std::vector<int> in_matrices;  // in the order of a reader
  for (const auto& binding : program.cone_constraints()) {
    const auto* constraint =
        dynamic_cast<const PositiveSemidefiniteConstraint*>(binding.evaluator().get());
    if (constraint == nullptr) continue;
    const int n = constraint->matrix_rows();
    const std::vector<int> index = IndicesOf(program, binding);
    if (!IsMatrixOfItsOwn(program, index, n, uses)) continue;
    for (int b = 0; b < n; ++b) {
      for (int a = b; a < n; ++a) {
        const int variable = index[static_cast<std::size_t>(a + b * n)];
        places_[static_cast<std::size_t>(variable)] = {-1, static_cast<int>(matrix_sizes_.size()),
                                                       a, b};
        in_matrices.push_back(variable);
      }
    }
    matrices_.push_back(binding);
    matrix_sizes_.push_back(n);
  }
  for (CbfPlace& place : places_) {
    if (place.matrix < 0) place.scalar = num_scalars_++;
  }
  int expected = num_scalars_;
  for (const int variable : in_matrices) reordered_ |= variable != expected++;
}

bool CbfLayout::IsMatrixVariable(const Binding<ConeConstraint>& binding) const {
  return std::find(matrices_.begin(), matrices_.end(), binding) != matrices_.end();
}

}  // namespace switchyard::io
