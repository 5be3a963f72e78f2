// solvers/rounding/options.hpp - what can be set of relax-and-round.
#pragma once

#include <string>
#include <string_view>

#include "switchyard/abi.h"

namespace switchyard::rounding {

struct Options {
  std::string solver;            // names of backends for relaxation and restrictions; "": any
  int paths = 10;                // distinct ones to try; 0: the relaxation alone
  int trials = 100;              // draws of a path
  int cut_rounds = 6;            // of cuts, at most
  int cut_dimension = 16;        // of vertices that get cuts while paths are sought, at most
  int hulls = 0;                 // 1: cuts from the hulls of vertices, too
  int dives = 16;                // without paths: tries, the first is rounding; 0: the relaxation
  double flow_tolerance = 1e-5;  // arcs with no more flow are not drawn

  /// Throws plugin::Failure: an unknown name, another type, a value out of range.
  void Set(std::string_view name, const sy_value& value);
};

/// The table of Options, NULL-terminated.
const sy_option* const* OptionTable();

}  // namespace switchyard::rounding
