// core/io/op_words.hpp - what files call the elementary operations.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "switchyard/model/program_terms.hpp"

namespace switchyard::io {

/// `step` stands in lists of steps, `call` in expressions; empty: the operation has no such word.
struct OpWords {
  Op op;
  std::string_view step;
  std::string_view call = {};
};

/// A new operation is a row; its words stay, whatever messages call it.
constexpr std::array kOpWords = {
    OpWords{Op::kConstant, "constant"},
    OpWords{Op::kInput, ""},
    OpWords{Op::kAdd, "add"},
    OpWords{Op::kSubtract, "subtract"},
    OpWords{Op::kMultiply, "multiply"},
    OpWords{Op::kDivide, "divide"},
    OpWords{Op::kNegate, "negate"},
    OpWords{Op::kSqrt, "sqrt", "sqrt"},
    OpWords{Op::kExp, "exp", "exp"},
    OpWords{Op::kLog, "log", "log"},
    OpWords{Op::kSin, "sin", "sin"},
    OpWords{Op::kCos, "cos", "cos"},
    OpWords{Op::kTan, "tan", "tan"},
    OpWords{Op::kAsin, "asin", "asin"},
    OpWords{Op::kAcos, "acos", "acos"},
    OpWords{Op::kAtan, "atan", "atan"},
    OpWords{Op::kSinh, "sinh", "sinh"},
    OpWords{Op::kCosh, "cosh", "cosh"},
    OpWords{Op::kTanh, "tanh", "tanh"},
    OpWords{Op::kAbs, "abs", "abs"},
    OpWords{Op::kFloor, "floor", "floor"},
    OpWords{Op::kCeil, "ceil", "ceil"},
    OpWords{Op::kPower, "power", "pow"},
    OpWords{Op::kAtan2, "atan2", "atan2"},
    OpWords{Op::kMin, "min", "min"},
    OpWords{Op::kMax, "max", "max"},
    OpWords{Op::kIfPositive, "if positive"},
    OpWords{Op::kIfNonnegative, "if nonnegative"},
};
static_assert([] {
  for (std::size_t i = 0; i < kOpWords.size(); ++i) {
    if (kOpWords[i].op != static_cast<Op>(i)) return false;
  }
  return kOpWords.back().op == Op::kIfNonnegative;
}());

/// The row whose `column` is the word; null where there is none.
inline const OpWords* OpCalled(std::string_view word, std::string_view OpWords::*column) {
  const auto found = std::find_if(kOpWords.begin(), kOpWords.end(), [&](const OpWords& row) {
    return !word.empty() && row.*column == word;
  });
  return found == kOpWords.end() ? nullptr : &*found;
}

/// The words of a column, for messages.
inline std::vector<std::string_view> WordsOf(std::string_view OpWords::*column) {
  std::vector<std::string_view> words;
  for (const OpWords& row : kOpWords) {
    if (!(row.*column).empty()) words.push_back(row.*column);
  }
  return words;
}

}  // namespace switchyard::io
