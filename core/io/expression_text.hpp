// core/io/expression_text.hpp - functions as people write them: "x[0]^2 + exp(x[1])".
#pragma once

#include "core/io/json.hpp"
#include "switchyard/model/program_terms.hpp"

namespace switchyard::io {

/// Writes an expression on a tape and returns the place of its value; x[i] is input i.
///
///   sum     = product { ("+" | "-") product }
///   product = signed { ("*" | "/") signed }
///   signed  = { "-" | "+" } power
///   power   = primary [ "^" signed ]
///   primary = number | "x" "[" integer "]" | "pi" | name "(" sum { "," sum } ")" | "(" sum ")"
///
/// so -x^2 is -(x^2), x^y^z is x^(y^z), and x^-2 needs no brackets. Operations come in the order in
/// which C++ would carry them out. At most 200 brackets and powers deep. Throws FileError at the
/// text, with the column (bytes, from 1).
Tape::Place WriteExpression(JsonValue expression, Tape* tape);

}  // namespace switchyard::io
