// switchyard/symbolic/variable.hpp - a decision variable: an id. Its name, type and bounds are the
// program's.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <list>
#include <type_traits>
#include <vector>

#include "switchyard/symbolic/eigen_traits.hpp"

namespace switchyard {

enum class VariableType : std::uint8_t { kContinuous, kInteger, kBinary };

struct VariableEquality;

/// An id, unique in the process. Two variables are the same exactly when their ids are equal.
///
/// `a == b` is both: as a bool it says whether they are the same variable, as a formula
/// (formula.hpp) that their values are equal. The other comparisons are formulas alone; containers
/// order variables by std::less, which is by id.
class Variable {
 public:
  using Id = std::int64_t;

  Variable() = default;  // a dummy: in no program
  explicit Variable(Id id) : id_(id) {}

  [[nodiscard]] Id get_id() const { return id_; }
  [[nodiscard]] bool is_dummy() const { return id_ == 0; }
  [[nodiscard]] bool equal_to(Variable other) const { return id_ == other.id_; }
  friend constexpr VariableEquality operator==(Variable a, Variable b);
  friend bool operator!=(Variable a, Variable b) { return a.id_ != b.id_; }

 private:
  Id id_ = 0;
};

struct VariableEquality {
  Variable left;
  Variable right;
  // NOLINTNEXTLINE(google-explicit-constructor): the common meaning of ==
  operator bool() const { return left.equal_to(right); }
};
constexpr VariableEquality operator==(Variable a, Variable b) { return {a, b}; }

using DecisionVariable = Variable;
template <int rows, int cols>
using MatrixDecisionVariable = Eigen::Matrix<Variable, rows, cols>;
template <int rows>
using VectorDecisionVariable = MatrixDecisionVariable<rows, 1>;
using MatrixXDecisionVariable = MatrixDecisionVariable<Eigen::Dynamic, Eigen::Dynamic>;
using VectorXDecisionVariable = VectorDecisionVariable<Eigen::Dynamic>;
using VariableRefList = std::list<Eigen::Ref<const VectorXDecisionVariable>>;

/// The argument "some variables": one, a vector, a matrix (column by column), or a list of vectors
/// one behind the other.
class VariableList {
 public:
  // NOLINTBEGIN(google-explicit-constructor): an argument type, made to convert
  VariableList() = default;
  VariableList(Variable one) : all_(1) { all_(0) = one; }
  template <class Derived>
  VariableList(const Eigen::MatrixBase<Derived>& some) : all_(some.size()) {
    static_assert(std::is_same_v<typename Derived::Scalar, Variable>, "these are not variables");
    for (Eigen::Index j = 0, k = 0; j < some.cols(); ++j) {
      for (Eigen::Index i = 0; i < some.rows(); ++i) all_(k++) = some(i, j);
    }
  }
  VariableList(const VariableRefList& parts) { Join(parts); }
  VariableList(std::initializer_list<VectorXDecisionVariable> parts) { Join(parts); }
  VariableList(std::initializer_list<Variable> some)
      : all_(Eigen::Map<const VectorXDecisionVariable>(some.begin(),
                                                       static_cast<Eigen::Index>(some.size()))) {}
  // NOLINTEND(google-explicit-constructor)

  [[nodiscard]] const VectorXDecisionVariable& vector() const { return all_; }

 private:
  template <class Parts>
  void Join(const Parts& parts) {
    Eigen::Index size = 0;
    for (const auto& part : parts) size += part.size();
    all_.resize(size);
    Eigen::Index at = 0;
    for (const auto& part : parts) {
      all_.segment(at, part.size()) = part;
      at += part.size();
    }
  }

  VectorXDecisionVariable all_;
};

}  // namespace switchyard

template <>
struct std::hash<switchyard::Variable> {
  std::size_t operator()(switchyard::Variable v) const noexcept {
    return std::hash<switchyard::Variable::Id>()(v.get_id());
  }
};
template <>
struct std::less<switchyard::Variable> {
  bool operator()(switchyard::Variable a, switchyard::Variable b) const noexcept {
    return a.get_id() < b.get_id();
  }
};
