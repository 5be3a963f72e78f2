// solvers/linalg/dense_kernels.hpp - the inner loops of a front: where a factorization's time goes.
//
// Matrices are by columns; a leading dimension is a multiple of kLanes and columns start on a cache
// line, so that whole vectors are read and written. Rows behind the last, up to the leading
// dimension, and what is above a diagonal may be overwritten.
#pragma once

#include <cstdint>
#include <vector>

#include "solvers/linalg/pivots.hpp"
#include "solvers/linalg/symmetric_pattern.hpp"
#include "solvers/linalg/twofold.hpp"

namespace switchyard::linalg {

/// A front: pivots x pivots in `top`, rows x pivots in `below`. With twofold numbers a column takes
/// twice the leading dimension: of each kLanes rows the high parts, then the low ones.
struct Front {
  Digits digits = Digits::kPlain;
  Index pivots = 0;
  Index rows = 0;
  Index top_stride = 0;  // rows of the leading dimension
  Index below_stride = 0;
  double* top = nullptr;
  double* below = nullptr;
};

/// What is to be known of each pivot, and what comes of it.
struct FrontPivots {
  const std::int8_t* sign = nullptr;
  double* size = nullptr;  // of the terms that make it: see PivotRule; grows
  double* pivot = nullptr;
  double* inverse = nullptr;
};

/// The numbers of `work` that FactorFront and SubtractSquare need for `pivots` pivots.
inline constexpr std::size_t kWorkPerPivot = 8;

/// Both parts become L (unit lower triangular; what stands on and above the diagonal of `top` has
/// no meaning). How many pivots were raised.
int FactorFront(const Front& front, const FrontPivots& pivots, const PivotRule& rule, double* work);

/// y = sum over p of below(., p)^2 |pivot_p|: what the pivots add to the sizes of the rows below.
void SizesBelow(const Front& front, const double* pivot, double* y);

/// update -= L D L' for the lower triangle, with L the front's `below`.
void SubtractSquare(const Front& front, const double* pivot, double* update, double* work);

/// Adds rows of column `from` to `to`, row i at place[i] - shift.
struct RowRange {
  Index first, end;
};
void AddColumn(Digits digits, const double* from, RowRange rows, const Index* place, Index shift,
               double* to);

/// b[row[i]] -= y[i], and y[i] = b[row[i]] with zeros behind; y stands as in a column.
void SubtractRows(const double* y, Index rows, const Index* row, const NumbersOf<double>& b);
void TakeRows(const NumbersOf<double>& b, Index rows, const Index* row, double* y);

/// v[row[i]] += v[first + i].
void AddToRows(const NumbersOf<double>& v, Index first, const std::vector<Index>& row);

/// x <- top^-1 x, then y <- below x. Of x (pivots) and y (below_stride) the numbers stand as in a
/// column.
void ForwardFront(const Front& front, double* x, double* y);

/// x <- top^-T (D^-1 x - below' y).
void BackwardFront(const Front& front, const double* inverse_pivot, double* x, const double* y);

// The same for Digits::kTwofold; pivots and their inverses are high and low parts by turns.
int FactorTwofoldFront(const Front& front, const FrontPivots& pivots, const PivotRule& rule,
                       double* work);
void TwofoldSizesBelow(const Front& front, const double* pivot, double* y);
void SubtractTwofoldSquare(const Front& front, const double* pivot, double* update, double* work);
void AddTwofoldColumn(const double* from, RowRange rows, const Index* place, Index shift,
                      double* to);
void SubtractTwofoldRows(const double* y, Index rows, const Index* row, const NumbersOf<double>& b);
void TakeTwofoldRows(const NumbersOf<double>& b, Index rows, const Index* row, double* y);
void AddToTwofoldRows(const NumbersOf<double>& v, Index first, const std::vector<Index>& row);
void ForwardTwofoldFront(const Front& front, double* x, double* y);
void BackwardTwofoldFront(const Front& front, const double* inverse_pivot, double* x,
                          const double* y);

}  // namespace switchyard::linalg
