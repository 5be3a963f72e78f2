#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "core/io/cbf_data.hpp"

namespace switchyard::io {
namespace {

// A file declares sizes in few bytes. What it may make a reader allocate grows with its own size:
// every variable, row and place of a matrix that means something is met in some line.
constexpr std::int64_t kFreePlaces = 100'000;
constexpr std::int64_t kPlacesPerByte = 64;

constexpr int kIntMax = std::numeric_limits<int>::max();

class CbfParser {
 public:
  explicit CbfParser(const FileText& text)
      : text_(text),
        lines_(text),
        places_left_(kFreePlaces +
                     kPlacesPerByte * static_cast<std::int64_t>(text.bytes().size())) {}

  CbfData Parse() {
    while (NextLine()) {
      const auto block = std::find_if(kBlocks.begin(), kBlocks.end(),
                                      [&](const Block& b) { return b.name == Line(); });
      if (block == kBlocks.end()) FailBlock();
      if (std::find(entered_.begin(), entered_.end(), block->name) != entered_.end()) {
        text_.Fail(Line(), Text("one block ", block->name), "another");
      }
      if (entered_.empty() && block->name != "VER") text_.Fail(Line(), "VER first");
      entered_.push_back(block->name);
      (this->*block->read)();
    }
    for (const std::string_view needed : {"VER", "OBJSENSE"}) {
      if (std::find(entered_.begin(), entered_.end(), needed) == entered_.end()) {
        text_.Fail(lines_.line(), std::string(needed));
      }
    }
    return std::move(data_);
  }

 private:
  struct Block {
    std::string_view name;
    void (CbfParser::*read)();
  };
  static const std::array<Block, 17> kBlocks;

  // The next line that is neither blank nor a comment.
  bool NextLine() {
    while (lines_.Next()) {
      if (!Line().empty() && Line()[0] != '#') return true;
    }
    return false;
  }
  [[nodiscard]] std::string_view Line() const { return Trimmed(lines_.line()); }

  // The fields of the next line, exactly `count` of them, which `what` names.
  std::span<const std::string_view> Fields(std::size_t count, const char* what) {
    if (!NextLine()) text_.Fail(lines_.line(), what);
    const std::size_t found = SplitAtBlanks(lines_.line(), fields_);
    if (found < count) text_.Fail(Line(), what);
    if (found > count) text_.Fail(fields_[count], Text("nothing behind ", what));
    return {fields_.data(), count};
  }

  // A count of lines to come, of at least two bytes each.
  int CountOfLines(std::string_view field, const char* what) const {
    const std::size_t most = lines_.rest().size() / 2 + 1;
    const int limit = static_cast<int>(std::min<std::size_t>(most, kIntMax - 1)) + 1;
    return text_.Integer(field, 0, limit, what);
  }

  void TakePlaces(std::string_view at, std::int64_t count) {
    places_left_ -= count;
    if (places_left_ < 0) {
      text_.Fail(at, Text("sizes that go with the size of the file (", kFreePlaces, " and ",
                          kPlacesPerByte, " a byte)"));
    }
  }

  [[noreturn]] void FailBlock() const {
    if (Line() == "CHANGE") {
      text_.Fail(Line(), "one problem in a file (a sequence of changes is not read)");
    }
    std::string names;
    for (const Block& block : kBlocks) names += Text(names.empty() ? "" : ", ", block.name);
    text_.Fail(Line(), Text("a block that is read here (", names, ")"));
  }

  void Version() {
    const auto fields = Fields(1, "the number of a version");
    static_cast<void>(text_.Integer(fields[0], 1, 5, "a version"));
  }
  void Sense() {
    const std::string_view word = Fields(1, "MIN or MAX")[0];
    if (word != "MIN" && word != "MAX") text_.Fail(word, "MIN or MAX");
    data_.sense = word == "MIN" ? ObjectiveSense::kMinimize : ObjectiveSense::kMaximize;
  }
  void Powers() { ReadPowers(&data_.powers); }
  void DualPowers() { ReadPowers(&data_.dual_powers); }
  void MatrixVars() { ReadSizes(&data_.matrix_vars); }
  void MatrixRows() { ReadSizes(&data_.matrix_rows); }
  void Vars() { ReadCones(&data_.num_vars, &data_.var_cones); }
  void Rows() { ReadCones(&data_.num_rows, &data_.row_cones); }
  void Integers();
  void Cost() { ReadEntries<1>("a variable and a number", &data_.cost, &CbfParser::VarAt<0>); }
  void MatrixCost() {
    ReadEntries<3>("a matrix, a row, a column and a number", &data_.matrix_cost,
                   &CbfParser::MatrixVarAt<0>);
  }
  void Constant() { data_.constant = text_.Number(Fields(1, "a number")[0]); }
  void A() { ReadEntries<2>("a row, a variable and a number", &data_.A, &CbfParser::RowAndVarAt); }
  void F() {
    ReadEntries<4>("a row, a matrix, its row, its column and a number", &data_.F,
                   &CbfParser::RowAndMatrixVarAt);
  }
  void B() { ReadEntries<1>("a row and a number", &data_.b, &CbfParser::RowAt); }
  void H() {
    ReadEntries<4>("a matrix, a variable, a row, a column and a number", &data_.H,
                   &CbfParser::MatrixRowAndVarAt);
  }
  void D() {
    ReadEntries<3>("a matrix, a row, a column and a number", &data_.D, &CbfParser::MatrixRowAt);
  }

