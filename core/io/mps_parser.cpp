#include "core/io/mps_parser.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace switchyard::io {
namespace {

constexpr double kNotGiven = std::numeric_limits<double>::quiet_NaN();

std::string_view WithoutFirstWord(std::string_view line) {
  const std::size_t end =
      static_cast<std::size_t>(std::find_if(line.begin(), line.end(), IsBlank) - line.begin());
  return Trimmed(line.substr(end));
}

}  // namespace

const std::array<MpsParser::Section, 13> MpsParser::kSections = {{
    {"NAME", &MpsParser::NameHeader, nullptr, ""},
    {"OBJSENSE", &MpsParser::SenseHeader, &MpsParser::SenseLine, ""},
    {"OBJNAME", &MpsParser::ObjectiveNameHeader, &MpsParser::ObjectiveNameLine, ""},
    {"OBJECTIVE", &MpsParser::ObjectiveNameHeader, &MpsParser::ObjectiveNameLine, ""},
    {"ROWS", &MpsParser::RowsHeader, &MpsParser::RowLine, ""},
    {"COLUMNS", &MpsParser::ColumnsHeader, &MpsParser::ColumnLine, "ROWS"},
    {"RHS", &MpsParser::SideHeader, &MpsParser::RhsLine, "ROWS"},
    {"RANGES", &MpsParser::SideHeader, &MpsParser::RangeLine, "ROWS"},
    {"BOUNDS", &MpsParser::SideHeader, &MpsParser::BoundLine, "COLUMNS"},
    {"QUADOBJ", &MpsParser::QuadraticHeader, &MpsParser::QuadraticLine, "COLUMNS"},
    {"QSECTION", &MpsParser::QuadraticHeader, &MpsParser::QuadraticLine, "COLUMNS"},
    {"QMATRIX", &MpsParser::MatrixHeader, &MpsParser::QuadraticLine, "COLUMNS"},
    {"ENDATA", nullptr, nullptr, "COLUMNS"},
}};

MpsData MpsParser::Parse() {
  while (lines_.Next()) {
    const std::string_view line = lines_.line();
    if (line.empty() || line[0] == '*') continue;
    Split();
    if (count_ == 0) continue;
    if (IsHeader()) {
      EnterSection();
      if (section_->name == "ENDATA") {
        Finish();
        return std::move(data_);
      }
    } else if (section_ == nullptr || section_->line == nullptr) {
      text_.Fail(Line(), "the header of a section");
    } else {
      (this->*section_->line)();
    }
  }
  text_.Fail(lines_.line(), "ENDATA");
}

void MpsParser::Split() {
  if (layout_ == MpsLayout::kFree || !IsBlank(lines_.line()[0])) {
    count_ = SplitAtBlanks(lines_.line(), fields_);
  } else {
    SplitFixed();
  }
}

// Columns (from 1) 2-3, 5-12, 15-22, 25-36, 40-47 and 50-61. Between them are blanks, and no tabs
// anywhere: so a file that is not of this layout is not taken for one.
void MpsParser::SplitFixed() {
  struct Span {
    std::size_t start;
    std::size_t end;
  };
  static constexpr std::array<Span, 6> kSpans = {
      {{1, 3}, {4, 12}, {14, 22}, {24, 36}, {39, 47}, {49, 61}}};
  const std::string_view line = lines_.line();
  const std::size_t tab = line.find('\t');
  if (tab != std::string_view::npos) text_.Fail(line.substr(tab, 1), "blanks in fixed MPS");
  count_ = 0;
  std::size_t end = 0;  // of the field before
  for (const Span& span : kSpans) {
    const std::string_view gap = line.substr(std::min(end, line.size()), span.start - end);
    if (!Trimmed(gap).empty()) text_.Fail(Trimmed(gap), "blanks between the fields of fixed MPS");
    end = span.end;
    if (line.size() <= span.start) return;
    const std::string_view field = Trimmed(line.substr(span.start, span.end - span.start));
    if (!field.empty()) fields_[count_++] = field;
  }
  const std::string_view behind = Trimmed(line.substr(std::min(end, line.size())));
  if (!behind.empty()) text_.Fail(behind, "nothing behind column 61 of fixed MPS");
}

