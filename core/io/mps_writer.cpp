#include "core/io/mps_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_set>
#include <utility>

#include "core/io/flat.hpp"
#include "core/io/mps_data.hpp"

namespace switchyard::io {
namespace {

bool TooLarge(double side) { return std::isfinite(side) && std::abs(side) >= kMpsInfinity; }

// Can a field of free MPS be this name? It is not empty, has no blanks, and is no marker.
bool Writable(std::string_view name) {
  return !name.empty() && name != "'MARKER'" && std::none_of(name.begin(), name.end(), [](char c) {
    return (c >= 0 && c <= ' ') || c == 0x7F;
  });
}

// The names as they are where they can be written and are new, and others made from `stem` and the
// number.
std::vector<std::string> WritableNames(const std::vector<std::string>& wishes,
                                       const std::string& stem, const char* kind, Notes* notes) {
  std::unordered_set<std::string_view> taken;
  std::vector<bool> kept(wishes.size());
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    kept[i] = Writable(wishes[i]) && taken.insert(wishes[i]).second;
  }
  std::unordered_set<std::string_view> wished(wishes.begin(), wishes.end());
  std::vector<std::string> names(wishes.size());
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    if (kept[i]) {
      names[i] = wishes[i];
      continue;
    }
    names[i] = stem + std::to_string(i);
    while (wished.contains(names[i])) names[i] += '_';
    if (!wishes[i].empty()) {
      notes->Count(Text("the name of a ", kind, " is replaced: it is there before, or has blanks"),
                   wishes[i]);
    }
  }
  return names;
}

// A range R whose sum with one side gives back the other, to the last bit where there is one.
struct Range {
  char type;  // G: the lower side and R above it; L: the upper one and R below it
  double length;
  bool exact;
};

Range RangeOf(double lower, double upper) {
  const double length = upper - lower;
  const double infinity = kInfinity;
  for (const double R : {length, std::nextafter(length, infinity), std::nextafter(length, 0.0)}) {
    if (R > 0 && lower + R == upper) return {'G', R, true};
    if (R > 0 && upper - R == lower) return {'L', R, true};
  }
  return {'G', length, false};
}

class MpsWriter {
 public:
  MpsWriter(const MathematicalProgram& program, Notes* notes)
      : program_(program), notes_(*notes), flat_(Flattened(program)) {}

  std::string Write() {
    ChooseNames();
    Header();
    Columns();
    Sides();
    Ranges();
    Bounds();
    Quadratic();
    out_ += "ENDATA\n";
    return std::move(out_);
  }

 private:
  enum class RowKind { kFree, kLess, kGreater, kEqual, kRange };
  [[nodiscard]] RowKind KindOf(std::size_t i) const {
    const double lower = flat_.row_lower[i];
    const double upper = flat_.row_upper[i];
    if (lower == upper) return RowKind::kEqual;
    if (lower > -kInfinity) return upper < kInfinity ? RowKind::kRange : RowKind::kGreater;
    return upper < kInfinity ? RowKind::kLess : RowKind::kFree;
  }
  void Line(std::initializer_list<std::string_view> words) {
    for (const std::string_view word : words) {
      out_ += ' ';
      out_ += word;
    }
    out_ += '\n';
  }
  void Line(std::initializer_list<std::string_view> words, double value) {
    for (const std::string_view word : words) {
      out_ += ' ';
      out_ += word;
    }
    out_ += ' ';
    AppendNumber(value, &out_);
    out_ += '\n';
  }
  void ChooseNames();
  void Header();
  void Columns();
  void Sides();
  void Ranges();
  void Bounds();
  void BoundsOf(int j);
  void Quadratic();

  const MathematicalProgram& program_;
  Notes& notes_;
  FlatProgram flat_;
  std::vector<std::string> columns_;
  std::vector<std::string> rows_;
  std::string objective_;
  std::string out_;
};

void MpsWriter::ChooseNames() {
  std::vector<std::string> columns;
  for (int j = 0; j < program_.num_vars(); ++j) columns.push_back(program_.VariableName(j));
  columns_ = WritableNames(columns, "x", "variable", &notes_);
  rows_ = WritableNames(flat_.row_names, "row", "row", &notes_);
  const std::unordered_set<std::string_view> taken(rows_.begin(), rows_.end());
  for (objective_ = "objective"; taken.contains(objective_);) objective_ += '_';
}

void MpsWriter::Header() {
  std::string name = program_.name();
  if (!name.empty() && !Writable(name)) {
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c >= 0 && c <= ' '; }, '_');
    notes_.Say(Text("the name of the program is written as ", Quoted(name)));
  }
  out_ += name.empty() ? "NAME\n" : "NAME " + name + "\n";
  if (program_.objective_sense() == ObjectiveSense::kMaximize) out_ += "OBJSENSE\n MAX\n";
  out_ += "ROWS\n";
  Line({"N", objective_});
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    switch (KindOf(i)) {
      case RowKind::kFree:
        notes_.Count("a row without sides is written as an N row, which readers leave out",
                     rows_[i]);
        Line({"N", rows_[i]});
        break;
      case RowKind::kLess:
        Line({"L", rows_[i]});
        break;
      case RowKind::kGreater:
        Line({"G", rows_[i]});
        break;
      case RowKind::kEqual:
        Line({"E", rows_[i]});
        break;
      case RowKind::kRange: {
        const Range range = RangeOf(flat_.row_lower[i], flat_.row_upper[i]);
        if (!range.exact) {
          notes_.Count("one side of a row moves by a rounding, as a range is a difference",
                       rows_[i]);
        }
        Line({std::string_view(&range.type, 1), rows_[i]});
        break;
      }
    }
  }
}

