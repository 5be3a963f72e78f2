// switchyard/functions/tape.hpp - a function written down as the operations that compute it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "switchyard/export.hpp"
#include "switchyard/functions/function.hpp"

namespace switchyard {

/// The elementary operations: a, b, c are the operands in order.
enum class Op : std::uint8_t {
  kConstant,
  kInput,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kNegate,
  kSqrt,
  kExp,
  kLog,
  kSin,
  kCos,
  kTan,
  kAsin,
  kAcos,
  kAtan,
  kSinh,
  kCosh,
  kTanh,
  kAbs,            // derivative 0 at 0
  kFloor,          // derivative 0
  kCeil,           // derivative 0
  kPower,          // a^b; a constant whole b is allowed any a, else a > 0 (a >= 0 where b > 0)
  kAtan2,          // atan2(a, b)
  kMin,            // at a tie the derivative of a
  kMax,            // likewise
  kIfPositive,     // a > 0 ? b : c; no derivative by a
  kIfNonnegative,  // a >= 0 ? b : c; no derivative by a
};
/// 0 for a constant or an input, else 1 to 3.
SWITCHYARD_EXPORT int NumOperands(Op op);

/// Operations in the order in which they are carried out; each names its operands by their places
/// before it. The first num_inputs() places are the inputs.
///
/// An operation that is there already is not written again: Apply gives back its place. What is
/// known without the inputs is folded; a term that is zero by structure (a * 0, 0 / a, a - a) is 0
/// whatever a is, infinite or NaN too.
class SWITCHYARD_EXPORT Tape {
 public:
  using Place = std::int32_t;
  struct Step {
    Op op = Op::kConstant;
    std::array<Place, 3> operand = {-1, -1, -1};
    double constant = 0;
  };

  explicit Tape(int num_inputs);

  [[nodiscard]] int num_inputs() const { return num_inputs_; }
  [[nodiscard]] const std::vector<Step>& steps() const { return steps_; }
  [[nodiscard]] const std::vector<Place>& outputs() const { return outputs_; }

  Place Constant(double value);
  /// Folds operations on constants and
  ///   a + 0, a - 0, a - a, 0 - a, -(-a), a * 1, a * -1, a * 0, a / 1, 0 / a,
  ///   a^0 = 1, a^1, a^2 = a * a, 1^a = 1, min(a, a), max(a, a), (a > 0 ? b : b).
  /// Throws InvalidArgument for operands that the operation does not take.
  Place Apply(Op op, Place a);
  Place Apply(Op op, Place a, Place b);
  Place Apply(Op op, Place a, Place b, Place c);
  void AddOutput(Place place);

  /// The same operations on the same constants, bit by bit.
  SWITCHYARD_EXPORT friend bool operator==(const Tape& s, const Tape& t);

 private:
  void CheckOperands(Op op, std::array<Place, 3> operand, int given) const;
  [[nodiscard]] bool IsConstant(Place place) const;
  [[nodiscard]] bool Is(Place place, double value) const;               // the constant `value`
  [[nodiscard]] Place Simplified(Op op, std::array<Place, 3> operand);  // -1 where it is not
  Place Written(Op op, std::array<Place, 3> operand);
  Place Find(const Step& step);  // its place, where it is written if it was not there
  void Rehash();

  int num_inputs_;
  std::vector<Step> steps_;
  std::vector<Place> outputs_;
  std::vector<Place> table_;  // open addressing by the hash of a step; -1 is free
};

/// The function that a tape computes, with exact sparse Jacobian and Hessian, thread-safe. The
/// values are those of the operations carried out in the order of the tape, to the last bit.
///
/// Operations that no output needs are left out. Patterns are structural: (i, j) is in the Jacobian
/// where a chain of operations leads from input j to output i, and in the Hessian where two chains
/// meet in an operation that is not linear. Both stand column by column.
///
/// Jacobian: reverse over each output's own operations, or forward in compressed columns (Curtis,
/// Powell, Reid 1974), by predicted work.
/// Hessian: edges pushed backwards (Gower, Mello, "A new framework for the computation of
/// Hessians", 2012), planned once as sums of products on fixed places.
///
/// Time and memory of compiling are linear in
///   the operations + the sum over outputs of the operations that it needs
///   + the sum over operations v of (operands of v)(operations before v that v is coupled with
///     by an entry d2(w'f)/dv du, once what comes after v is seen as a function of both).
/// The last is the work of one Hessian; it is O(n) for a sum of n terms and O(n^2) for the root of
/// a sum of n squares. Where it would be above 1e8, as for dense Hessians of some 8000 variables,
/// the function has no Hessian.
SWITCHYARD_EXPORT std::shared_ptr<const Function> CompileTape(const Tape& tape);

/// The tape that `f` was compiled from, as long as f lives; null where none was, as for own code.
SWITCHYARD_EXPORT const Tape* TapeOf(const Function& f);

}  // namespace switchyard
