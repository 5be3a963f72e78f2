// solvers/linalg/lane_kernels.hpp - one elimination for several blocks of a shape at a time. Every
// number of a block stands beside those of the others: `lanes` (kLanes or 1) doubles each, or twice
// that, high parts before low ones.
#pragma once

#include "solvers/linalg/block_shapes.hpp"
#include "solvers/linalg/pivots.hpp"
#include "solvers/linalg/twofold.hpp"

namespace switchyard::linalg {

struct LaneShape {
  const BlockShape& block;
  Index lanes;
  Digits digits;
};

/// l: the matrix's entries become L, with pivots on the diagonal; triangle -= what the border gets.
/// How many pivots were raised.
int FactorLanes(const LaneShape& shape, const PivotRule& rule, double* l, double* inverse_pivot,
                double* triangle);

/// x: own rows, then the border's. Own ones become L^-1 x, and the border's lose L_border times it.
void ForwardLanes(const LaneShape& shape, const double* l, double* x);
/// Own rows become L^-T (D^-1 x - L_border' border).
void BackwardLanes(const LaneShape& shape, const double* l, const double* inverse_pivot, double* x);

/// to[place[k]] += the k-th of `from`, lane after lane.
void AddScattered(const LaneShape& shape, const double* from, const std::vector<Index>& place,
                  const NumbersOf<double>& to);

// The same for Digits::kTwofold.
int FactorTwofoldLanes(const LaneShape& shape, const PivotRule& rule, double* l,
                       double* inverse_pivot, double* triangle);
void AddTwofoldScattered(const LaneShape& shape, const double* from,
                         const std::vector<Index>& place, const NumbersOf<double>& to);
void ForwardTwofoldLanes(const LaneShape& shape, const double* l, double* x);
void BackwardTwofoldLanes(const LaneShape& shape, const double* l, const double* inverse_pivot,
                          double* x);

}  // namespace switchyard::linalg
