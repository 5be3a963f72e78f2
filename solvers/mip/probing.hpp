// solvers/mip/probing.hpp - binaries set to 0 and to 1 on trial, and what both cases, or the one
// that is left, say of the others.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "solvers/mip/node_boxes.hpp"
#include "solvers/mip/propagation.hpp"
#include "switchyard/problem.hpp"

namespace switchyard::mip {

struct ProbingOptions {
  double cutoff = kInfinity;  // only points at or below it count
  /// Of Workspace::work(), beyond what it is at the call. It alone decides what is probed, so that
  /// a run can be repeated; the clock only stops.
  std::int64_t work = std::numeric_limits<std::int64_t>::max();
  double seconds = kInfinity;
  bool record_implications = false;
};

/// x_from = from_value implies x_to = to_value, both binaries.
struct Implication {
  std::int32_t from;
  std::int32_t to;
  bool from_value;
  bool to_value;
};

struct ProbingResult {
  std::int32_t probed = 0;     // candidates done, those that were fixed before they came included
  std::int32_t fixed = 0;      // integers that had one value left at the end, and more before
  std::int32_t tightened = 0;  // other ends of boxes moved because both cases say so
  bool infeasible = false;     // no point is left: see the contradiction of the boxes
  bool complete = false;       // every candidate was probed, or no point is left
  std::vector<Implication> implications;  // by the candidate that implies
};

/// Probes `candidates` in their order, narrowing `boxes`. For each x_j with box {0, 1}: no point
/// left with x_j = 0 nor with x_j = 1, none at all; none in one case, the other is so; else every
/// point is in the union of the two cases' boxes. Changes stay on the trail of the boxes.
ProbingResult Probe(const Propagator& propagator, std::span<const std::int32_t> candidates,
                    const ProbingOptions& options, NodeBoxes& boxes, Workspace& workspace);

/// The binaries whose boxes are {0, 1}, those in most constraints first.
std::vector<std::int32_t> BinariesByConstraints(const Propagator& propagator,
                                                const NodeBoxes& boxes);

}  // namespace switchyard::mip
