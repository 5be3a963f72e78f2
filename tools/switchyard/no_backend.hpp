// tools/switchyard/no_backend.hpp - a backend was named that is not there.
#pragma once

#include <stdexcept>

namespace switchyard::cli {

/// Ends a command with kNotAnswered.
class NoBackend : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace switchyard::cli
