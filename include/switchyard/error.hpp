// switchyard/error.hpp - how a caller's mistake is said: the thing, the need and what came.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "switchyard/export.hpp"

namespace switchyard {

/// The caller's mistake, thrown by the call that made it.
class SWITCHYARD_EXPORT InvalidArgument : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

template <class... Parts>
std::string Text(const Parts&... parts) {
  std::ostringstream text;
  text.precision(12);
  (text << ... << parts);
  return text.str();
}

template <class... Parts>
[[noreturn]] void Refuse(const Parts&... parts) {
  throw InvalidArgument(Text(parts...));
}

/// Throws InvalidArgument with the text that `parts` make, where `holds` is false.
template <class... Parts>
void Require(bool holds, const Parts&... parts) {
  if (!holds) [[unlikely]] {
    Refuse(parts...);
  }
}

/// The distance-nearest of `names` to a misspelt one, or "" where none is near.
SWITCHYARD_EXPORT std::string NearestName(const std::string& wrong,
                                          const std::vector<std::string>& names);

}  // namespace switchyard
