// switchyard/functions/traced.hpp - the number that writes down what is done with it.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <iosfwd>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/functions/tape.hpp"

namespace switchyard {

/// A number, and the place on the tape of a Recording where it was computed; a constant has none.
/// Functions written for any type of number, with operators and unqualified sqrt, sin, .., run on
/// it as on doubles, with Eigen too.
///
/// What a tape cannot hold is a decision: to compare two numbers, or to ask for the value, tells
/// the recording that the operations may be others at other inputs. Comparing constants does not.
/// abs, min, max, floor and ceil are operations, and need no decision.
///
/// A number is used within its own recording. Together with one of another recording, or after the
/// end of its own, it throws InvalidArgument.
class SWITCHYARD_EXPORT Traced {
 public:
  Traced() = default;
  template <class T>
  requires std::is_arithmetic_v<T> Traced(
      T constant)  // NOLINT(google-explicit-constructor): a number among numbers
      : value_(static_cast<double>(constant)) {}

  /// A constant from here on, that has no derivative; tells the recording that it was asked for.
  [[nodiscard]] double value() const;
  explicit operator double() const { return value(); }

  /// An operation of the tape.
  static Traced Apply(Op op, const Traced& a);
  static Traced Apply(Op op, const Traced& a, const Traced& b);
  static Traced Apply(Op op, const Traced& a, const Traced& b, const Traced& c);

  Traced& operator+=(const Traced& b) { return *this = Apply(Op::kAdd, *this, b); }
  Traced& operator-=(const Traced& b) { return *this = Apply(Op::kSubtract, *this, b); }
  Traced& operator*=(const Traced& b) { return *this = Apply(Op::kMultiply, *this, b); }
  Traced& operator/=(const Traced& b) { return *this = Apply(Op::kDivide, *this, b); }

  friend Traced operator+(const Traced& a) { return a; }
  friend Traced operator-(const Traced& a) { return Apply(Op::kNegate, a); }
  friend Traced operator+(const Traced& a, const Traced& b) { return Apply(Op::kAdd, a, b); }
  friend Traced operator-(const Traced& a, const Traced& b) { return Apply(Op::kSubtract, a, b); }
  friend Traced operator*(const Traced& a, const Traced& b) { return Apply(Op::kMultiply, a, b); }
  friend Traced operator/(const Traced& a, const Traced& b) { return Apply(Op::kDivide, a, b); }

  friend bool operator==(const Traced& a, const Traced& b) { return a.value() == b.value(); }
  friend bool operator!=(const Traced& a, const Traced& b) { return a.value() != b.value(); }
  friend bool operator<(const Traced& a, const Traced& b) { return a.value() < b.value(); }
  friend bool operator<=(const Traced& a, const Traced& b) { return a.value() <= b.value(); }
  friend bool operator>(const Traced& a, const Traced& b) { return a.value() > b.value(); }
  friend bool operator>=(const Traced& a, const Traced& b) { return a.value() >= b.value(); }
  friend bool isfinite(const Traced& a) { return std::isfinite(a.value()); }
  friend bool isinf(const Traced& a) { return std::isinf(a.value()); }
  friend bool isnan(const Traced& a) { return std::isnan(a.value()); }

