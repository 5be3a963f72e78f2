// From what an MPS file says to a program: a block of variables, one binding of bounds, one of
// rows, one cost of each kind.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/io/mps_data.hpp"
#include "core/io/sparse.hpp"

namespace switchyard::io {
namespace {

struct Box {
  double lower;
  double upper;
};

class MpsBuilder {
 public:
  MpsBuilder(const FileText& text, MpsData data, Notes* notes)
      : text_(text), data_(std::move(data)), notes_(*notes) {}

  std::unique_ptr<MathematicalProgram> Build() {
    program_ = std::make_unique<MathematicalProgram>();
    program_->set_name(Utf8(data_.name, &notes_));
    program_->set_objective_sense(data_.sense);
    for (std::size_t j = 0; j < data_.columns.size(); ++j) boxes_.push_back(BoxOf(j));
    AddVariables();
    AddBounds();
    AddRows();
    AddLinearCost();
    AddQuadraticCost();
    return std::move(program_);
  }

 private:
  [[nodiscard]] std::string_view ColumnName(std::size_t j) const {
    return data_.column_names.names()[j];
  }
  Box BoxOf(std::size_t j);
  Box BoxOfRow(const MpsRow& row) const;
  std::string NewName(const NameIndex& taken, const std::string& wish) const;
  void AddVariables();
  void AddBounds();
  void AddRows();
  void AddSwitches(std::vector<int>* start, std::vector<int>* row,
                   std::vector<double>* value) const;
  void SortColumns();
  void AddLinearCost();
  void AddQuadraticCost();
  [[nodiscard]] VectorXDecisionVariable Variables(const std::vector<int>& of) const;

