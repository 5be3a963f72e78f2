// algorithms.hpp - what each algorithm of NLopt needs and takes, and how they are put inside each
// other.
#pragma once

#include <nlopt.h>

#include <string_view>
#include <vector>

namespace switchyard::nlopt {

enum : unsigned {
  kGradients = 1U << 0,     // asks for derivatives
  kGlobal = 1U << 1,        // searches a whole box, which must be finite, until it is told to stop
  kInequalities = 1U << 2,  // takes constraints itself
  kEqualities = 1U << 3,
  kTwoVariables = 1U << 4,  // at the least
  kInnerWithout = 1U << 5,  // works through a local optimizer that asks for no derivatives,
  kInnerWith = 1U << 6      // or through one that does
};

/// A row of the table.
struct Algorithm {
  nlopt_algorithm id;
  unsigned bits;

  [[nodiscard]] bool Is(unsigned bit) const { return (bits & bit) != 0; }
  [[nodiscard]] const char* name() const { return nlopt_algorithm_to_string(id); }
};

const Algorithm& FactsOf(nlopt_algorithm id);

/// The algorithm of NLopt's name for it, letter for letter, as the value of `option`. Throws
/// Failure where there is none, with the nearest name, and where the NLopt that is here was built
/// without it.
const Algorithm& AlgorithmNamed(std::string_view option, std::string_view name);

/// What a program brings to an algorithm.
struct Demand {
  bool gradients = false;
  bool equalities = false;
  bool inequalities = false;
  std::size_t num_vars = 0;
};

/// From the outside in: each algorithm is the local optimizer of the one before. Around one that
/// does not take what the program has stands the augmented Lagrangian; inside one that works
/// through a local optimizer stands `local`, or one that fits where that is NULL.
std::vector<nlopt_algorithm> Nest(const Algorithm& algorithm, const Algorithm* local,
                                  const Demand& demand);

/// The bits of all of them.
unsigned BitsOf(const std::vector<nlopt_algorithm>& nest);

/// Is the bit set for one of them?
inline bool AnyIs(const std::vector<nlopt_algorithm>& nest, unsigned bit) {
  return (BitsOf(nest) & bit) != 0;
}

}  // namespace switchyard::nlopt
