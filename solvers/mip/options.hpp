// solvers/mip/options.hpp - what can be set of branch and bound.
#pragma once

#include <string>
#include <string_view>

#include "switchyard/abi.h"

namespace switchyard::mip {

/// What bounds the nodes.
enum class EngineKind { kAuto, kConic, kOuter };

struct Options {
  EngineKind engine = EngineKind::kAuto;
  std::string solver;     // names of continuous backends for conic problems; ""; any
  std::string linear;     // likewise for linear ones
  int cut_rounds = 40;    // of cuts at the root, at most
  int node_rounds = 3;    // at a node with fractions, at most
  int dives = 6;          // tries at the root, rounding the first; 0: none
  int reliability = 4;    // children solved in a direction until its pseudocost is believed
  int candidates = 8;     // variables whose children are solved at a node, at most
  int probing = 1;        // 1: binaries are probed at the root
  int strengthening = 1;  // 1: perspectives and integer cuts, before all else
  int pool = 10;          // solutions kept
  int deterministic = 0;  // 1: the same tree for any number of threads

  /// Throws plugin::Failure: an unknown name, another type, a value out of range.
  void Set(std::string_view name, const sy_value& value);
};

/// The table of Options, NULL-terminated.
const sy_option* const* OptionTable();

}  // namespace switchyard::mip
