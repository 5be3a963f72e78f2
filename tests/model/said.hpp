// tests/model/said.hpp - what a call that must throw said.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "switchyard/error.hpp"

namespace switchyard {

template <class Call>
std::string Said(Call&& call) {
  try {
    call();
  } catch (const InvalidArgument& e) {
    return e.what();
  }
  return "(nothing was thrown)";
}

}  // namespace switchyard
