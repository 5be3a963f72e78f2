// core/linalg/dense_lp.hpp - linear programs of few variables, answered in microseconds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace switchyard {

/// min c'x : row_lower <= A x <= row_upper, x_lower <= x <= x_upper; sides may be infinite.
struct DenseLp {
  explicit DenseLp(int n = 0) { Clear(n); }

  /// n variables without bounds, c = 0, no rows. Memory is kept.
  void Clear(int n);
  /// Appends a row of zeros; the n coefficients are written through what is returned, until the
  /// next row is added.
  double* AddRow(double lower, double upper);
  [[nodiscard]] int num_vars() const { return static_cast<int>(c.size()); }
  [[nodiscard]] int num_rows() const { return static_cast<int>(row_lower.size()); }
  [[nodiscard]] const double* row(std::size_t i) const { return A.data() + i * c.size(); }

  std::vector<double> c;
  std::vector<double> x_lower;
  std::vector<double> x_upper;
  std::vector<double> A;  // num_rows x num_vars, row by row
  std::vector<double> row_lower;
  std::vector<double> row_upper;
};

enum class DenseLpStatus : std::uint8_t { kOptimal, kInfeasible, kUnbounded, kUndecided };
std::string_view to_string(DenseLpStatus status);

/// Any other status than kUndecided is proven by the vectors, as dense_lp_certificate.hpp checks.
struct DenseLpAnswer {
  DenseLpStatus status = DenseLpStatus::kUndecided;
  double objective = 0;     // kOptimal: c'x
  std::vector<double> x;    // kOptimal, kUnbounded: a feasible point, of the least c'x if there is
  std::vector<double> ray;  // kUnbounded: x + t ray is feasible for t >= 0, c'ray < 0

  /// Multipliers y of the rows and z of the bounds, >= 0 where the lower side holds, <= 0 where the
  /// upper one does. kOptimal: A'y + z = c, and each points to a side that x is at.
  /// kInfeasible: A'y + z = 0, and their sides add up to more than 0 (Farkas).
  std::vector<double> row_dual;
  std::vector<double> x_dual;
  int pivots = 0;
};

/// The simplex method on a working set: n rows of G = [A; I] that hold with equality determine x;
/// their inverse is n x n, so that a pivot costs O(n^2 + mn) however many rows there are.
///
/// First the dual method, for costs shifted so that the first working set is optimal for them:
/// it ends at a feasible point or at a row that the working set contradicts. Then the primal method
/// with the true costs. Rows and columns are scaled by powers of two.
///
/// Holds memory that later calls use again; an object serves one thread at a time.
class DenseSimplex {
 public:
  DenseSimplex();
  ~DenseSimplex();
  DenseSimplex(DenseSimplex&&) noexcept;
  DenseSimplex& operator=(DenseSimplex&&) noexcept;

  /// The answer is good until the next call. Throws InvalidArgument where a lower side is above its
  /// upper one or is NaN.
  const DenseLpAnswer& Solve(const DenseLp& lp);
  /// The same, where nothing but c is different from the last call: starts where that ended.
  const DenseLpAnswer& SolveAgain(const DenseLp& lp);

 private:
  struct Method;
  std::unique_ptr<Method> method_;
};

}  // namespace switchyard
