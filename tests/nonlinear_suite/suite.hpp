// suite.hpp - nonlinear programs with known answers, written from published mathematics.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "switchyard/model/program.hpp"

namespace switchyard::testing {

inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// The hardest kind of condition that a program has.
enum class Conditions { kNone, kBounds, kInequalities, kEqualities };

/// What is true of it.
enum class Answer {
  kOptimum,     // it has one, of a known value
  kInfeasible,  // no point satisfies it
  kUnbounded    // its objective falls (or, maximized, grows) for ever
};

enum Tag : unsigned {
  kConvex = 1U << 0,          // and every term says so: a local optimum is the optimum
  kBox = 1U << 1,             // every variable has two finite bounds
  kUndefinedStart = 1U << 2,  // a value or derivative is not finite where it starts
  kNoMultipliers = 1U << 3,   // no dual variables satisfy the conditions of first order
  kManyRows = 1U << 4         // twenty nonlinear rows
};

/// A row of the suite.
struct KnownProgram {
  std::string name;
  std::string source;
  Conditions conditions = Conditions::kNone;
  unsigned tags = 0;
  Answer answer = Answer::kOptimum;
  double optimum = kNoValue;  // in the program's sense
  std::vector<double> start;
  std::unique_ptr<MathematicalProgram> (*terms)() = nullptr;
  std::vector<double> local_optima = {};  // values of other points where a solver may end

  [[nodiscard]] bool Is(Tag tag) const { return (tags & tag) != 0; }
};

/// All of them; no two of one name.
const std::vector<KnownProgram>& Suite();
/// The program of a row, named, with its start as the initial guess.
std::unique_ptr<MathematicalProgram> Make(const KnownProgram& row);

/// The parts of the suite.
std::vector<KnownProgram> HockSchittkowskiOfFewVariables();  // two or three
std::vector<KnownProgram> HockSchittkowskiOfManyVariables();
std::vector<KnownProgram> Classics();
std::vector<KnownProgram> AwkwardPrograms();  // without an optimum, or not everywhere defined

}  // namespace switchyard::testing
