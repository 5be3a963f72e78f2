#include "solvers/rounding/option_values.hpp"

#include <sstream>

#include "switchyard/plugin.hpp"

namespace switchyard::rounding {

void RefuseValue(const sy_option& row, const std::string& need, const sy_value& value) {
  std::ostringstream text;
  text << "option " << row.name << " " << need << "; ";
  if (value.type == SY_TEXT) text << "'" << (value.as.text != nullptr ? value.as.text : "") << "'";
  if (value.type == SY_REAL) text << value.as.real;
  if (value.type == SY_INTEGER) text << value.as.integer;
  text << " came";
  throw plugin::Failure(SY_E_ARGUMENT, text.str());
}

double NumberOf(const sy_option& row, const sy_value& value) {
  const bool real = row.fallback.type == SY_REAL;
  if (value.type != SY_INTEGER && !(real && value.type == SY_REAL)) {
    RefuseValue(row, real ? "takes a real number" : "takes an integer", value);
  }
  const double number =
      value.type == SY_REAL ? value.as.real : static_cast<double>(value.as.integer);
  if (!(number >= row.lower && number <= row.upper)) {
    std::ostringstream need;
    need << "lies in [" << row.lower << ", " << row.upper << "]";
    RefuseValue(row, need.str(), value);
  }
  return number;
}

std::string TextOf(const sy_option& row, const sy_value& value) {
  if (value.type != SY_TEXT || value.as.text == nullptr) RefuseValue(row, "takes a text", value);
  if (row.choices == nullptr) return value.as.text;
  std::string all;
  for (const char* const* choice = row.choices; *choice != nullptr; ++choice) {
    if (std::string(*choice) == value.as.text) return value.as.text;
    all += (all.empty() ? "" : ", ") + std::string(*choice);
  }
  RefuseValue(row, "is one of " + all, value);
}

}  // namespace switchyard::rounding
