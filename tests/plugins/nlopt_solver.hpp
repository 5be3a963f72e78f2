// nlopt_solver.hpp - the plugin of NLopt with options, from a start.
#pragma once

#include <string>

#include "nonlinear_programs.hpp"

namespace switchyard::test {

/// NULL where it is not built.
inline const Named* Nlopt() {
  static const std::vector<Named> all = AllSolvers();
  const auto found =
      std::find_if(all.begin(), all.end(), [](const Named& n) { return n.name == "nlopt"; });
  return found != all.end() ? &*found : nullptr;
}

/// A solver with these options.
class Configured : public BareSolver {
 public:
  explicit Configured(const char* algorithm) : BareSolver(*Nlopt()) {
    Text("algorithm", algorithm);
  }

  Configured& Text(const char* name, const char* text) {
    sy_value value = {SY_TEXT, 0, {}};
    value.as.text = text;
    EXPECT_EQ(SetOption(name, value), SY_OK) << error().text;
    return *this;
  }
  Configured& Integer(const char* name, std::int64_t number) {
    sy_value value = {SY_INTEGER, 0, {}};
    value.as.integer = number;
    EXPECT_EQ(SetOption(name, value), SY_OK) << error().text;
    return *this;
  }
  NonlinearAnswer From(const HandWritten& program, const Vector& x,
                       const sy_control& control = Freely()) {
    Load(program.problem());
    if (!x.empty()) {
      sy_start start = {};
      start.size = sizeof start;
      start.x = x.data();
      WarmStart(start);
    }
    return test::Solve(*this, program, control);
  }
};

}  // namespace switchyard::test
