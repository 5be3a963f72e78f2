#include "core/model/convexity.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace switchyard {
namespace {

constexpr double kShift = 1e-12;    // relative to the largest entry of a component
constexpr int kLargestDense = 300;  // rows; a dense factorization of that many is a millisecond

std::size_t At(int i) { return static_cast<std::size_t>(i); }

// A partition of 0 .. n-1 into sets, each a tree that leads to its root.
class DisjointSets {
 public:
  explicit DisjointSets(int n) : parent_(At(n)) { std::iota(parent_.begin(), parent_.end(), 0); }
  int Root(int i) {
    while (parent_[At(i)] != i) i = parent_[At(i)] = parent_[At(parent_[At(i)])];
    return i;
  }
  void Join(int i, int j) { parent_[At(Root(i))] = Root(j); }

 private:
  std::vector<int> parent_;
};

struct Components {
  std::vector<int> start;   // of each component in `member`, and the end
  std::vector<int> member;  // ascending in each
  std::vector<int> place;   // of each index within its component
};

Components ConnectedComponents(const SparseMatrix& Q) {
  const int n = static_cast<int>(Q.cols());
  DisjointSets sets(n);
  for (int j = 0; j < n; ++j) {
    for (SparseMatrix::InnerIterator it(Q, j); it && it.row() < j; ++it) {
      if (it.value() != 0) sets.Join(static_cast<int>(it.row()), j);
    }
  }
  std::vector<int> number(At(n), -1);  // of a root's component
  Components c{{0}, std::vector<int>(At(n)), std::vector<int>(At(n))};
  for (int j = 0; j < n; ++j) {
    int& k = number[At(sets.Root(j))];
    if (k < 0) {
      k = static_cast<int>(c.start.size()) - 1;
      c.start.push_back(0);
    }
    c.place[At(j)] = c.start[At(k) + 1]++;
  }
  std::partial_sum(c.start.begin(), c.start.end(), c.start.begin());
  for (int j = 0; j < n; ++j) {
    c.member[At(c.start[At(number[At(sets.Root(j))])] + c.place[At(j)])] = j;
  }
  return c;
}

// The rows and columns of component k, with its shift on the diagonal.
std::vector<Eigen::Triplet<double>> ShiftedBlock(const SparseMatrix& Q, const Components& c,
                                                 int k) {
  std::vector<Eigen::Triplet<double>> entries;
  double largest = 0;
  for (int m = c.start[At(k)]; m < c.start[At(k) + 1]; ++m) {
    const int j = c.member[At(m)];
    for (SparseMatrix::InnerIterator it(Q, j); it; ++it) {
      if (it.value() == 0) continue;
      entries.emplace_back(c.place[At(static_cast<int>(it.row()))], c.place[At(j)], it.value());
      largest = std::max(largest, std::abs(it.value()));
    }
  }
  const int n = c.start[At(k) + 1] - c.start[At(k)];
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, kShift * largest);
  return entries;
}

bool HasCholesky(int n, const std::vector<Eigen::Triplet<double>>& entries) {
  if (n > kLargestDense) {
    SparseMatrix B(n, n);
    B.setFromTriplets(entries.begin(), entries.end());
    return Eigen::SimplicialLLT<SparseMatrix>(B).info() == Eigen::Success;
  }
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(n, n);
  for (const auto& e : entries) B(e.row(), e.col()) += e.value();
  return Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>>(B).info() == Eigen::Success;
}

}  // namespace

bool IsPositiveSemidefinite(const SparseMatrix& Q) {
  const Components c = ConnectedComponents(Q);
  for (int k = 0; k + 1 < static_cast<int>(c.start.size()); ++k) {
    const int n = c.start[At(k) + 1] - c.start[At(k)];
    const int first = c.member[At(c.start[At(k)])];
    if (n == 1 ? Q.coeff(first, first) < 0 : !HasCholesky(n, ShiftedBlock(Q, c, k))) return false;
  }
  return true;
}

SparseMatrix SymmetricPart(const SparseMatrix& Q) {
  const SparseMatrix transposed = Q.transpose();
  return 0.5 * Q + 0.5 * transposed;
}

}  // namespace switchyard
