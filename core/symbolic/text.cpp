// Expressions as texts.
#include <charconv>
#include <cmath>
#include <ostream>

#include "core/functions/op_table.hpp"
#include "core/symbolic/node.hpp"
#include "switchyard/symbolic/expression.hpp"
#include "switchyard/symbolic/variable_names.hpp"

namespace switchyard {
namespace {

// How tightly a text holds together: what stands inside something tighter needs brackets.
enum class Bond { kSum, kProduct, kPower, kAtom };

Bond BondOf(const ExpressionNode& node) {
  if (node.op() == Op::kMultiply || node.op() == Op::kDivide) return Bond::kProduct;
  return node.op() == Op::kPower ? Bond::kPower : Bond::kAtom;
}

Bond BondOf(double coefficient, Bond of_term) {
  if (std::signbit(coefficient)) return Bond::kSum;
  return coefficient == 1 ? of_term : std::min(of_term, Bond::kProduct);
}

class Writer {
 public:
  explicit Writer(std::size_t limit) : limit_(limit) {}

  void Sum(const Expression& e) {
    if (Full() || depth_ == kDeepest) {
      full_ = true;
      return;
    }
    ++depth_;
    const auto linear = e.MergedLinear();
    const bool alone = linear.empty() && e.nonlinear().empty();
    bool first = true;
    if (alone || e.constant() > 0) {
      Number(e.constant());
      first = false;
    }
    for (const auto& [variable, coefficient] : linear) {
      if (Full()) break;
      Factor(coefficient, std::exchange(first, false));
      text_ += NameOf(variable);
    }
    for (const auto& [node, coefficient] : e.nonlinear()) {
      if (Full()) break;
      Term(*node, coefficient, std::exchange(first, false));
    }
    if (!alone && !(e.constant() >= 0)) {  // negative, it reads better behind
      Sign(e.constant(), false);
      Number(std::abs(e.constant()));
    }
    --depth_;
  }

  std::string Finish() && {
    if (Full()) {
      text_.resize(std::min(text_.size(), limit_));
      text_ += "...";
    }
    return std::move(text_);
  }

 private:
  static constexpr int kDeepest = 1000;  // calls: text of such a depth is not read

  [[nodiscard]] bool Full() const { return full_ || text_.size() > limit_; }

  void Number(double number) {
    char digits[32];
    text_.append(digits, std::to_chars(digits, digits + sizeof(digits), number).ptr);
  }

  void Sign(double number, bool first) {
    const bool negative = std::signbit(number);
    if (first) {
      text_ += negative ? "-" : "";
    } else {
      text_ += negative ? " - " : " + ";
    }
  }

  // The sign, and the coefficient where it is not 1.
  void Factor(double coefficient, bool first) {
    Sign(coefficient, first);
    if (std::abs(coefficient) == 1) return;
    Number(std::abs(coefficient));
    text_ += "*";
  }

  // coefficient * node; of a quotient 1/b the coefficient is the numerator.
  void Term(const ExpressionNode& node, double coefficient, bool first) {
    if (node.op() == Op::kDivide && HasNoTerms(node.operand(0)) &&
        node.operand(0).constant() == 1) {
      Sign(coefficient, first);
      Number(std::abs(coefficient));
      text_ += "/";
      Inside(node.operand(1), Bond::kPower);
      return;
    }
    Factor(coefficient, first);
    switch (node.op()) {
      case Op::kMultiply:
        return Infix(node, Bond::kProduct, "*", Bond::kProduct);
      case Op::kDivide:
        return Infix(node, Bond::kProduct, "/", Bond::kPower);
      case Op::kPower:
        return Infix(node, Bond::kAtom, "^", Bond::kAtom);
      case Op::kIfPositive:
        return Call("if_then_else", node, " > 0");
      case Op::kIfNonnegative:
        return Call("if_then_else", node, " >= 0");
      default:
        return Call(FactsOf(node.op()).name, node, "");
    }
  }

  void Infix(const ExpressionNode& node, Bond left, const char* sign, Bond right) {
    Inside(node.operand(0), left);
    text_ += sign;
    Inside(node.operand(1), right);
  }

  // "name(first<behind_first>, second, ...)".
  void Call(const char* name, const ExpressionNode& node, const char* behind_first) {
    text_ += name;
    const char* before = "(";
    for (std::size_t i = 0; i < node.operands().size(); ++i) {
      text_ += before;
      Sum(node.operand(i));
      if (i == 0) text_ += behind_first;
      before = ", ";
    }
    text_ += ")";
  }

  // An operand, in brackets where it holds together less than is needed.
  void Inside(const Expression& e, Bond needed) {
    const bool brackets = BondOf(e) < needed;
    if (brackets) text_ += "(";
    Sum(e);
    if (brackets) text_ += ")";
  }

  static Bond BondOf(const Expression& e) {
    const auto linear = e.MergedLinear();
    const std::size_t terms = linear.size() + e.nonlinear().size();
    if (terms == 0) return std::signbit(e.constant()) ? Bond::kSum : Bond::kAtom;
    if (terms > 1 || e.constant() != 0) return Bond::kSum;
    if (!linear.empty()) return switchyard::BondOf(linear.front().coefficient, Bond::kAtom);
    const auto& [node, coefficient] = e.nonlinear().front();
    return switchyard::BondOf(coefficient, switchyard::BondOf(*node));
  }

  std::size_t limit_;
  std::string text_;
  int depth_ = 0;
  bool full_ = false;
};

}  // namespace

std::string Expression::to_string(std::size_t limit) const {
  Writer writer(limit);
  writer.Sum(*this);
  return std::move(writer).Finish();
}

std::ostream& operator<<(std::ostream& out, const Expression& e) { return out << e.to_string(); }

}  // namespace switchyard