// A header starts in column 1. In free MPS a line of data may too: then it has more words than the
// header that it may look like ("RHS row 5").
bool MpsParser::IsHeader() const {
  if (IsBlank(lines_.line()[0])) return false;
  if (count_ == 1 || layout_ == MpsLayout::kFixed) return true;
  const auto found = std::find_if(kSections.begin(), kSections.end(),
                                  [&](const Section& s) { return s.name == fields_[0]; });
  if (found == kSections.end()) return section_ == nullptr || section_->line == nullptr;
  const bool takes_words = found->header != nullptr && found->header != &MpsParser::SideHeader;
  return takes_words || section_ == nullptr || section_->name != fields_[0];
}

void MpsParser::EnterSection() {
  const auto found = std::find_if(kSections.begin(), kSections.end(),
                                  [&](const Section& s) { return s.name == fields_[0]; });
  if (found == kSections.end()) {
    std::string names;
    for (const Section& section : kSections) {
      names += Text(names.empty() ? "" : ", ", section.name);
    }
    text_.Fail(fields_[0], Text("a section that is read here (", names, ")"));
  }
  const auto was = [&](std::string_view name) {
    return std::find(entered_.begin(), entered_.end(), name) != entered_.end();
  };
  if (was(found->name)) text_.Fail(fields_[0], Text("one section ", found->name), "another");
  if (!found->needs.empty() && !was(found->needs)) {
    text_.Fail(fields_[0], Text("the section ", found->needs, " before ", found->name));
  }
  entered_.push_back(found->name);
  section_ = &*found;
  if (found->header != nullptr) {
    (this->*found->header)();
  } else if (count_ > 1) {
    text_.Fail(fields_[1], Text("nothing behind ", found->name));
  }
}

void MpsParser::NameHeader() {
  if (count_ > 1) data_.name = fields_[1];
  if (count_ > 2) {
    notes_.Count("NAME: what stands behind the first word is left out",
                 WithoutFirstWord(WithoutFirstWord(Line())));
  }
}

void MpsParser::SenseHeader() {
  if (count_ == 1) return;
  fields_[0] = fields_[1];
  SenseLine();
}

void MpsParser::ObjectiveNameHeader() {
  if (count_ == 1) return;
  fields_[0] = fields_[1];
  ObjectiveNameLine();
}

void MpsParser::RowsHeader() {
  if (count_ > 1) text_.Fail(fields_[1], "nothing behind ROWS");
}

void MpsParser::ColumnsHeader() {
  if (count_ > 1) text_.Fail(fields_[1], "nothing behind COLUMNS");
  last_column_.assign(data_.rows.size(), -1);
  ChooseObjective();
}

void MpsParser::QuadraticHeader() {
  for (const std::string_view other : {"QUADOBJ", "QSECTION", "QMATRIX"}) {
    const bool there = std::find(entered_.begin(), entered_.end(), other) != entered_.end();
    if (other != section_->name && there) {
      text_.Fail(fields_[0], "the quadratic objective once",
                 Text(section_->name, " behind ", other));
    }
  }
  if (count_ == 1) return;
  const int row = data_.row_names.Find(fields_[1]);
  if (row < 0 || data_.rows[static_cast<std::size_t>(row)].number != MpsRow::kObjective) {
    text_.Fail(fields_[1],
               Text("the objective behind ", section_->name, " (a quadratic row cannot be held)"));
  }
}

void MpsParser::MatrixHeader() {
  QuadraticHeader();
  data_.both_triangles = true;
}

