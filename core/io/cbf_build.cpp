// From what a CBF file says to a program.
#include <algorithm>
#include <limits>
#include <utility>

#include "core/io/cbf.hpp"
#include "core/io/cbf_data.hpp"
#include "core/io/sparse.hpp"

namespace switchyard::io {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Of the matrices of a linear matrix inequality, which are dense: entries that any file may ask
// for, entries for each byte of it, and the most, which are a gigabyte.
constexpr std::size_t kFreeEntries = std::size_t{1} << 20;
constexpr std::size_t kEntriesPerByte = 1024;
constexpr std::size_t kMostEntries = std::size_t{1} << 27;

struct Term {
  int var;
  double factor;
};

// Rows of affine functions by rows: row i has terms[start[i]], ..., by variable, each once.
struct Rows {
  std::vector<int> start;
  std::vector<Term> terms;
  std::vector<double> constants;
};

class CbfBuilder {
 public:
  CbfBuilder(const FileText& text, CbfData data) : text_(text), data_(std::move(data)) {}

  std::unique_ptr<MathematicalProgram> Build() {
    program_ = std::make_unique<MathematicalProgram>();
    program_->set_objective_sense(data_.sense);
    AddVariables();
    AddBounds();
    AddMatrixVariables();
    x_ = program_->decision_variables();
    AddCost();
    for (const CbfCone& cone : data_.var_cones) AddCone(cone, UnitRows(cone));
    const Rows rows = AffineRows();
    AddLinearRows(rows);
    for (const CbfCone& cone : data_.row_cones) AddCone(cone, Part(rows, cone));
    AddMatrixInequalities();
    return std::move(program_);
  }

 private:
  void AddVariables();
  void AddBounds();
  void AddMatrixVariables();
  void AddCost();
  [[nodiscard]] Rows AffineRows();
  [[nodiscard]] static Rows UnitRows(const CbfCone& cone);
  [[nodiscard]] static Rows Part(const Rows& rows, const CbfCone& cone);
  void AddLinearRows(const Rows& rows);
  void AddCone(const CbfCone& cone, const Rows& x);
  void AddMatrixInequalities();
  void AddMatrixInequality(int matrix, std::size_t* next, std::size_t* next_constant,
                           std::size_t* entries_left);

  // The variable at place (a, b), a >= b, of matrix k: the lower triangle is numbered by columns.
  [[nodiscard]] int MatrixVariable(int k, int a, int b) const {
    const auto at = static_cast<std::size_t>(k);
    const int n = data_.matrix_vars[at];
    return first_of_matrix_[at] + static_cast<int>(std::int64_t{b} * (2 * n - b - 1) / 2) + a;
  }
  template <std::size_t K>
  void FailTwice(const CbfBlock<K>& block, const char* what) const {
    text_.Fail(block.at, Text("each ", what, " once in ", block.at), "one twice");
  }
  template <std::size_t K>
  void SortByIndex(CbfBlock<K>* block, const char* what) const {
    std::sort(block->entries.begin(), block->entries.end(),
              [](const auto& a, const auto& b) { return a.index < b.index; });
    const auto twice =
        std::adjacent_find(block->entries.begin(), block->entries.end(),
                           [](const auto& a, const auto& b) { return a.index == b.index; });
    if (twice != block->entries.end()) FailTwice(*block, what);
  }

