// The lines of COLUMNS, RHS, RANGES, BOUNDS and of the quadratic objective.
#include <algorithm>
#include <cmath>

#include "core/io/mps_parser.hpp"

namespace switchyard::io {

void MpsParser::ColumnLine() {
  if (count_ == 3 && fields_[1] == "'MARKER'") return Marker();
  if (count_ != 3 && count_ != 5) {
    text_.Fail(Line(), "a column, then one or two pairs of a row and a number");
  }
  if (data_.columns.empty() || fields_[0] != data_.column_names.names().back()) {
    StartColumn(fields_[0]);
  }
  for (std::size_t i = 1; i < count_; i += 2) AddCoefficient(fields_[i], fields_[i + 1]);
}

void MpsParser::Marker() {
  if (fields_[2] == "'INTORG'") {
    in_integers_ = true;
  } else if (fields_[2] == "'INTEND'") {
    in_integers_ = false;
  } else {
    text_.Fail(fields_[2], "'INTORG' or 'INTEND'");
  }
}

void MpsParser::StartColumn(std::string_view name) {
  if (data_.column_names.Add(name) < 0) {
    text_.Fail(name, "a column that is new, as its lines stand together");
  }
  NoteBlanks(name);
  data_.columns.emplace_back().integer = in_integers_;
  data_.start.push_back(static_cast<int>(data_.row.size()));
}

void MpsParser::AddCoefficient(std::string_view row, std::string_view value) {
  const int index = data_.row_names.Find(row);
  if (index < 0) text_.Fail(row, "the name of a row");
  const auto i = static_cast<std::size_t>(index);
  const int column = data_.column_names.size() - 1;
  if (last_column_[i] == column) {
    text_.Fail(row, "each row once in a column", Text(Quoted(row), " again"));
  }
  last_column_[i] = column;
  const double number = text_.Number(value);
  if (data_.rows[i].number == MpsRow::kObjective) {
    data_.columns.back().cost = number;
  } else if (data_.rows[i].number >= 0 && number != 0) {
    data_.row.push_back(data_.rows[i].number);
    data_.value.push_back(number);
  }
}

// The first set of a section is the one that counts. A line without the name of a set is of the
// first.
bool MpsParser::TakeSet(std::size_t first_pair) {
  if (first_pair == 0) return true;
  const std::string_view name = fields_[first_pair - 1];
  if (!set_known_) {
    set_ = name;
    set_known_ = true;
  }
  if (name == set_) return true;
  notes_.Count(Text(section_->name, ": only the first set is read, another is left out"), name);
  return false;
}

double MpsParser::Side(std::string_view field) const {
  double value = 0;
  if (!ParseInfinity(field, &value)) value = text_.Number(field);
  return std::abs(value) < kMpsInfinity ? value : std::copysign(kInfinity, value);
}

void MpsParser::RhsLine() {
  if (count_ < 2 || count_ > 5) {
    text_.Fail(Line(), "a set, then one or two pairs of a row and a number");
  }
  const std::size_t first = count_ % 2;
  if (!TakeSet(first)) return;
  for (std::size_t i = first; i < count_; i += 2) {
    MpsRow& row = RowNamed(fields_[i]);
    if (!std::isnan(row.rhs)) {
      text_.Fail(fields_[i], "one right-hand side for a row",
                 Text("another for ", Quoted(fields_[i])));
    }
    row.rhs = row.type == 'N' ? text_.Number(fields_[i + 1]) : Side(fields_[i + 1]);
    const bool no_side =
        (row.rhs == kInfinity && row.type != 'L') || (row.rhs == -kInfinity && row.type != 'G');
    if (row.type != 'N' && no_side) {
      text_.Fail(fields_[i + 1], Text("a finite right-hand side for a row of type ", row.type));
    }
    // f(x) = rhs reads as f(x) - rhs = 0: so the constant of an objective is -rhs.
    if (row.number == MpsRow::kObjective && row.rhs != 0) data_.constant = -row.rhs;
  }
}

void MpsParser::RangeLine() {
  if (count_ < 2 || count_ > 5) {
    text_.Fail(Line(), "a set, then one or two pairs of a row and a number");
  }
  const std::size_t first = count_ % 2;
  if (!TakeSet(first)) return;
  for (std::size_t i = first; i < count_; i += 2) {
    MpsRow& row = RowNamed(fields_[i]);
    if (!std::isnan(row.range)) {
      text_.Fail(fields_[i], "one range for a row", Text("another for ", Quoted(fields_[i])));
    }
    row.range = Side(fields_[i + 1]);
    if (row.type == 'N') notes_.Count("the range of an N row is left out", fields_[i]);
  }
}

const std::array<MpsParser::BoundKind, 11> MpsParser::kBounds = {{
    {"UP", true, &MpsParser::ApplyUpper},
    {"LO", true, &MpsParser::ApplyLower},
    {"FX", true, &MpsParser::ApplyFixed},
    {"FR", false, &MpsParser::ApplyFree},
    {"MI", false, &MpsParser::ApplyMinusInfinity},
    {"PL", false, &MpsParser::ApplyPlusInfinity},
    {"BV", false, &MpsParser::ApplyBinary},
    {"LI", true, &MpsParser::ApplyIntegerLower},
    {"UI", true, &MpsParser::ApplyIntegerUpper},
    {"SC", true, &MpsParser::ApplySemicontinuous},
    {"SI", true, &MpsParser::ApplySemiInteger},
}};

// TYPE [SET] COLUMN [NUMBER]: a number stands behind each kind that needs one, and may stand, for
// nothing, behind the others.
void MpsParser::BoundLine() {
  const auto kind = std::find_if(kBounds.begin(), kBounds.end(),
                                 [&](const BoundKind& k) { return k.name == fields_[0]; });
  if (kind == kBounds.end()) {
    text_.Fail(fields_[0], "a type of bound: UP, LO, FX, FR, MI, PL, BV, LI, UI, SC or SI");
  }
  const bool enough = count_ >= (kind->needs_value ? 3 : 2) && count_ <= 4;
  if (!enough) {
    text_.Fail(Line(), kind->needs_value ? "a type of bound, a set, a column and a number"
                                         : "a type of bound, a set and a column");
  }
  const bool has_value = kind->needs_value || count_ == 4 ||
                         (count_ == 3 && data_.column_names.Find(fields_[2]) < 0 &&
                          data_.column_names.Find(fields_[1]) >= 0);
  const std::size_t column = count_ - (has_value ? 2 : 1);
  if (column > 1 && !TakeSet(column)) return;
  const double value = has_value ? Side(fields_[column + 1]) : 0;
  MpsColumn& bounded = ColumnNamed(fields_[column]);
  (this->*kind->apply)(&bounded, value);
  if (bounded.lower == kInfinity || bounded.upper == -kInfinity) {
    text_.Fail(fields_[column + 1], "a lower bound below, an upper bound above infinity");
  }
}

void MpsParser::SetLower(MpsColumn* column, double value) {
  if (column->lower_given) {
    notes_.Count("a lower bound is given again: the last one counts", Line());
  }
  column->lower = value;
  column->lower_given = true;
}

void MpsParser::SetUpper(MpsColumn* column, double value) {
  if (column->upper_given) {
    notes_.Count("an upper bound is given again: the last one counts", Line());
  }
  column->upper = value;
  column->upper_given = true;
}

void MpsParser::QuadraticLine() {
  if (count_ != 3) text_.Fail(Line(), "two columns and a number");
  std::array<int, 2> index;
  for (std::size_t i = 0; i < 2; ++i) {
    index[i] = data_.column_names.Find(fields_[i]);
    if (index[i] < 0) text_.Fail(fields_[i], "the name of a column");
  }
  data_.quadratic.push_back({index[0], index[1], text_.Number(fields_[2]), Line()});
}

}  // namespace switchyard::io
