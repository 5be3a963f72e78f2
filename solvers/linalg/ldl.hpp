// solvers/linalg/ldl.hpp - LDL' of a sparse quasi-definite matrix, by whichever way is quickest.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "solvers/linalg/multifrontal_ldl.hpp"
#include "solvers/linalg/simplicial_ldl.hpp"
#include "solvers/linalg/twofold.hpp"

namespace switchyard::linalg {

/// The symbolic part is done once, for a pattern; Factor and Solve follow in any number.
class Ldl {
 public:
  /// `sign`: of each pivot, +1 or -1.
  Ldl(const SymmetricPattern& pattern, const std::vector<std::int8_t>& sign,
      const EliminationWish& wish);
  /// Shares what follows from the pattern; has no factors yet.
  Ldl(const Ldl& other);
  Ldl& operator=(const Ldl&) = delete;
  ~Ldl() = default;

  /// `values`: one for each entry of the pattern; where they are twofold, so are the factors. How
  /// many pivots were raised.
  int Factor(const Numbers& values, const PivotRule& rule, Workers* workers = nullptr);
  /// (high + low) <- A^-1 (high + low); `low` may be absent; plain factors let it be.
  void Solve(double* high, double* low, Workers* workers = nullptr) const;

  /// Did the order respect the groups of the wish?
  [[nodiscard]] bool respects_groups() const { return respects_groups_; }
  [[nodiscard]] double work() const { return work_; }
  [[nodiscard]] double factor_size() const { return factor_size_; }

 private:
  Ldl(Planned planned, const std::vector<std::int8_t>& sign);
  void MakeRoom();

  const std::shared_ptr<const Elimination> elimination_;
  const std::vector<std::int8_t> sign_;
  std::optional<SimplicialLdl> simplicial_;
  std::optional<MultifrontalLdl> fronts_, twofold_;
  Digits digits_ = Digits::kPlain;  // of the latest factors
  mutable Vector high_, low_;       // in the order of elimination
  bool respects_groups_ = false;
  double work_ = 0, factor_size_ = 0;
};

}  // namespace switchyard::linalg
