// The user's names in a text that speaks of x[3], row[3] and cone[3].
#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "core/lower/lowering.hpp"

namespace switchyard {
namespace {

/// The index of the last entry of `first` that is not above i.
std::size_t Owner(const std::vector<std::int32_t>& first, int i) {
  const auto above = std::upper_bound(first.begin(), first.end(), i);
  return static_cast<std::size_t>(above - first.begin()) - 1;
}

}  // namespace

std::string Lowering::NameOf(const MathematicalProgram& program, const std::string& kind,
                             int index) const {
  if (kind == "x") {
    if (index < program.num_vars()) return program.VariableName(index);
    const std::size_t cost = Owner(norm_variable_, index);
    return "the epigraph of " + program.norm_costs()[cost].evaluator()->Name();
  }
  if (kind == "row") {
    if (affine_row_.empty()) return "a norm cost's row";
    const std::size_t k = Owner(affine_row_, index);
    const LinearConstraint& rows = *program.affine_constraints()[k].evaluator();
    const int local = index - affine_row_[k];
    return local < rows.num_constraints() ? rows.RowName(local) : "a norm cost's row";
  }
  if (kind == "c") return NameOfNonlinearRow(program, index);
  if (index >= num_program_cones_) return "a norm cost's cone";
  const auto cone = static_cast<std::size_t>(index);
  if (cone < cone_row_.size()) return program.cone_constraints()[cone].evaluator()->Name();
  // A quadratic constraint: the cones of those that have one are in order.
  std::size_t left = cone - cone_row_.size();
  for (std::size_t k = 0; k < quadratic_.size(); ++k) {
    if (quadratic_[k].row < 0 || left-- > 0) continue;
    return program.quadratic_constraints()[k].evaluator()->Name();
  }
  return "a quadratic constraint";
}

std::string Lowering::NameOfNonlinearRow(const MathematicalProgram& program, int row) const {
  if (row < static_cast<int>(quadratic_.size())) {
    return program.quadratic_constraints()[static_cast<std::size_t>(row)].evaluator()->RowName(0);
  }
  std::size_t k = 0;
  while (k + 1 < program.generic_constraints().size() && FirstNonlinearRow(k + 1) <= row) ++k;
  return program.generic_constraints()[k].evaluator()->RowName(row - FirstNonlinearRow(k));
}

std::string Lowering::WithNames(const MathematicalProgram& program, const std::string& text) const {
  struct Kind {
    std::string name;
    int count;
  };
  const ProblemData& d = problem_.data();
  const int functions = d.nlp != nullptr ? d.nlp->num_constraints : 0;
  const std::array<Kind, 4> kinds = {Kind{"x", d.num_vars}, Kind{"row", d.num_rows()},
                                     Kind{"cone", d.num_cones()}, Kind{"c", functions}};
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    bool replaced = false;
    const bool word_starts = at == 0 || std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0;
    for (const Kind& kind : kinds) {
      if (!word_starts || text.compare(at, kind.name.size() + 1, kind.name + "[") != 0) continue;
      const std::size_t digits = at + kind.name.size() + 1;
      const std::size_t close = text.find_first_not_of("0123456789", digits);
      if (close == std::string::npos || close == digits || close > digits + 9 ||
          text[close] != ']') {
        continue;
      }
      const int index = std::stoi(text.substr(digits, close - digits));
      if (index >= kind.count) continue;
      out += NameOf(program, kind.name, index);
      at = close + 1;
      replaced = true;
      break;
    }
    if (!replaced) out += text[at++];
  }
  return out;
}

}  // namespace switchyard