  friend Traced sqrt(const Traced& a) { return Apply(Op::kSqrt, a); }
  friend Traced exp(const Traced& a) { return Apply(Op::kExp, a); }
  friend Traced log(const Traced& a) { return Apply(Op::kLog, a); }
  friend Traced sin(const Traced& a) { return Apply(Op::kSin, a); }
  friend Traced cos(const Traced& a) { return Apply(Op::kCos, a); }
  friend Traced tan(const Traced& a) { return Apply(Op::kTan, a); }
  friend Traced asin(const Traced& a) { return Apply(Op::kAsin, a); }
  friend Traced acos(const Traced& a) { return Apply(Op::kAcos, a); }
  friend Traced atan(const Traced& a) { return Apply(Op::kAtan, a); }
  friend Traced sinh(const Traced& a) { return Apply(Op::kSinh, a); }
  friend Traced cosh(const Traced& a) { return Apply(Op::kCosh, a); }
  friend Traced tanh(const Traced& a) { return Apply(Op::kTanh, a); }
  friend Traced abs(const Traced& a) { return Apply(Op::kAbs, a); }
  friend Traced fabs(const Traced& a) { return Apply(Op::kAbs, a); }
  friend Traced floor(const Traced& a) { return Apply(Op::kFloor, a); }
  friend Traced ceil(const Traced& a) { return Apply(Op::kCeil, a); }
  friend Traced pow(const Traced& a, const Traced& b) { return Apply(Op::kPower, a, b); }
  friend Traced atan2(const Traced& a, const Traced& b) { return Apply(Op::kAtan2, a, b); }
  friend Traced min(const Traced& a, const Traced& b) { return Apply(Op::kMin, a, b); }
  friend Traced max(const Traced& a, const Traced& b) { return Apply(Op::kMax, a, b); }
  friend Traced fmin(const Traced& a, const Traced& b) { return Apply(Op::kMin, a, b); }
  friend Traced fmax(const Traced& a, const Traced& b) { return Apply(Op::kMax, a, b); }
  friend Traced hypot(const Traced& a, const Traced& b) { return sqrt(a * a + b * b); }
  friend Traced log2(const Traced& a) { return log(a) / std::log(2.0); }
  friend Traced log10(const Traced& a) { return log(a) / std::log(10.0); }

  /// Writes the value; to look at a number decides nothing.
  SWITCHYARD_EXPORT friend std::ostream& operator<<(std::ostream& out, const Traced& a);

 private:
  friend class Recording;
  Traced(double value, Tape::Place place, std::uint32_t recording)
      : value_(value), place_(place), recording_(recording) {}

  double value_ = 0;
  Tape::Place place_ = -1;
  std::uint32_t recording_ = 0;  // the number of its recording, where it has a place
};

/// While it lives, what its thread does with inputs() is written on its tape. Recordings may be
/// nested; the inner one ends first.
class SWITCHYARD_EXPORT Recording {
 public:
  /// Of a function at x.
  explicit Recording(const Eigen::Ref<const Eigen::VectorXd>& x);
  ~Recording();
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  [[nodiscard]] Traced input(int i) const;
  void AddOutput(const Traced& y);

  /// What was written, with the outputs; to be asked once.
  [[nodiscard]] Tape TakeTape() { return std::move(tape_); }
  /// The values of the outputs at x.
  [[nodiscard]] const std::vector<double>& outputs() const { return outputs_; }
  /// False where the tape computes the function at every x.
  [[nodiscard]] bool has_decisions() const { return has_decisions_; }

 private:
  friend class Traced;
  static Recording* Find(std::uint32_t number);
  static Traced Record(Op op, const Traced* const (&operand)[3], int num_operands);
  Tape::Place PlaceOf(const Traced& a);

  Tape tape_;
  std::vector<double> x_;
  std::vector<double> outputs_;
  std::uint32_t number_;
  bool has_decisions_ = false;
  Recording* outer_;
};

}  // namespace switchyard

template <>
struct std::numeric_limits<switchyard::Traced> : std::numeric_limits<double> {};

namespace Eigen {

template <>
struct NumTraits<switchyard::Traced> : NumTraits<double> {
  using Real = switchyard::Traced;
  using NonInteger = switchyard::Traced;
  using Nested = switchyard::Traced;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2,
    AddCost = 40,
    MulCost = 40
  };
};

template <class BinaryOp>
struct ScalarBinaryOpTraits<switchyard::Traced, double, BinaryOp> {
  using ReturnType = switchyard::Traced;
};
template <class BinaryOp>
struct ScalarBinaryOpTraits<double, switchyard::Traced, BinaryOp> {
  using ReturnType = switchyard::Traced;
};

// Large products coefficient by coefficient: the blocked ones of Eigen 3.4 do not compile for two
// types of numbers, and would gain nothing.
template <class Lhs, class Rhs>
requires(std::same_as<typename Lhs::Scalar, switchyard::Traced> ||
         std::same_as<typename Rhs::Scalar, switchyard::Traced>) struct internal::
    generic_product_impl<Lhs, Rhs, DenseShape, DenseShape, GemmProduct>
    : internal::generic_product_impl<Lhs, Rhs, DenseShape, DenseShape, CoeffBasedProductMode> {
};

}  // namespace Eigen
