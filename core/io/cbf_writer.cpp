#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/io/cbf.hpp"
#include "core/io/cbf_layout.hpp"
#include "core/io/flat.hpp"

namespace switchyard::io {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// One line of a block: indices and a number.
template <std::size_t K>
struct Entry {
  std::array<int, K> index;
  double value;
};

class CbfWriter {
 public:
  explicit CbfWriter(const MathematicalProgram& program, Notes* notes)
      : program_(program), notes_(*notes), flat_(Flattened(program)), layout_(program) {}

  std::string Write() {
    VariableCones();
    LinearRows();
    BoundRows();
    for (const auto& binding : program_.cone_constraints()) AddCone(binding);
    SplitCosts();
    SplitRows();
    Structure();
    Block("OBJFCOORD", matrix_cost_);
    Block("OBJACOORD", cost_);
    if (flat_.constant != 0) {
      out_ += "OBJBCOORD\n";
      AppendNumber(flat_.constant, &out_);
      out_ += "\n\n";
    }
    Block("FCOORD", F_);
    Block("ACOORD", A_);
    Block("BCOORD", b_);
    Block("HCOORD", H_);
    Block("DCOORD", D_);
    notes_.Say("CBF keeps no names: variables and rows are known by their numbers");
    if (layout_.reordered()) {
      notes_.Say("variables of semidefinite matrices are written as such, so others move up");
    }
    return std::move(out_);
  }

 private:
  struct Span {
    std::string cone;
    int size;
  };
  static void Append(const std::string& cone, int size, std::vector<Span>* spans) {
    const bool linear = cone == "F" || cone.starts_with('L');
    if (linear && !spans->empty() && spans->back().cone == cone) {
      spans->back().size += size;
    } else {
      spans->push_back({cone, size});
    }
  }
  void AddRow(const char* cone, double b) {
    Append(cone, 1, &row_cones_);
    AddConstant(b);
  }
  void AddConstant(double b) {
    if (b != 0) b_.push_back({{num_rows_}, b});
    ++num_rows_;
  }

  void VariableCones();
  void LinearRows();
  void BoundRows();
  void AddCone(const Binding<ConeConstraint>& binding);
  void AddMatrix(const Binding<ConeConstraint>& binding);
  std::string PowerCone(double alpha);
  void SplitCosts();
  void SplitRows();
  void Structure();
  void Cones(const char* name, int total, const std::vector<Span>& spans);
  void Sizes(const char* name, const std::vector<int>& sizes);
  template <std::size_t K>
  void Block(const char* name, const std::vector<Entry<K>>& entries) {
    if (entries.empty()) return;
    out_ += Text(name, "\n", entries.size(), "\n");
    for (const auto& [index, value] : entries) {
      for (const int i : index) out_ += std::to_string(i) + ' ';
      AppendNumber(value, &out_);
      out_ += '\n';
    }
    out_ += '\n';
  }

  const MathematicalProgram& program_;
  Notes& notes_;
  FlatProgram flat_;
  CbfLayout layout_;
  std::vector<Span> var_cones_;
  std::vector<bool> bounded_;  // by variable: are its bounds said by VAR?
  std::vector<Span> row_cones_;
  int num_rows_ = 0;
  std::vector<Eigen::Triplet<double>> row_terms_;  // (row of CON, variable, factor)
  std::vector<double> alphas_;
  std::vector<int> matrix_rows_;
  std::vector<Entry<1>> cost_;
  std::vector<Entry<3>> matrix_cost_;
  std::vector<Entry<2>> A_;
  std::vector<Entry<4>> F_;
  std::vector<Entry<1>> b_;
  std::vector<Entry<4>> H_;
  std::vector<Entry<3>> D_;
  std::string out_;
};

void CbfWriter::VariableCones() {
  bounded_.assign(static_cast<std::size_t>(program_.num_vars()), false);
  for (int j = 0; j < program_.num_vars(); ++j) {
    if (layout_.place(j).matrix >= 0) continue;
    const double lower = flat_.lower(j);
    const double upper = flat_.upper(j);
    const auto found = std::find_if(kCbfCones.begin(), kCbfCones.end(), [&](const auto& facts) {
      return facts.linear && facts.lower == lower && facts.upper == upper;
    });
    bounded_[static_cast<std::size_t>(j)] = found != kCbfCones.end();
    Append(found != kCbfCones.end() ? std::string(found->name) : "F", 1, &var_cones_);
  }
}

// lower <= a'x <= upper as a'x - lower in L+, a'x - upper in L-, or both.
void CbfWriter::LinearRows() {
  std::vector<std::array<int, 2>> rows_of(flat_.row_lower.size(), {-1, -1});
  for (std::size_t i = 0; i < rows_of.size(); ++i) {
    const double lower = flat_.row_lower[i];
    const double upper = flat_.row_upper[i];
    rows_of[i][0] = num_rows_;
    if (lower == upper) {
      AddRow("L=", -lower);
    } else if (lower > -kInfinity && upper < kInfinity) {
      notes_.Count("a row with two sides is written as two rows", Text("row ", i));
      AddRow("L+", -lower);
      rows_of[i][1] = num_rows_;
      AddRow("L-", -upper);
    } else if (lower > -kInfinity) {
      AddRow("L+", -lower);
    } else if (upper < kInfinity) {
      AddRow("L-", -upper);
    } else {
      AddRow("F", 0);
    }
  }
  for (int j = 0; j < flat_.A.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(flat_.A, j); it; ++it) {
      for (const int row : rows_of[static_cast<std::size_t>(it.row())]) {
        if (row >= 0) row_terms_.emplace_back(row, j, it.value());
      }
    }
  }
}

