// core/io/cbf_data.hpp - what a CBF file says, before it is a program.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

#include "core/io/cbf_cones.hpp"
#include "core/io/text.hpp"
#include "switchyard/model/program.hpp"

namespace switchyard::io {

struct CbfCone {
  const CbfConeFacts* facts;
  int first;  // of the variables, or of the rows
  int size;
  double alpha;  // of a power cone
};

/// A number at the place that K indices tell.
template <std::size_t K>
struct CbfEntry {
  std::array<int, K> index;
  double value;
};

/// The entries of one block, and the block's name in the text.
template <std::size_t K>
struct CbfBlock {
  std::vector<CbfEntry<K>> entries;
  std::string_view at;
};

struct CbfData {
  ObjectiveSense sense = ObjectiveSense::kMinimize;
  std::vector<double> powers;       // of POWCONES: alpha_0 / (alpha_0 + alpha_1)
  std::vector<double> dual_powers;  // of POW*CONES
  int num_vars = 0;
  std::vector<CbfCone> var_cones;
  std::vector<int> integers;
  std::vector<int> matrix_vars;  // the rows of each matrix of PSDVAR
  int num_rows = 0;
  std::vector<CbfCone> row_cones;
  std::vector<int> matrix_rows;  // the rows of each matrix of PSDCON
  // With i a row, j a variable, k and l matrices of PSDVAR and PSDCON, (a, b) a place in one:
  CbfBlock<1> cost;         // j
  CbfBlock<3> matrix_cost;  // k a b
  double constant = 0;
  CbfBlock<2> A;  // i j
  CbfBlock<4> F;  // i k a b
  CbfBlock<1> b;  // i
  CbfBlock<4> H;  // l j a b
  CbfBlock<3> D;  // l a b
};

CbfData ParseCbf(const FileText& text);
std::unique_ptr<MathematicalProgram> BuildCbfProgram(const FileText& text, CbfData data);

}  // namespace switchyard::io