  void ReadPowers(std::vector<double>* alphas);
  void ReadSizes(std::vector<int>* sizes);
  void ReadCones(int* total, std::vector<CbfCone>* cones);
  [[nodiscard]] CbfCone ConeOf(std::string_view name, std::string_view size, int first,
                               int left) const;

  template <std::size_t K>
  using IndexReader = void (CbfParser::*)(std::array<int, K>* index);
  template <std::size_t K>
  void ReadEntries(const char* what, CbfBlock<K>* block, IndexReader<K> read_index) {
    block->at = Line();
    const int count = CountOfLines(Fields(1, "a count")[0], "a count");
    block->entries.reserve(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k) {
      Fields(K + 1, what);
      CbfEntry<K> entry;
      (this->*read_index)(&entry.index);
      entry.value = text_.Number(fields_[K]);
      block->entries.push_back(entry);
    }
  }

  int Index(std::size_t field, int limit, const char* what) const {
    return text_.Integer(fields_[field], 0, limit, what);
  }
  // The place (a, b) of a symmetric matrix that fields `at` and at + 1 tell, with a >= b.
  void Place(std::size_t at, int size, int* a, int* b) const {
    *a = Index(at, size, "a row of the matrix");
    *b = Index(at + 1, size, "a column of the matrix");
    if (*a < *b) std::swap(*a, *b);
  }
  int Matrix(std::size_t field, const std::vector<int>& sizes, const char* what) const {
    return Index(field, static_cast<int>(sizes.size()), what);
  }
  template <std::size_t Field>
  void VarAt(std::array<int, 1>* index) {
    (*index)[0] = Index(Field, data_.num_vars, "a variable");
  }
  void RowAt(std::array<int, 1>* index) { (*index)[0] = Index(0, data_.num_rows, "a row"); }
  void RowAndVarAt(std::array<int, 2>* index) {
    *index = {Index(0, data_.num_rows, "a row"), Index(1, data_.num_vars, "a variable")};
  }
  template <std::size_t Field>
  void MatrixVarAt(std::array<int, 3>* index) {
    (*index)[0] = Matrix(Field, data_.matrix_vars, "a matrix of PSDVAR");
    Place(Field + 1, data_.matrix_vars[static_cast<std::size_t>((*index)[0])], &(*index)[1],
          &(*index)[2]);
  }
  void MatrixRowAt(std::array<int, 3>* index) {
    (*index)[0] = Matrix(0, data_.matrix_rows, "a matrix of PSDCON");
    Place(1, data_.matrix_rows[static_cast<std::size_t>((*index)[0])], &(*index)[1], &(*index)[2]);
  }
  void RowAndMatrixVarAt(std::array<int, 4>* index) {
    std::array<int, 3> rest;
    MatrixVarAt<1>(&rest);
    *index = {Index(0, data_.num_rows, "a row"), rest[0], rest[1], rest[2]};
  }
  void MatrixRowAndVarAt(std::array<int, 4>* index) {
    (*index)[0] = Matrix(0, data_.matrix_rows, "a matrix of PSDCON");
    (*index)[1] = Index(1, data_.num_vars, "a variable");
    Place(2, data_.matrix_rows[static_cast<std::size_t>((*index)[0])], &(*index)[2], &(*index)[3]);
  }