void CbfWriter::BoundRows() {
  const auto add = [&](int j, const char* cone, double bound) {
    notes_.Count("a bound of a variable other than 0 is written as a row",
                 program_.VariableName(j));
    row_terms_.emplace_back(num_rows_, j, 1);
    AddRow(cone, -bound);
  };
  for (int j = 0; j < program_.num_vars(); ++j) {
    if (bounded_[static_cast<std::size_t>(j)]) continue;
    const double lower = flat_.lower(j);
    const double upper = flat_.upper(j);
    if (lower == upper) {
      add(j, "L=", lower);
      continue;
    }
    if (lower > -kInfinity) add(j, "L+", lower);
    if (upper < kInfinity) add(j, "L-", upper);
  }
}

std::string CbfWriter::PowerCone(double alpha) {
  const auto found = std::find(alphas_.begin(), alphas_.end(), alpha);
  const auto k = found - alphas_.begin();
  if (found == alphas_.end()) alphas_.push_back(alpha);
  return Text("@", k, ":POW");
}

void CbfWriter::AddCone(const Binding<ConeConstraint>& binding) {
  const ConeConstraint& cone = *binding.evaluator();
  if (cone.cone().kind == SY_CONE_PSD) return AddMatrix(binding);
  std::string name;
  double first_factor = 1;
  switch (cone.cone().kind) {
    case SY_CONE_SECOND_ORDER:
      name = "Q";
      break;
    case SY_CONE_ROTATED:  // z_0 z_1 >= |w|^2 is 2 (z_0 / 2) z_1 >= |w|^2
      name = "QR";
      first_factor = 0.5;
      break;
    case SY_CONE_EXPONENTIAL:
      name = "EXP";
      break;
    default:
      name = PowerCone(cone.cone().parameter);
      break;
  }
  const std::vector<int> index = IndicesOf(program_, binding);
  const auto factor = [&](Eigen::Index row) { return row == 0 ? first_factor : 1; };
  for (int k = 0; k < cone.A().outerSize(); ++k) {
    for (SparseMatrix::InnerIterator it(cone.A(), k); it; ++it) {
      row_terms_.emplace_back(num_rows_ + static_cast<int>(it.row()),
                              index[static_cast<std::size_t>(k)], factor(it.row()) * it.value());
    }
  }
  Append(name, cone.num_constraints(), &row_cones_);
  for (Eigen::Index i = 0; i < cone.num_constraints(); ++i) AddConstant(factor(i) * cone.b()(i));
}

// Rows are the places of the matrix, column by column, of which the upper triangle counts. A matrix
// of PSDVAR is said there.
void CbfWriter::AddMatrix(const Binding<ConeConstraint>& binding) {
  if (layout_.IsMatrixVariable(binding)) return;
  const ConeConstraint& cone = *binding.evaluator();
  const int n = static_cast<int>(std::lround(std::sqrt(cone.num_constraints())));
  const int matrix = static_cast<int>(matrix_rows_.size());
  matrix_rows_.push_back(n);
  const std::vector<int> index = IndicesOf(program_, binding);
  for (int k = 0; k < cone.A().outerSize(); ++k) {
    for (SparseMatrix::InnerIterator it(cone.A(), k); it; ++it) {
      const int a = static_cast<int>(it.row()) / n;
      const int b = static_cast<int>(it.row()) % n;
      if (b > a) continue;
      const int scalar = layout_.place(index[static_cast<std::size_t>(k)]).scalar;
      H_.push_back({{matrix, scalar, a, b}, it.value()});
    }
  }
  for (int place = 0; place < cone.num_constraints(); ++place) {
    const int a = place / n;
    const int b = place % n;
    if (b <= a && cone.b()(place) != 0) D_.push_back({{matrix, a, b}, cone.b()(place)});
  }
}