void MpsWriter::Columns() {
  out_ += "COLUMNS\n";
  bool integer = false;
  int markers = 0;
  const auto mark = [&](bool now) {
    if (now == integer) return;
    integer = now;
    Line({"MARKER" + std::to_string(markers++), "'MARKER'", now ? "'INTORG'" : "'INTEND'"});
  };
  for (int j = 0; j < program_.num_vars(); ++j) {
    mark(program_.variable_type(j) != VariableType::kContinuous);
    const std::string& name = columns_[static_cast<std::size_t>(j)];
    const bool empty = flat_.A.outerIndexPtr()[j] == flat_.A.outerIndexPtr()[j + 1];
    // A column without entries is there by its cost of 0.
    if (flat_.c(j) != 0 || empty) Line({name, objective_}, flat_.c(j));
    for (SparseMatrix::InnerIterator it(flat_.A, j); it; ++it) {
      Line({name, rows_[static_cast<std::size_t>(it.row())]}, it.value());
    }
  }
  mark(false);
}

void MpsWriter::Sides() {
  out_ += "RHS\n";
  if (flat_.constant != 0) Line({"RHS", objective_}, -flat_.constant);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const RowKind kind = KindOf(i);
    if (kind == RowKind::kFree) continue;
    const bool upper =
        kind == RowKind::kLess ||
        (kind == RowKind::kRange && RangeOf(flat_.row_lower[i], flat_.row_upper[i]).type == 'L');
    const double rhs = upper ? flat_.row_upper[i] : flat_.row_lower[i];
    if (rhs != 0) Line({"RHS", rows_[i]}, rhs);
  }
}

void MpsWriter::Ranges() {
  bool any = false;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (KindOf(i) != RowKind::kRange) continue;
    if (!any) out_ += "RANGES\n";
    any = true;
    Line({"RANGES", rows_[i]}, RangeOf(flat_.row_lower[i], flat_.row_upper[i]).length);
  }
}

void MpsWriter::Bounds() {
  out_ += "BOUNDS\n";
  for (int j = 0; j < program_.num_vars(); ++j) BoundsOf(j);
}

// Both bounds are said wherever one is not the default, so that no convention decides: PL behind
// the lower bound of an integer column, MI before a negative upper one.
void MpsWriter::BoundsOf(int j) {
  const std::string& name = columns_[static_cast<std::size_t>(j)];
  const double lower = flat_.lower(j);
  const double upper = flat_.upper(j);
  const bool integer = program_.variable_type(j) != VariableType::kContinuous;
  if (integer && lower == 0 && upper == 1) return Line({"BV", "BOUNDS", name});
  if (lower == upper) return Line({"FX", "BOUNDS", name}, lower);
  if (lower == -kInfinity && upper == kInfinity) return Line({"FR", "BOUNDS", name});
  if (lower == -kInfinity) Line({"MI", "BOUNDS", name});
  if (std::isfinite(lower) && (lower != 0 || upper < 0)) Line({"LO", "BOUNDS", name}, lower);
  if (upper < kInfinity) Line({"UP", "BOUNDS", name}, upper);
  if (integer && upper == kInfinity) Line({"PL", "BOUNDS", name});
}

void MpsWriter::Quadratic() {
  if (flat_.Q.nonZeros() == 0) return;
  out_ += "QUADOBJ\n";
  for (int j = 0; j < flat_.Q.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(flat_.Q, j); it && it.row() <= j; ++it) {
      Line({columns_[static_cast<std::size_t>(it.row())], columns_[static_cast<std::size_t>(j)]},
           it.value());
    }
  }
}

}  // namespace

std::vector<std::string> MpsCannotHold(const MathematicalProgram& program) {
  std::map<std::string, int> cones;
  for (const auto& binding : program.cone_constraints()) ++cones[binding.evaluator()->Kind()];
  std::vector<std::string> reasons;
  for (const auto& [kind, count] : cones) {
    reasons.push_back(Text("cones: ", count, " of kind ", kind));
  }
  for (std::string& words : OtherTermsInWords(program)) reasons.push_back(std::move(words));
  const auto check = [&](const char* what, const Constraint& constraint) {
    for (int i = 0; i < constraint.num_constraints(); ++i) {
      for (const double side : {constraint.lower_bound()(i), constraint.upper_bound()(i)}) {
        if (!TooLarge(side)) continue;
        reasons.push_back(Text(what, " of 1e20 or more, which MPS takes for infinite: ", side));
        return;
      }
      const double range = constraint.upper_bound()(i) - constraint.lower_bound()(i);
      if (TooLarge(range)) {
        reasons.push_back(Text(what, " that are 1e20 or more apart, which MPS takes for infinite"));
        return;
      }
    }
  };
  for (const auto& binding : program.bounding_box_constraints()) {
    check("bounds", *binding.evaluator());
  }
  for (const auto& binding : program.affine_constraints()) check("sides", *binding.evaluator());
  return reasons;
}

std::string WriteMps(const MathematicalProgram& program, Notes* notes) {
  return MpsWriter(program, notes).Write();
}

}  // namespace switchyard::io
