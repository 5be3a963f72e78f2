// tests/ipopt/random_kkt.hpp - augmented systems of an interior-point method, sparse and dense.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <vector>

#include "ipopt/condensed_kkt.hpp"

namespace switchyard::testing {

/// Columns are x, s, y_c, y_d: see CondensedKkt.
struct Kkt {
  ipopt::CondensedKkt::Entries entries;
  ipopt::CondensedKkt::Counts counts;
  std::vector<double> values;
  Eigen::MatrixXd dense;

  Kkt(int variables, int equations, int inequalities)
      : counts{equations, inequalities}, variables_(variables) {
    entries.n = variables + 2 * inequalities + equations;
    dense.setZero(entries.n, entries.n);
    for (int i = 0; i < inequalities; ++i) Add(y_d(i), s(i), -1);
  }
  [[nodiscard]] int s(int i) const { return variables_ + i; }
  [[nodiscard]] int y_c(int i) const { return s(counts.inequalities) + i; }
  [[nodiscard]] int y_d(int i) const { return y_c(counts.equations) + i; }

  void Add(int i, int j, double value) {
    entries.row.push_back(i);
    entries.col.push_back(j);
    values.push_back(value);
    dense(i, j) += value;
    if (i != j) dense(j, i) += value;
  }

 private:
  int variables_;
};

/// Of what random systems have.
struct KktKind {
  double density = 0.2;         // of H, J_c and J_d
  double delta_x = 0;           // to H
  double delta = 0;             // -delta in the diagonal of y_c and y_d
  double empty_rows = 0;        // share of the inequalities
  double orders_of_size = 1.5;  // standard deviation of log10 of D_x and D_s
};

class RandomKkt {
 public:
  explicit RandomKkt(unsigned seed) : engine_(seed) {}

  double Normal() { return normal_(engine_); }
  bool Chance(double share) { return uniform_(engine_) < share; }
  double Positive(double orders) { return std::pow(10, orders * Normal()); }

  Kkt Make(int variables, int equations, int inequalities, const KktKind& kind) {
    Kkt kkt(variables, equations, inequalities);
    for (int i = 0; i < variables; ++i) {
      for (int j = 0; j < i; ++j) {
        if (Chance(kind.density)) kkt.Add(i, j, Normal());
      }
      kkt.Add(i, i, Normal());
      kkt.Add(i, i, kind.delta_x + (Chance(0.5) ? Positive(kind.orders_of_size) : 0));
    }
    const auto fill = [&](int row) {
      for (int j = 0; j < variables; ++j) {
        if (Chance(kind.density)) kkt.Add(row, j, Normal());
      }
    };
    for (int i = 0; i < equations; ++i) {
      fill(kkt.y_c(i));
      kkt.Add(kkt.y_c(i), i, 2);
      kkt.Add(kkt.y_c(i), kkt.y_c(i), -kind.delta);
    }
    for (int i = 0; i < inequalities; ++i) {
      kkt.Add(kkt.s(i), kkt.s(i), Positive(kind.orders_of_size));
      if (!Chance(kind.empty_rows)) fill(kkt.y_d(i));
      kkt.Add(kkt.y_d(i), kkt.y_d(i), -kind.delta);
    }
    return kkt;
  }

 private:
  std::mt19937 engine_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
};

}  // namespace switchyard::testing
