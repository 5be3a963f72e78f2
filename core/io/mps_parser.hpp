// core/io/mps_parser.hpp - walks over an MPS file, section by section.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/mps_data.hpp"

namespace switchyard::io {

class MpsParser {
 public:
  /// *blanks_in_names is set where a row or column is met whose name has a blank.
  MpsParser(const FileText& text, MpsLayout layout, Notes* notes, bool* blanks_in_names)
      : text_(text),
        layout_(layout),
        notes_(*notes),
        blanks_in_names_(blanks_in_names),
        lines_(text) {}
  MpsData Parse();

 private:
  struct Section {
    std::string_view name;
    void (MpsParser::*header)();  // nullptr: the header is one word
    void (MpsParser::*line)();    // nullptr: has no lines
    std::string_view needs;       // the section that stands before it
  };
  struct BoundKind {
    std::string_view name;
    bool needs_value;
    void (MpsParser::*apply)(MpsColumn*, double);
  };
  static const std::array<Section, 13> kSections;
  static const std::array<BoundKind, 11> kBounds;

  // A line's fields: fields_[0], ..., fields_[count_ - 1].
  void Split();
  void SplitFixed();
  [[nodiscard]] std::string_view Line() const { return Trimmed(lines_.line()); }
  [[nodiscard]] bool IsHeader() const;
  void EnterSection();
  void Finish();

  void NameHeader();
  void SenseHeader();
  void ObjectiveNameHeader();
  void QuadraticHeader();
  void RowsHeader();
  void ColumnsHeader();
  void SideHeader() {
    set_ = {};
    set_known_ = false;
  }
  void MatrixHeader();

  void SenseLine();
  void ObjectiveNameLine();
  void RowLine();
  void ColumnLine();
  void RhsLine();
  void RangeLine();
  void BoundLine();
  void QuadraticLine();

  void Marker();
  void StartColumn(std::string_view name);
  void ChooseObjective();
  void NoteBlanks(std::string_view name);
  void AddCoefficient(std::string_view row, std::string_view value);
  /// Names and numbers in pairs behind an optional name of the set; false: not of the first set.
  bool TakeSet(std::size_t first_pair);
  [[nodiscard]] MpsRow& RowNamed(std::string_view name);
  [[nodiscard]] MpsColumn& ColumnNamed(std::string_view name);
  [[nodiscard]] double Side(std::string_view field) const;  // a number or an infinity
  void SetLower(MpsColumn* column, double value);
  void SetUpper(MpsColumn* column, double value);

  void ApplyLower(MpsColumn* c, double v) { SetLower(c, v); }
  void ApplyUpper(MpsColumn* c, double v) { SetUpper(c, v); }
  void ApplyFixed(MpsColumn* c, double v) {
    SetLower(c, v);
    SetUpper(c, v);
  }
  void ApplyFree(MpsColumn* c, double) {
    SetLower(c, -kInfinity);
    SetUpper(c, kInfinity);
  }
  void ApplyMinusInfinity(MpsColumn* c, double) { SetLower(c, -kInfinity); }
  void ApplyPlusInfinity(MpsColumn* c, double) { SetUpper(c, kInfinity); }
  void ApplyBinary(MpsColumn* c, double) {
    SetLower(c, 0);
    SetUpper(c, 1);
    c->integer = true;
  }
  void ApplyIntegerLower(MpsColumn* c, double v) {
    SetLower(c, v);
    c->integer = true;
  }
  void ApplyIntegerUpper(MpsColumn* c, double v) {
    SetUpper(c, v);
    c->integer = true;
  }
  void ApplySemicontinuous(MpsColumn* c, double v) {
    SetUpper(c, v);
    c->semicontinuous = true;
  }
  void ApplySemiInteger(MpsColumn* c, double v) {
    ApplySemicontinuous(c, v);
    c->integer = true;
  }

  const FileText& text_;
  MpsLayout layout_;
  Notes& notes_;
  bool* blanks_in_names_;
  Lines lines_;
  MpsData data_;
  std::array<std::string_view, 7> fields_;
  std::size_t count_ = 0;
  const Section* section_ = nullptr;
  std::vector<std::string_view> entered_;
  std::string_view objective_name_;  // as OBJNAME says
  bool in_integers_ = false;         // between INTORG and INTEND
  std::vector<int> last_column_;     // by entry of data_.rows: the last column that it was met in
  std::string_view set_;             // the name of the first set of RHS, RANGES or BOUNDS
  bool set_known_ = false;
};

}  // namespace switchyard::io