void MpsParser::SenseLine() {
  const std::string_view word = fields_[0];
  if (word == "MAX" || word == "MAXIMIZE" || word == "MAXIMISE") {
    data_.sense = ObjectiveSense::kMaximize;
  } else if (word == "MIN" || word == "MINIMIZE" || word == "MINIMISE") {
    data_.sense = ObjectiveSense::kMinimize;
  } else {
    text_.Fail(word, "MIN or MAX");
  }
}

void MpsParser::ObjectiveNameLine() {
  objective_name_ = fields_[0];
  if (data_.row_names.size() > 0) text_.Fail(objective_name_, "the objective's name before ROWS");
}

void MpsParser::RowLine() {
  if (count_ != 2) text_.Fail(Line(), "a type of row (N, L, G, E) and a name");
  if (fields_[0].size() != 1 || std::string_view("NLGE").find(fields_[0][0]) == std::string::npos) {
    text_.Fail(fields_[0], "a type of row: N, L, G or E");
  }
  if (data_.row_names.Add(fields_[1]) < 0) text_.Fail(fields_[1], "a row that is new");
  NoteBlanks(fields_[1]);
  const char type = fields_[0][0];
  data_.rows.push_back(
      {type, type == 'N' ? MpsRow::kDropped : data_.num_rows++, kNotGiven, kNotGiven});
}

// The objective is the N row that OBJNAME names, or the first.
void MpsParser::ChooseObjective() {
  bool found = false;
  for (std::size_t i = 0; i < data_.rows.size(); ++i) {
    MpsRow& row = data_.rows[i];
    if (row.type != 'N') continue;
    const std::string_view name = data_.row_names.names()[i];
    if (!found && (objective_name_.empty() || name == objective_name_)) {
      row.number = MpsRow::kObjective;
      found = true;
    } else {
      notes_.Count("a further N row is left out", name);
    }
  }
  if (!found && !objective_name_.empty()) text_.Fail(objective_name_, "the name of an N row");
  if (!found) notes_.Say("there is no N row: the objective is 0");
}

void MpsParser::NoteBlanks(std::string_view name) {
  if (std::any_of(name.begin(), name.end(), IsBlank)) *blanks_in_names_ = true;
}

MpsRow& MpsParser::RowNamed(std::string_view name) {
  const int row = data_.row_names.Find(name);
  if (row < 0) text_.Fail(name, "the name of a row");
  return data_.rows[static_cast<std::size_t>(row)];
}

MpsColumn& MpsParser::ColumnNamed(std::string_view name) {
  const int column = data_.column_names.Find(name);
  if (column < 0) text_.Fail(name, "the name of a column");
  return data_.columns[static_cast<std::size_t>(column)];
}

void MpsParser::Finish() {
  data_.start.push_back(static_cast<int>(data_.row.size()));
  if (in_integers_) notes_.Say("the last marker INTORG has no INTEND: integers up to the end");
  while (lines_.Next()) {
    if (Line().empty()) continue;
    notes_.Count("what stands behind ENDATA is left out", Line());
    return;
  }
}

std::unique_ptr<MathematicalProgram> ReadMps(const FileText& text, Notes* notes) {
  const auto read = [&](MpsLayout layout, bool* blanks_in_names) {
    Notes noted = *notes;
    MpsParser parser(text, layout, &noted, blanks_in_names);
    auto program = BuildMpsProgram(text, parser.Parse(), &noted);
    *notes = std::move(noted);
    return program;
  };
  bool blanks_in_names = false;
  try {
    return read(MpsLayout::kFree, &blanks_in_names);
  } catch (const FileError& free) {
    try {
      auto program = read(MpsLayout::kFixed, &blanks_in_names);
      notes->Say(
          Text("fixed MPS, with blanks in names: at line ", free.line(), " it is no free MPS"));
      return program;
    } catch (const FileError&) {
      if (blanks_in_names) throw;
    }
    throw;
  }
}

}  // namespace switchyard::io