// Terms of one variable in one row, or at one place, add up; then matrices are told from scalars.
void CbfWriter::SplitRows() {
  SparseMatrix rows(num_rows_, program_.num_vars());
  rows.setFromTriplets(row_terms_.begin(), row_terms_.end());
  for (int j = 0; j < rows.outerSize(); ++j) {
    const CbfPlace& place = layout_.place(j);
    for (SparseMatrix::InnerIterator it(rows, j); it; ++it) {
      const int row = static_cast<int>(it.row());
      if (it.value() == 0) continue;
      if (place.matrix < 0) {
        A_.push_back({{row, place.scalar}, it.value()});
      } else {
        F_.push_back({{row, place.matrix, place.a, place.b}, place.Share(it.value())});
      }
    }
  }
  std::sort(H_.begin(), H_.end(), [](const auto& a, const auto& b) { return a.index < b.index; });
  std::vector<Entry<4>> merged;
  for (const auto& entry : H_) {
    if (!merged.empty() && merged.back().index == entry.index) {
      merged.back().value += entry.value;
    } else {
      merged.push_back(entry);
    }
  }
  H_ = std::move(merged);
}

void CbfWriter::SplitCosts() {
  for (int j = 0; j < program_.num_vars(); ++j) {
    const CbfPlace& place = layout_.place(j);
    if (flat_.c(j) == 0) continue;
    if (place.matrix < 0) {
      cost_.push_back({{place.scalar}, flat_.c(j)});
    } else {
      matrix_cost_.push_back({{place.matrix, place.a, place.b}, place.Share(flat_.c(j))});
    }
  }
}

void CbfWriter::Sizes(const char* name, const std::vector<int>& sizes) {
  if (sizes.empty()) return;
  out_ += Text(name, "\n", sizes.size(), "\n");
  for (const int size : sizes) out_ += std::to_string(size) + '\n';
  out_ += '\n';
}

void CbfWriter::Cones(const char* name, int total, const std::vector<Span>& spans) {
  if (total == 0) return;
  out_ += Text(name, "\n", total, " ", spans.size(), "\n");
  for (const Span& span : spans) out_ += Text(span.cone, " ", span.size, "\n");
  out_ += '\n';
}

void CbfWriter::Structure() {
  const bool exponential = std::any_of(row_cones_.begin(), row_cones_.end(),
                                       [](const Span& span) { return span.cone == "EXP"; });
  out_ += Text("VER\n",
               !alphas_.empty() ? 3
               : exponential    ? 2
                                : 1,
               "\n\nOBJSENSE\n",
               program_.objective_sense() == ObjectiveSense::kMaximize ? "MAX" : "MIN", "\n\n");
  if (!alphas_.empty()) {
    out_ += Text("POWCONES\n", alphas_.size(), " ", 2 * alphas_.size(), "\n");
    for (const double alpha : alphas_) {
      out_ += "2\n";
      AppendNumber(alpha, &out_);
      out_ += '\n';
      AppendNumber(1 - alpha, &out_);
      out_ += '\n';
    }
    out_ += '\n';
  }
  Sizes("PSDVAR", layout_.matrix_sizes());
  Cones("VAR", layout_.num_scalars(), var_cones_);
  std::vector<int> integers;
  for (int j = 0; j < program_.num_vars(); ++j) {
    if (program_.variable_type(j) != VariableType::kContinuous) {
      integers.push_back(layout_.place(j).scalar);
    }
  }
  Sizes("INT", integers);
  Sizes("PSDCON", matrix_rows_);
  Cones("CON", num_rows_, row_cones_);
}

}  // namespace

std::vector<std::string> CbfCannotHold(const MathematicalProgram& program) {
  std::vector<std::string> reasons;
  const auto& quadratic = program.quadratic_costs();
  const auto count = std::count_if(quadratic.begin(), quadratic.end(), [](const auto& binding) {
    return binding.evaluator()->Q().nonZeros() > 0;
  });
  if (count > 0) reasons.push_back(Text("costs that are quadratic: ", count));
  for (std::string& words : OtherTermsInWords(program)) reasons.push_back(std::move(words));
  return reasons;
}

std::string WriteCbf(const MathematicalProgram& program, Notes* notes) {
  return CbfWriter(program, notes).Write();
}

}  // namespace switchyard::io
