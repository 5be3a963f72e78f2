#include "core/io/expression_text.hpp"

#include <array>
#include <charconv>
#include <numbers>

#include "core/io/op_words.hpp"

namespace switchyard::io {
namespace {

using Place = Tape::Place;

constexpr int kMostLevels = 200;
constexpr const char* kPrimary = "a number, x[i], a function or \"(\"";

bool IsDigit(char c) { return c >= '0' && c <= '9'; }
bool IsOfWord(char c) {
  return IsDigit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

class ExpressionParser {
 public:
  ExpressionParser(JsonValue expression, Tape* tape)
      : expression_(expression), text_(expression.String()), tape_(*tape) {}

  Place Parse() {
    const Place place = Sum();
    Next();
    if (at_ < text_.size()) Fail(at_, "an operator, or the end of the text");
    return place;
  }

 private:
  // Entered with every bracket and every power.
  class Level {
   public:
    explicit Level(ExpressionParser* parser) : depth_(parser->depth_) {
      if (++depth_ > kMostLevels) {
        parser->Fail(parser->at_, Text("at most ", kMostLevels, " levels of brackets and powers"),
                     "more");
      }
    }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;
    ~Level() { --depth_; }

   private:
    int& depth_;
  };

  Place Sum();
  Place Product();
  Place Signed();
  Place Power();
  Place Primary();
  Place Number();
  Place Input();
  Place Named();
  Place Call(const OpWords& called);

  // The character that is next behind blanks; '\0' at the end.
  char Next() {
    while (at_ < text_.size() && IsBlank(text_[at_])) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool Takes(char c) {
    if (Next() != c) return false;
    ++at_;
    return true;
  }
  void Expect(char c) {
    if (!Takes(c)) Fail(at_, Text("\"", c, "\""));
  }
  std::string_view TakeWord() {
    const std::size_t start = at_;
    while (at_ < text_.size() && IsOfWord(text_[at_])) ++at_;
    return text_.substr(start, at_ - start);
  }
  [[noreturn]] void Fail(std::size_t at, const std::string& needs) const;
  [[noreturn]] void Fail(std::size_t at, const std::string& needs, const std::string& found) const {
    expression_.Fail(Text(needs, " at column ", at + 1), found);
  }

  JsonValue expression_;
  std::string_view text_;
  Tape& tape_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

// What stands there: a word or number, or one character.
void ExpressionParser::Fail(std::size_t at, const std::string& needs) const {
  if (at >= text_.size()) Fail(at, needs, "the end of the text");
  std::size_t end = at + 1;
  const auto goes_on = [&](char c) {
    if (IsOfWord(text_[at])) return IsOfWord(c) || c == '.';
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;  // of one character in UTF-8
  };
  while (end < text_.size() && goes_on(text_[end])) ++end;
  Fail(at, needs, Quoted(text_.substr(at, end - at)));
}

Place ExpressionParser::Sum() {
  const Level level(this);
  Place sum = Product();
  for (;;) {
    const bool minus = Next() == '-';
    if (!minus && Next() != '+') return sum;
    ++at_;
    const Place term = Product();
    sum = tape_.Apply(minus ? Op::kSubtract : Op::kAdd, sum, term);
  }
}

Place ExpressionParser::Product() {
  Place product = Signed();
  for (;;) {
    const bool over = Next() == '/';
    if (!over && Next() != '*') return product;
    ++at_;
    const Place factor = Signed();
    product = tape_.Apply(over ? Op::kDivide : Op::kMultiply, product, factor);
  }
}

Place ExpressionParser::Signed() {
  bool negative = false;
  for (;; ++at_) {
    if (Next() == '-') {
      negative = !negative;
    } else if (Next() != '+') {
      break;
    }
  }
  const Place power = Power();
  return negative ? tape_.Apply(Op::kNegate, power) : power;
}

Place ExpressionParser::Power() {
  const Place base = Primary();
  if (!Takes('^')) return base;
  const Level level(this);
  const Place exponent = Signed();
  return tape_.Apply(Op::kPower, base, exponent);
}

Place ExpressionParser::Primary() {
  const char c = Next();
  if (IsDigit(c) || c == '.') return Number();
  if (IsOfWord(c)) return Named();
  if (!Takes('(')) Fail(at_, kPrimary);
  const Place inside = Sum();
  Expect(')');
  return inside;
}

Place ExpressionParser::Number() {
  double value = 0;
  const char* const end = text_.data() + text_.size();
  const auto [behind, error] = std::from_chars(text_.data() + at_, end, value);
  if (error == std::errc::result_out_of_range) Fail(at_, "a number that a double can hold");
  if (error != std::errc()) Fail(at_, kPrimary);
  at_ = static_cast<std::size_t>(behind - text_.data());
  return tape_.Constant(value);
}

Place ExpressionParser::Named() {
  const std::size_t start = at_;
  const std::string_view word = TakeWord();
  if (word == "x") return Input();
  if (word == "pi") return tape_.Constant(std::numbers::pi);
  if (const OpWords* called = OpCalled(word, &OpWords::call)) return Call(*called);
  std::vector<std::string_view> names = WordsOf(&OpWords::call);
  std::string list = "x[i], pi";
  for (const std::string_view name : names) list += Text(", ", name);
  names.push_back("pi");
  Fail(start, "a name that is known (" + list + ")", QuotedWithNearest(word, names));
}

Place ExpressionParser::Input() {
  Expect('[');
  const int inputs = tape_.num_inputs();
  Next();
  int index = -1;
  const char* const end = text_.data() + text_.size();
  const auto [behind, error] = std::from_chars(text_.data() + at_, end, index);
  if (error != std::errc() || index < 0 || index >= inputs) {
    const std::string_view rest = text_.substr(at_);
    Fail(at_,
         inputs > 0 ? Text("the number of an argument from 0 to ", inputs - 1)
                    : "the number of an argument (there is none)",
         rest.empty() ? "the end of the text" : Quoted(rest.substr(0, rest.find(']'))));
  }
  at_ = static_cast<std::size_t>(behind - text_.data());
  Expect(']');
  return index;
}

Place ExpressionParser::Call(const OpWords& called) {
  std::array<Place, 2> argument = {-1, -1};
  const int count = NumOperands(called.op);
  Expect('(');
  for (int k = 0; k < count; ++k) {
    if (k > 0 && !Takes(',')) Fail(at_, Text("\",\" and argument ", k + 1, " of ", called.call));
    argument[static_cast<std::size_t>(k)] = Sum();
  }
  Expect(')');
  return count == 1 ? tape_.Apply(called.op, argument[0])
                    : tape_.Apply(called.op, argument[0], argument[1]);
}

}  // namespace

Place WriteExpression(JsonValue expression, Tape* tape) {
  return ExpressionParser(expression, tape).Parse();
}

}  // namespace switchyard::io