  const FileText& text_;
  Lines lines_;
  CbfData data_;
  std::array<std::string_view, 6> fields_;
  std::vector<std::string_view> entered_;
  std::int64_t places_left_;
};

const std::array<CbfParser::Block, 17> CbfParser::kBlocks = {{
    {"VER", &CbfParser::Version},
    {"OBJSENSE", &CbfParser::Sense},
    {"POWCONES", &CbfParser::Powers},
    {"POW*CONES", &CbfParser::DualPowers},
    {"PSDVAR", &CbfParser::MatrixVars},
    {"VAR", &CbfParser::Vars},
    {"INT", &CbfParser::Integers},
    {"PSDCON", &CbfParser::MatrixRows},
    {"CON", &CbfParser::Rows},
    {"OBJFCOORD", &CbfParser::MatrixCost},
    {"OBJACOORD", &CbfParser::Cost},
    {"OBJBCOORD", &CbfParser::Constant},
    {"FCOORD", &CbfParser::F},
    {"ACOORD", &CbfParser::A},
    {"BCOORD", &CbfParser::B},
    {"HCOORD", &CbfParser::H},
    {"DCOORD", &CbfParser::D},
}};

void CbfParser::Integers() {
  const int count = CountOfLines(Fields(1, "a count")[0], "a count");
  for (int k = 0; k < count; ++k) {
    Fields(1, "a variable");
    data_.integers.push_back(Index(0, data_.num_vars, "a variable"));
  }
}

// Each cone is a length and so many positive weights, one a line. The cone of the program has two.
void CbfParser::ReadPowers(std::vector<double>* alphas) {
  const auto header = Fields(2, "a count of cones and a count of weights");
  const int count = CountOfLines(header[0], "a count of cones");
  int left = CountOfLines(header[1], "a count of weights");
  for (int k = 0; k < count; ++k) {
    const std::string_view length = Fields(1, "a count of weights")[0];
    if (text_.Integer(length, 1, left + 1, "a count of weights") != 2) {
      text_.Fail(length, "2 weights (a power cone that a program holds has three entries)");
    }
    left -= 2;
    std::array<double, 2> weight;
    std::string_view field;
    for (double& w : weight) {
      field = Fields(1, "a weight")[0];
      w = text_.Number(field);
      if (w <= 0) text_.Fail(field, "a positive weight");
    }
    alphas->push_back(weight[0] / (weight[0] + weight[1]));
    if (alphas->back() <= 0 || alphas->back() >= 1) {
      text_.Fail(field, "two weights of comparable size");
    }
  }
  if (left != 0) text_.Fail(Line(), Text(left, " more weights, as POWCONES declares"));
}

void CbfParser::ReadSizes(std::vector<int>* sizes) {
  const int count = CountOfLines(Fields(1, "a count of matrices")[0], "a count of matrices");
  for (int k = 0; k < count; ++k) {
    const std::string_view field = Fields(1, "the size of a matrix")[0];
    const int size = text_.Integer(field, 1, 46341, "the size of a matrix");
    TakePlaces(field, std::int64_t{size} * (size + 1) / 2);
    sizes->push_back(size);
  }
}

void CbfParser::ReadCones(int* total, std::vector<CbfCone>* cones) {
  const auto header = Fields(2, "a count of entries and a count of cones");
  const std::string_view total_at = header[0];
  *total = text_.Integer(total_at, 0, kIntMax, "a count of entries");
  TakePlaces(total_at, *total);
  const int count = CountOfLines(header[1], "a count of cones");
  int first = 0;
  for (int k = 0; k < count; ++k) {
    const auto fields = Fields(2, "a cone and its size");
    cones->push_back(ConeOf(fields[0], fields[1], first, *total - first));
    first += cones->back().size;
  }
  if (first != *total) {
    text_.Fail(total_at, Text("the sum of the sizes of the cones, ", first));
  }
}

// NAME, or @k:NAME with k a cone of POWCONES or POW*CONES.
CbfCone CbfParser::ConeOf(std::string_view name, std::string_view size, int first, int left) const {
  const std::size_t colon = name.starts_with('@') ? name.find(':') : std::string_view::npos;
  const bool parametric = colon != std::string_view::npos;
  const CbfConeFacts* facts = FindCbfCone(parametric ? name.substr(colon + 1) : name);
  if (facts == nullptr || facts->parametric != parametric) {
    text_.Fail(name, "a cone (F, L+, L-, L=, Q, QR, EXP, EXP*, @k:POW or @k:POW*)");
  }
  CbfCone cone{facts, first, 0, 0};
  if (parametric) {
    const std::vector<double>& alphas = facts->name == "POW" ? data_.powers : data_.dual_powers;
    const int k =
        text_.Integer(name.substr(1, colon - 1), 0, static_cast<int>(alphas.size()),
                      facts->name == "POW" ? "a cone of POWCONES" : "a cone of POW*CONES");
    cone.alpha = alphas[static_cast<std::size_t>(k)];
  }
  if (left < facts->least_size) {
    text_.Fail(name, Text("a cone of at most ", left, " entries, as so many are left"));
  }
  const int most = std::min(left, facts->most_size);
  cone.size = text_.Integer(size, facts->least_size, most == kIntMax ? most : most + 1,
                            "the size of a cone");
  return cone;
}

}  // namespace

CbfData ParseCbf(const FileText& text) { return CbfParser(text).Parse(); }

}  // namespace switchyard::io