  const FileText& text_;
  MpsData data_;
  Notes& notes_;
  std::unique_ptr<MathematicalProgram> program_;
  VectorXDecisionVariable x_;
  std::vector<Box> boxes_;     // of the columns
  std::vector<int> switched_;  // the columns that are 0 or in their box: each has a binary variable
};

// The conventions of bounds. An integer column without bounds is binary, as CPLEX, Gurobi and HiGHS
// read it; a negative upper bound without a lower one leaves the column free below.
Box MpsBuilder::BoxOf(std::size_t j) {
  const MpsColumn& c = data_.columns[j];
  Box box{c.lower_given ? c.lower : 0, c.upper};
  if (c.integer && !c.lower_given && !c.upper_given) {
    notes_.Count("an integer column without bounds is binary", ColumnName(j));
    box.upper = 1;
  }
  if (!c.lower_given && c.upper < 0) {
    notes_.Count("a column with a negative upper bound and no lower bound is free below",
                 ColumnName(j));
    box.lower = -kInfinity;
  }
  if (!c.semicontinuous) return box;
  if (box.lower <= 0 && box.upper >= 0) {
    notes_.Count("a semicontinuous column whose bounds hold 0 is a continuous one", ColumnName(j));
  } else if (!std::isfinite(box.lower) || !std::isfinite(box.upper)) {
    text_.Fail(ColumnName(j), "finite bounds of a semicontinuous column",
               Text("[", box.lower, ", ", box.upper, "] of ", Quoted(ColumnName(j))));
  } else {
    notes_.Count("a semicontinuous column is written with a binary variable and two rows",
                 ColumnName(j));
    switched_.push_back(static_cast<int>(j));
  }
  return box;
}

std::string MpsBuilder::NewName(const NameIndex& taken, const std::string& wish) const {
  std::string name = wish;
  for (int i = 2; taken.Find(name) >= 0; ++i) name = Text(wish, "_", i);
  return name;
}

void MpsBuilder::AddVariables() {
  std::vector<std::string> names;
  std::vector<VariableType> types;
  names.reserve(data_.columns.size() + switched_.size());
  types.reserve(names.capacity());
  for (std::size_t j = 0; j < data_.columns.size(); ++j) {
    names.push_back(Utf8(ColumnName(j), &notes_));
    const bool binary = boxes_[j].lower == 0 && boxes_[j].upper == 1;
    types.push_back(!data_.columns[j].integer ? VariableType::kContinuous
                    : binary                  ? VariableType::kBinary
                                              : VariableType::kInteger);
  }
  for (const int j : switched_) {
    names.push_back(NewName(data_.column_names, names[static_cast<std::size_t>(j)] + "_on"));
    types.push_back(VariableType::kBinary);
  }
  x_ = program_->NewVariables(std::move(names), types);
}

VectorXDecisionVariable MpsBuilder::Variables(const std::vector<int>& of) const {
  VectorXDecisionVariable some(static_cast<Eigen::Index>(of.size()));
  for (std::size_t i = 0; i < of.size(); ++i) some(static_cast<Eigen::Index>(i)) = x_(of[i]);
  return some;
}

// A binding takes no lower bound above the upper one. Of a column that a file gives such bounds the
// upper one is a binding of its own, so the program is what the file says: infeasible.
void MpsBuilder::AddBounds() {
  std::vector<Box> boxes = boxes_;
  for (const int j : switched_) {
    Box& box = boxes[static_cast<std::size_t>(j)];
    box = {std::min(0.0, box.lower), std::max(0.0, box.upper)};
  }
  boxes.resize(boxes.size() + switched_.size(), Box{0, 1});
  std::vector<int> bounded;
  std::vector<int> crossing;
  for (std::size_t j = 0; j < boxes.size(); ++j) {
    if (boxes[j].lower > -kInfinity || boxes[j].upper < kInfinity) {
      bounded.push_back(static_cast<int>(j));
    }
    if (boxes[j].lower > boxes[j].upper) {
      notes_.Count("the lower bound is above the upper one", ColumnName(j));
      crossing.push_back(static_cast<int>(j));
    }
  }
  const auto add = [&](const std::vector<int>& columns, auto box_of) {
    if (columns.empty()) return;
    Eigen::VectorXd lower(static_cast<Eigen::Index>(columns.size()));
    Eigen::VectorXd upper = lower;
    for (Eigen::Index i = 0; i < lower.size(); ++i) {
      const Box box = box_of(boxes[static_cast<std::size_t>(columns[static_cast<std::size_t>(i)])]);
      lower(i) = box.lower;
      upper(i) = box.upper;
    }
    program_->AddBoundingBoxConstraint(lower, upper, Variables(columns));
  };
  add(bounded, [](Box box) { return box.lower > box.upper ? Box{box.lower, kInfinity} : box; });
  add(crossing, [](Box box) { return Box{-kInfinity, box.upper}; });
}

// rhs is one side; a range R adds the other: L [rhs - |R|, rhs], G [rhs, rhs + |R|], E the one or
// the other by the sign of R. An infinite rhs leaves the row free.
Box MpsBuilder::BoxOfRow(const MpsRow& row) const {
  const double rhs = std::isnan(row.rhs) ? 0 : row.rhs;
  if (std::isinf(rhs)) return {-kInfinity, kInfinity};
  const double range = std::isnan(row.range) ? (row.type == 'E' ? 0 : kInfinity) : row.range;
  const bool below = row.type == 'L' || (row.type == 'E' && range < 0);
  return below ? Box{rhs - std::abs(range), rhs} : Box{rhs, rhs + std::abs(range)};
}

// Rows may come in any order within a column.
void MpsBuilder::SortColumns() {
  std::vector<std::pair<int, double>> column;
  for (std::size_t j = 0; j + 1 < data_.start.size(); ++j) {
    const auto from = static_cast<std::size_t>(data_.start[j]);
    const auto to = static_cast<std::size_t>(data_.start[j + 1]);
    if (std::is_sorted(data_.row.data() + from, data_.row.data() + to)) continue;
    column.clear();
    for (std::size_t k = from; k < to; ++k) column.emplace_back(data_.row[k], data_.value[k]);
    std::sort(column.begin(), column.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t k = from; k < to; ++k) {
      std::tie(data_.row[k], data_.value[k]) = column[k - from];
    }
  }
}

// x in {0} or [lower, upper], with its binary b: x - upper b <= 0 and x - lower b >= 0, two rows
// behind those of the file.
void MpsBuilder::AddSwitches(std::vector<int>* start, std::vector<int>* row,
                             std::vector<double>* value) const {
  std::vector<int> first_row(data_.columns.size(), -1);
  int next = data_.num_rows;
  for (const int j : switched_)
    first_row[static_cast<std::size_t>(j)] = std::exchange(next, next + 2);
  for (std::size_t j = 0; j < data_.columns.size(); ++j) {
    start->push_back(static_cast<int>(row->size()));
    const auto from = static_cast<std::size_t>(data_.start[j]);
    const auto to = static_cast<std::size_t>(data_.start[j + 1]);
    row->insert(row->end(), data_.row.data() + from, data_.row.data() + to);
    value->insert(value->end(), data_.value.data() + from, data_.value.data() + to);
    if (first_row[j] < 0) continue;
    row->insert(row->end(), {first_row[j], first_row[j] + 1});
    value->insert(value->end(), {1, 1});
  }
  for (const int j : switched_) {
    const Box& box = boxes_[static_cast<std::size_t>(j)];
    start->push_back(static_cast<int>(row->size()));
    const int first = first_row[static_cast<std::size_t>(j)];
    row->insert(row->end(), {first, first + 1});
    value->insert(value->end(), {-box.upper, -box.lower});
  }
  start->push_back(static_cast<int>(row->size()));
}

void MpsBuilder::AddRows() {
  SortColumns();
  if (!switched_.empty()) {
    std::vector<int> start;
    std::vector<int> row;
    std::vector<double> value;
    AddSwitches(&start, &row, &value);
    data_.start = std::move(start);
    data_.row = std::move(row);
    data_.value = std::move(value);
  }
  const int num_rows = data_.num_rows + 2 * static_cast<int>(switched_.size());
  if (num_rows == 0) return;
  Eigen::VectorXd lower(num_rows);
  Eigen::VectorXd upper(num_rows);
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(num_rows));
  const auto add = [&](Box box, std::string name) {
    lower(static_cast<Eigen::Index>(names.size())) = box.lower;
    upper(static_cast<Eigen::Index>(names.size())) = box.upper;
    names.push_back(std::move(name));
  };
  for (std::size_t i = 0; i < data_.rows.size(); ++i) {
    if (data_.rows[i].number < 0) continue;
    add(BoxOfRow(data_.rows[i]), Utf8(data_.row_names.names()[i], &notes_));
  }
  for (const int j : switched_) {
    const std::string column = Utf8(ColumnName(static_cast<std::size_t>(j)), &notes_);
    add({-kInfinity, 0}, NewName(data_.row_names, column + "_below"));
    add({0, kInfinity}, NewName(data_.row_names, column + "_above"));
  }
  auto A =
      CompressedColumns(num_rows, static_cast<int>(x_.size()), data_.start, data_.row, data_.value);
  const auto rows = program_->AddLinearConstraint(std::move(A), lower, upper, x_);
  rows.evaluator()->set_row_names(std::move(names));
}

void MpsBuilder::AddLinearCost() {
  std::vector<int> columns;
  for (std::size_t j = 0; j < data_.columns.size(); ++j) {
    if (data_.columns[j].cost != 0) columns.push_back(static_cast<int>(j));
  }
  if (columns.empty() && data_.constant == 0) return;
  Eigen::VectorXd a(static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    a(static_cast<Eigen::Index>(i)) = data_.columns[static_cast<std::size_t>(columns[i])].cost;
  }
  program_->AddLinearCost(a, data_.constant, Variables(columns));
}

// The objective has 1/2 x'Qx. QUADOBJ has one entry for each pair, QMATRIX both, which are equal.
void MpsBuilder::AddQuadraticCost() {
  if (data_.quadratic.empty()) return;
  std::vector<MpsQuadraticEntry> entries = data_.quadratic;
  if (!data_.both_triangles) {
    for (const MpsQuadraticEntry& e : data_.quadratic) {
      if (e.row != e.col) entries.push_back({e.col, e.row, e.value, e.at});
    }
  }
  const auto before = [](const MpsQuadraticEntry& a, const MpsQuadraticEntry& b) {
    return std::pair(a.col, a.row) < std::pair(b.col, b.row);
  };
  std::stable_sort(entries.begin(), entries.end(), before);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    if (k > 0 && !before(entries[k - 1], entries[k])) {
      const std::string_view one = entries[k - 1].at;
      const std::string_view at = one.data() > entries[k].at.data() ? one : entries[k].at;
      text_.Fail(at, "each pair of columns once", Text("another ", Quoted(at)));
    }
    if (!data_.both_triangles) continue;
    const MpsQuadraticEntry mirrored{entries[k].col, entries[k].row, 0, {}};
    const auto other = std::lower_bound(entries.begin(), entries.end(), mirrored, before);
    if (other == entries.end() || before(mirrored, *other) || other->value != entries[k].value) {
      text_.Fail(entries[k].at, "the same number at both places of a symmetric QMATRIX");
    }
  }
  std::vector<int> used;
  for (const MpsQuadraticEntry& e : entries) {
    if (used.empty() || used.back() != e.col) used.push_back(e.col);
  }
  std::vector<int> place(data_.columns.size());
  for (std::size_t i = 0; i < used.size(); ++i) {
    place[static_cast<std::size_t>(used[i])] = static_cast<int>(i);
  }
  const auto size = static_cast<Eigen::Index>(used.size());
  std::vector<Eigen::Triplet<double>> triplets;
  for (const MpsQuadraticEntry& e : entries) {
    if (e.value == 0) continue;
    triplets.emplace_back(place[static_cast<std::size_t>(e.row)],
                          place[static_cast<std::size_t>(e.col)], e.value);
  }
  SparseMatrix Q(size, size);
  Q.setFromTriplets(triplets.begin(), triplets.end());
  program_->AddQuadraticCost(Q, Eigen::VectorXd::Zero(size), 0, Variables(used));
}

}  // namespace

std::unique_ptr<MathematicalProgram> BuildMpsProgram(const FileText& text, MpsData data,
                                                     Notes* notes) {
  return MpsBuilder(text, std::move(data), notes).Build();
}

}  // namespace switchyard::io
