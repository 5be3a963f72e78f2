#include "core/linalg/semidefinite_factor.hpp"

#include <Eigen/Core>
#include <cmath>
#include <numeric>
#include <vector>

namespace switchyard {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

std::int32_t Root(std::vector<std::int32_t>& parent, std::int32_t j) {
  while (parent[At(j)] != j) {
    auto& up = parent[At(j)];
    up = parent[At(up)];
    j = up;
  }
  return j;
}

/// The variables of each connected component of P that has an entry.
std::vector<std::vector<std::int32_t>> Components(const Csc& P) {
  std::vector<std::int32_t> parent(At(P.cols));
  std::iota(parent.begin(), parent.end(), 0);
  std::vector<std::uint8_t> used(parent.size(), 0);
  for (std::int32_t j = 0; j < P.cols; ++j) {
    for (auto k = P.start[At(j)]; k < P.start[At(j) + 1]; ++k) {
      const std::int32_t i = P.row[At(k)];
      used[At(i)] = used[At(j)] = 1;
      parent[At(Root(parent, i))] = Root(parent, j);
    }
  }
  std::vector<std::vector<std::int32_t>> members(parent.size());
  for (std::int32_t j = 0; j < P.cols; ++j) {
    if (used[At(j)] != 0) members[At(Root(parent, j))].push_back(j);
  }
  std::erase_if(members, [](const auto& component) { return component.empty(); });
  return members;
}

/// Appends to `transposed`, whose columns are the rows of S, those of the component's factor.
std::optional<NegativePivot> FactorComponent(const Csc& P, const std::vector<std::int32_t>& members,
                                             std::vector<std::int32_t>& local, Csc& transposed) {
  const auto n = static_cast<Eigen::Index>(members.size());
  for (std::size_t k = 0; k < members.size(); ++k) {
    local[At(members[k])] = static_cast<std::int32_t>(k);
  }
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(n, n);
  for (const std::int32_t j : members) {
    for (auto k = At(P.start[At(j)]); k < At(P.start[At(j) + 1]); ++k) {
      const auto a = local[At(P.row[k])];
      const auto b = local[At(j)];
      block(a, b) = block(b, a) = P.value[k];
    }
  }
  const double scale = block.cwiseAbs().maxCoeff();
  for (Eigen::Index p = 0; block.diagonal().maxCoeff(&p) > 1e-14 * scale;) {
    const Eigen::VectorXd s = block.col(p) / std::sqrt(block(p, p));
    for (Eigen::Index c = 0; c < n; ++c) {
      if (s[c] == 0) continue;
      transposed.row.push_back(members[static_cast<std::size_t>(c)]);
      transposed.value.push_back(s[c]);
    }
    transposed.start.push_back(static_cast<std::int32_t>(transposed.row.size()));
    block.noalias() -= s * s.transpose();
    block.row(p).setZero();  // what rounding left of it is not a pivot again
    block.col(p).setZero();
  }
  if (block.cwiseAbs().maxCoeff() <= 1e-9 * scale) return std::nullopt;
  return NegativePivot{block.diagonal().minCoeff(), members.front()};
}

}  // namespace

SemidefiniteFactor FactorSemidefinite(const Csc& P) {
  SemidefiniteFactor factor;
  Csc transposed(P.cols, 0);
  std::vector<std::int32_t> local(At(P.cols), 0);
  for (const auto& component : Components(P)) {
    factor.not_semidefinite = FactorComponent(P, component, local, transposed);
    if (factor.not_semidefinite.has_value()) return factor;
  }
  transposed.cols = static_cast<std::int32_t>(transposed.start.size()) - 1;
  factor.S = Transpose(transposed.View());
  return factor;
}

}  // namespace switchyard
