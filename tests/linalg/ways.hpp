// tests/linalg/ways.hpp - all factorizations by one interface.
#pragma once

#include <memory>
#include <ostream>
#include <vector>

#include "solvers/linalg/block_ldl.hpp"
#include "solvers/linalg/ldl.hpp"
#include "tests/linalg/matrices.hpp"

namespace switchyard::linalg {

class Factors {
 public:
  virtual ~Factors() = default;
  virtual int Factor(const Numbers& values, const PivotRule& rule) = 0;
  virtual void Solve(const NumbersOf<double>& b) const = 0;
};

/// One that works in the order of elimination.
template <class F>
class InOrder : public Factors {
 public:
  template <class... More>
  InOrder(Elimination elimination, const Signs& sign, More... more)
      : elimination_(std::move(elimination)), factors_(elimination_, sign, more...) {}

  int Factor(const Numbers& values, const PivotRule& rule) override {
    if constexpr (std::is_same_v<F, SimplicialLdl>) {
      return factors_.Factor(values.high, rule);
    } else {
      return factors_.Factor(values, rule);
    }
  }
  void Solve(const NumbersOf<double>& b) const override {
    std::vector<double> high, low;
    for (const Index j : elimination_.order) {
      high.push_back(b.high[j]);
      if (b.low != nullptr) low.push_back(b.low[j]);
    }
    const std::size_t n = high.size();
    if constexpr (std::is_same_v<F, SimplicialLdl>) {
      factors_.Solve(high.data());
    } else {
      high.resize(static_cast<std::size_t>(factors_.room()));
      low.resize(high.size());
      factors_.Solve({high.data(), b.low != nullptr ? low.data() : nullptr});
    }
    for (std::size_t k = 0; k < n; ++k) {
      b.high[elimination_.order[k]] = high[k];
      if (b.low != nullptr) b.low[elimination_.order[k]] = low[k];
    }
  }

 private:
  const Elimination elimination_;
  F factors_;
};

class ByLdl : public Factors {
 public:
  ByLdl(const SymmetricPattern& pattern, const Signs& sign) : ldl_(pattern, sign, {}) {}
  int Factor(const Numbers& values, const PivotRule& rule) override {
    return ldl_.Factor(values, rule);
  }
  void Solve(const NumbersOf<double>& b) const override { ldl_.Solve(b.high, b.low); }

 private:
  Ldl ldl_;
};

class ByBlocks : public Factors {
 public:
  ByBlocks(const SymmetricPattern& pattern, const Signs& sign, const std::vector<Index>& block,
           Index count)
      : ldl_(pattern, sign, {}, block, count) {}
  int Factor(const Numbers& values, const PivotRule& rule) override {
    return ldl_.Factor(values, rule);
  }
  void Solve(const NumbersOf<double>& b) const override { ldl_.Solve(b); }

 private:
  BlockLdl ldl_;
};

struct Way {
  const char* name;
  Digits digits;
  bool in_order;  // takes the given one, but for its postorder
  std::unique_ptr<Factors> (*make)(const SymmetricPattern&, const Signs&,
                                   const std::vector<Index>& order);
  bool rest_apart = false;  // from a block
};

inline std::ostream& operator<<(std::ostream& out, const Way& w) { return out << w.name; }

inline const std::vector<Way>& Ways() {
  using P = const SymmetricPattern&;
  using S = const Signs&;
  using O = const std::vector<Index>&;
  using Made = std::unique_ptr<Factors>;
  const auto simplicial = [](P p, S s, O o) -> Made {
    return std::make_unique<InOrder<SimplicialLdl>>(Eliminate(p, o), s);
  };
  const auto plain = [](P p, S s, O o) -> Made {
    return std::make_unique<InOrder<MultifrontalLdl>>(Eliminate(p, o), s, Digits::kPlain);
  };
  const auto twofold = [](P p, S s, O o) -> Made {
    return std::make_unique<InOrder<MultifrontalLdl>>(Eliminate(p, o), s, Digits::kTwofold);
  };
  const auto chosen = [](P p, S s, O) -> Made { return std::make_unique<ByLdl>(p, s); };
  const auto no_blocks = [](P p, S s, O) -> Made {
    return std::make_unique<ByBlocks>(p, s, std::vector<Index>(p.n, -1), 0);
  };
  static const std::vector<Way> ways = {
      {"simplicial", Digits::kPlain, true, simplicial},
      {"fronts", Digits::kPlain, true, plain},
      {"twofold_fronts", Digits::kTwofold, true, twofold},
      {"chosen", Digits::kPlain, false, chosen},
      {"twofold_chosen", Digits::kTwofold, false, chosen},
      {"no_blocks", Digits::kPlain, false, no_blocks},
      {"twofold_no_blocks", Digits::kTwofold, false, no_blocks},
  };
  return ways;
}

/// A x = b by factors of plain or twofold digits: the leading parts.
inline Eigen::VectorXd SolveBy(const Factors& factors, Digits digits, Eigen::VectorXd b) {
  std::vector<double> low(b.size(), 0.0);
  factors.Solve({b.data(), digits == Digits::kTwofold ? low.data() : nullptr});
  return b;
}

}  // namespace switchyard::linalg
