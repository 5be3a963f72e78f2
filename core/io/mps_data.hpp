// core/io/mps_data.hpp - what an MPS file says, before it is a program.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/name_index.hpp"
#include "core/io/text.hpp"
#include "switchyard/model/program.hpp"

namespace switchyard::io {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kMpsInfinity = 1e20;  // a bound or side that large is none

struct MpsRow {
  char type;   // N, L, G, E
  int number;  // among the rows that are kept; kObjective, kDropped
  double rhs;  // NaN: not given
  double range;
  static constexpr int kObjective = -1;
  static constexpr int kDropped = -2;
};

struct MpsColumn {
  double cost = 0;
  double lower = 0;  // where lower_given
  double upper = kInfinity;
  bool integer = false;
  bool lower_given = false;
  bool upper_given = false;
  bool semicontinuous = false;
};

struct MpsQuadraticEntry {
  int row;
  int col;
  double value;
  std::string_view at;
};

struct MpsData {
  std::string_view name;
  ObjectiveSense sense = ObjectiveSense::kMinimize;
  NameIndex row_names;  // numbers the entries of `rows`
  std::vector<MpsRow> rows;
  int num_rows = 0;  // that are kept
  NameIndex column_names;
  std::vector<MpsColumn> columns;
  // The matrix by columns, rows in the file's order.
  std::vector<int> start;
  std::vector<int> row;
  std::vector<double> value;
  std::vector<MpsQuadraticEntry> quadratic;
  bool both_triangles = false;  // QMATRIX
  double constant = 0;
};

/// How a line is cut into fields: free MPS at blanks, fixed MPS at columns 2, 5, 15, 25, 40 and 50,
/// where a name may have blanks inside.
enum class MpsLayout { kFree, kFixed };

std::unique_ptr<MathematicalProgram> BuildMpsProgram(const FileText& text, MpsData data,
                                                     Notes* notes);

/// Free MPS is tried first. A file of fixed MPS with blanks in names never fits it (one field too
/// many on its line), so where it fails, the columns of fixed MPS are tried, which are as strict:
/// nothing between fields. Where both fail, fixed MPS says why if it met a name with blanks.
std::unique_ptr<MathematicalProgram> ReadMps(const FileText& text, Notes* notes);

}  // namespace switchyard::io