  const FileText& text_;
  CbfData data_;
  std::unique_ptr<MathematicalProgram> program_;
  VectorXDecisionVariable x_;
  std::vector<int> first_of_matrix_;
};

void CbfBuilder::AddVariables() {
  if (data_.integers.empty()) {
    program_->NewContinuousVariables(data_.num_vars, "x");
    return;
  }
  const auto size = static_cast<std::size_t>(data_.num_vars);
  std::vector<VariableType> types(size, VariableType::kContinuous);
  for (const int j : data_.integers) types[static_cast<std::size_t>(j)] = VariableType::kInteger;
  std::vector<std::string> names;
  names.reserve(size);
  for (int j = 0; j < data_.num_vars; ++j) names.push_back("x(" + std::to_string(j) + ")");
  program_->NewVariables(std::move(names), types);
}

void CbfBuilder::AddMatrixVariables() {
  for (std::size_t k = 0; k < data_.matrix_vars.size(); ++k) {
    first_of_matrix_.push_back(program_->num_vars());
    const std::string name = data_.matrix_vars.size() == 1 ? Text("X") : Text("X", k);
    program_->AddPositiveSemidefiniteConstraint(
        program_->NewSymmetricContinuousVariables(data_.matrix_vars[k], name));
  }
}

void CbfBuilder::AddBounds() {
  Eigen::Index size = 0;
  const auto bounded = [](const CbfCone& cone) {
    return cone.facts->linear && (cone.facts->lower > -kInfinity || cone.facts->upper < kInfinity);
  };
  for (const CbfCone& cone : data_.var_cones) size += bounded(cone) ? cone.size : 0;
  if (size == 0) return;
  Eigen::VectorXd lower(size);
  Eigen::VectorXd upper(size);
  VectorXDecisionVariable vars(size);
  Eigen::Index at = 0;
  for (const CbfCone& cone : data_.var_cones) {
    if (!bounded(cone)) continue;
    for (int i = 0; i < cone.size; ++i, ++at) {
      lower(at) = cone.facts->lower;
      upper(at) = cone.facts->upper;
      vars(at) = program_->decision_variable(cone.first + i);
    }
  }
  program_->AddBoundingBoxConstraint(lower, upper, vars);
}

// <C, X> counts a place off the diagonal twice.
double Weight(int a, int b, double value) { return a == b ? value : 2 * value; }

void CbfBuilder::AddCost() {
  SortByIndex(&data_.cost, "variable");
  SortByIndex(&data_.matrix_cost, "place of a matrix");
  std::vector<Term> terms;
  for (const auto& [index, value] : data_.cost.entries) terms.push_back({index[0], value});
  for (const auto& [index, value] : data_.matrix_cost.entries) {
    terms.push_back(
        {MatrixVariable(index[0], index[1], index[2]), Weight(index[1], index[2], value)});
  }
  std::erase_if(terms, [](const Term& term) { return term.factor == 0; });
  if (terms.empty() && data_.constant == 0) return;
  const auto size = static_cast<Eigen::Index>(terms.size());
  Eigen::VectorXd a(size);
  VectorXDecisionVariable vars(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const Term& term = terms[static_cast<std::size_t>(i)];
    a(i) = term.factor;
    vars(i) = x_(term.var);
  }
  program_->AddLinearCost(a, data_.constant, vars);
}

// Entries of ACOORD and FCOORD put in rows by counting, then sorted within each row.
Rows CbfBuilder::AffineRows() {
  Rows rows;
  const auto size = static_cast<std::size_t>(data_.num_rows);
  rows.constants.assign(size, 0);
  SortByIndex(&data_.b, "row");
  for (const auto& [index, value] : data_.b.entries) {
    rows.constants[static_cast<std::size_t>(index[0])] = value;
  }
  rows.start.assign(size + 1, 0);
  const auto count = [&](int row) { ++rows.start[static_cast<std::size_t>(row) + 1]; };
  for (const auto& entry : data_.A.entries) count(entry.index[0]);
  for (const auto& entry : data_.F.entries) count(entry.index[0]);
  for (std::size_t i = 0; i < size; ++i) rows.start[i + 1] += rows.start[i];
  rows.terms.resize(static_cast<std::size_t>(rows.start[size]));
  std::vector<int> next(rows.start.begin(), rows.start.end() - 1);
  const auto put = [&](int row, Term term) {
    rows.terms[static_cast<std::size_t>(next[static_cast<std::size_t>(row)]++)] = term;
  };
  for (const auto& [index, value] : data_.A.entries) put(index[0], {index[1], value});
  for (const auto& [index, value] : data_.F.entries) {
    put(index[0],
        {MatrixVariable(index[1], index[2], index[3]), Weight(index[2], index[3], value)});
  }
  const auto before = [](const Term& a, const Term& b) { return a.var < b.var; };
  for (std::size_t i = 0; i < size; ++i) {
    Term* const first = rows.terms.data() + rows.start[i];
    Term* const last = rows.terms.data() + rows.start[i + 1];
    if (!std::is_sorted(first, last, before)) std::sort(first, last, before);
    const Term* const twice = std::adjacent_find(
        first, last, [](const Term& a, const Term& b) { return a.var == b.var; });
    if (twice == last) continue;
    if (twice->var < data_.num_vars) FailTwice(data_.A, "row and variable");
    FailTwice(data_.F, "row and place of a matrix");
  }
  data_.A = {};
  data_.F = {};
  return rows;
}

Rows CbfBuilder::UnitRows(const CbfCone& cone) {
  if (cone.facts->linear) return {};
  Rows rows;
  for (int i = 0; i < cone.size; ++i) {
    rows.start.push_back(i);
    rows.terms.push_back({cone.first + i, 1});
    rows.constants.push_back(0);
  }
  rows.start.push_back(cone.size);
  return rows;
}

Rows CbfBuilder::Part(const Rows& rows, const CbfCone& cone) {
  if (cone.facts->linear) return {};
  const auto first = static_cast<std::ptrdiff_t>(cone.first);
  const auto last = first + cone.size;
  Rows part;
  part.start.assign(rows.start.begin() + first, rows.start.begin() + last + 1);
  part.terms.assign(rows.terms.begin() + part.start.front(),
                    rows.terms.begin() + part.start.back());
  part.constants.assign(rows.constants.begin() + first, rows.constants.begin() + last);
  const int offset = part.start.front();
  for (int& start : part.start) start -= offset;
  return part;
}

// a'x + b in [lower, upper] is lower - b <= a'x <= upper - b.
void CbfBuilder::AddLinearRows(const Rows& rows) {
  std::vector<double> lower;
  std::vector<double> upper;
  std::vector<int> start(static_cast<std::size_t>(x_.size()) + 1, 0);
  const auto for_each_row = [&](auto visit) {
    for (const CbfCone& cone : data_.row_cones) {
      if (!cone.facts->linear) continue;
      for (int i = cone.first; i < cone.first + cone.size; ++i) {
        visit(*cone.facts, static_cast<std::size_t>(i));
      }
    }
  };
  const auto terms_of = [&](std::size_t i) {
    return std::pair(rows.terms.data() + rows.start[i], rows.terms.data() + rows.start[i + 1]);
  };
  for_each_row([&](const CbfConeFacts& facts, std::size_t i) {
    lower.push_back(facts.lower - rows.constants[i]);
    upper.push_back(facts.upper - rows.constants[i]);
    const auto [first, last] = terms_of(i);
    for (const Term* t = first; t != last; ++t) {
      if (t->factor != 0) ++start[static_cast<std::size_t>(t->var) + 1];
    }
  });
  if (lower.empty()) return;
  for (std::size_t j = 0; j + 1 < start.size(); ++j) start[j + 1] += start[j];
  std::vector<int> row(static_cast<std::size_t>(start.back()));
  std::vector<double> value(row.size());
  std::vector<int> next(start.begin(), start.end() - 1);
  int number = 0;
  for_each_row([&](const CbfConeFacts&, std::size_t i) {
    const auto [first, last] = terms_of(i);
    for (const Term* t = first; t != last; ++t) {
      if (t->factor == 0) continue;
      const auto at = static_cast<std::size_t>(next[static_cast<std::size_t>(t->var)]++);
      row[at] = number;
      value[at] = t->factor;
    }
    ++number;
  });
  const auto as_vector = [](const std::vector<double>& v) {
    return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
  };
  program_->AddLinearConstraint(
      CompressedColumns(number, static_cast<int>(x_.size()), start, row, value), as_vector(lower),
      as_vector(upper), x_);
}

// z = Tx over the variables that x has, T from the table of cones.
void CbfBuilder::AddCone(const CbfCone& cone, const Rows& x) {
  if (cone.facts->linear) return;
  std::vector<int> vars;
  for (const Term& term : x.terms) vars.push_back(term.var);
  std::sort(vars.begin(), vars.end());
  vars.erase(std::unique(vars.begin(), vars.end()), vars.end());
  Eigen::VectorXd b = Eigen::VectorXd::Zero(cone.size);
  std::vector<Eigen::Triplet<double>> triplets;
  for (const CbfLink& link : cone.facts->links(cone.size, cone.alpha)) {
    const auto from = static_cast<std::size_t>(link.from);
    b(link.to) += link.factor * x.constants[from];
    for (int k = x.start[from]; k < x.start[from + 1]; ++k) {
      const Term& term = x.terms[static_cast<std::size_t>(k)];
      const auto place = std::lower_bound(vars.begin(), vars.end(), term.var);
      if (term.factor != 0) {
        triplets.emplace_back(link.to, static_cast<int>(place - vars.begin()),
                              link.factor * term.factor);
      }
    }
  }
  SparseMatrix A(cone.size, static_cast<Eigen::Index>(vars.size()));
  A.setFromTriplets(triplets.begin(), triplets.end());
  A.prune([](Eigen::Index, Eigen::Index, double value) { return value != 0; });
  VectorXDecisionVariable of(static_cast<Eigen::Index>(vars.size()));
  for (std::size_t i = 0; i < vars.size(); ++i) of(static_cast<Eigen::Index>(i)) = x_(vars[i]);
  cone.facts->add(program_.get(), std::move(A), b, cone.alpha, of);
}

void CbfBuilder::AddMatrixInequalities() {
  SortByIndex(&data_.H, "matrix, variable and place");
  SortByIndex(&data_.D, "matrix and place");
  std::size_t next = 0;
  std::size_t next_constant = 0;
  std::size_t entries_left =
      std::min(kMostEntries, kFreeEntries + kEntriesPerByte * text_.bytes().size());
  for (int l = 0; l < static_cast<int>(data_.matrix_rows.size()); ++l) {
    AddMatrixInequality(l, &next, &next_constant, &entries_left);
  }
}

// D + sum x_j H_j is positive semidefinite; *next and *next_constant walk over the sorted entries.
void CbfBuilder::AddMatrixInequality(int matrix, std::size_t* next, std::size_t* next_constant,
                                     std::size_t* entries_left) {
  const int n = data_.matrix_rows[static_cast<std::size_t>(matrix)];
  const auto places = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
  std::vector<Eigen::MatrixXd> F;
  std::vector<int> vars;
  const auto open = [&] {
    if (places > *entries_left) {
      text_.Fail(
          data_.H.at.empty() ? data_.D.at : data_.H.at,
          Text("matrices of PSDCON with fewer entries, zeros counted"),
          Text("matrix ", matrix, " of size ", n, " with ", vars.size(), " variables or more"));
    }
    *entries_left -= places;
    F.emplace_back(Eigen::MatrixXd::Zero(n, n));
  };
  const auto put = [&](int a, int b, double value) { F.back()(a, b) = F.back()(b, a) = value; };
  open();
  for (const auto& D = data_.D.entries;
       *next_constant < D.size() && D[*next_constant].index[0] == matrix; ++*next_constant) {
    const auto& [index, value] = D[*next_constant];
    put(index[1], index[2], value);
  }
  for (const auto& H = data_.H.entries; *next < H.size() && H[*next].index[0] == matrix; ++*next) {
    const auto& [index, value] = H[*next];
    if (vars.empty() || vars.back() != index[1]) {
      vars.push_back(index[1]);
      open();
    }
    put(index[2], index[3], value);
  }
  VectorXDecisionVariable of(static_cast<Eigen::Index>(vars.size()));
  for (std::size_t i = 0; i < vars.size(); ++i) of(static_cast<Eigen::Index>(i)) = x_(vars[i]);
  program_->AddLinearMatrixInequalityConstraint(F, of);
}

}  // namespace

std::unique_ptr<MathematicalProgram> BuildCbfProgram(const FileText& text, CbfData data) {
  return CbfBuilder(text, std::move(data)).Build();
}

std::unique_ptr<MathematicalProgram> ReadCbf(const FileText& text, Notes* /*notes*/) {
  return BuildCbfProgram(text, ParseCbf(text));
}

}  // namespace switchyard::io
