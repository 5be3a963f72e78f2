#include "core/gcs/fixed_ends.hpp"

#include <algorithm>
#include <cmath>

namespace switchyard {
namespace {

constexpr int kRounds = 4;
constexpr double kRounding = 1e-13;  // relative, of what a side was computed from
constexpr double kWidth = 1e-9;      // relative, of a coordinate: more is no matter of rounding

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

class Propagation {
 public:
  Propagation(const SetBox& u, const SetBox& v) {
    for (const SetBox* box : {&u, &v}) {
      lower_.insert(lower_.end(), box->lower.data(), box->lower.data() + box->lower.size());
      upper_.insert(upper_.end(), box->upper.data(), box->upper.data() + box->upper.size());
    }
  }

  std::vector<FixedCoordinate> Run(std::span<const PlacedBlock> blocks) {
    for (int round = 0; round < kRounds && !contradiction_; ++round) {
      moved_ = false;
      for (const PlacedBlock& of : blocks) {
        for (std::int32_t i = 0; i < of.block->rows.count(); ++i) See(of, At(i));
      }
      if (!moved_) break;
    }
    std::vector<FixedCoordinate> fixed;
    for (std::size_t j = 0; j < lower_.size() && !contradiction_; ++j) {
      if (Width(j) == 0) fixed.push_back({static_cast<std::int32_t>(j), lower_[j]});
    }
    return fixed;
  }

 private:
  struct Term {
    std::size_t j;
    double a;
  };

  [[nodiscard]] double Width(std::size_t j) const { return upper_[j] - lower_[j]; }

  // lower - a_t <= sum of a_j x_j <= upper - a_t. A row with a variable that has no box says
  // nothing.
  void See(const PlacedBlock& of, std::size_t row) {
    const TermBlock& block = *of.block;
    terms_.clear();
    double constant = 0;
    for (auto k = At(block.rows.start[row]); k < At(block.rows.start[row + 1]); ++k) {
      const std::int32_t place = block.rows.place[k];
      if (place == 0) {
        constant += block.rows.value[k];
        continue;
      }
      const std::size_t j = At(of.first + place - 1);
      if (place >= block.num_places || j >= lower_.size()) return;
      terms_.push_back({j, block.rows.value[k]});
    }
    if (std::isfinite(block.upper[row])) Below(block.upper[row] - constant, 1);
    if (std::isfinite(block.lower[row])) Below(constant - block.lower[row], -1);
  }

  // sum of sign a_j x_j <= side: each term is at most what the others' least leaves.
  void Below(double side, double sign) {
    double least = 0, size = std::abs(side);
    int open = 0;
    std::size_t open_at = 0;
    for (const Term& t : terms_) {
      const double end = sign * t.a > 0 ? lower_[t.j] : upper_[t.j];
      if (std::isinf(end)) {
        ++open;
        open_at = t.j;
        continue;
      }
      least += sign * t.a * end;
      size += std::abs(t.a * end);
    }
    if (open > 1) return;
    for (const Term& t : terms_) {
      if (open == 1 && t.j != open_at) continue;
      const double a = sign * t.a;
      const double own = open == 1 ? 0 : a * (a > 0 ? lower_[t.j] : upper_[t.j]);
      const double end = (side - (least - own)) / a;
      Tighten(t.j, end, a > 0, kRounding * size / std::abs(a));
    }
  }

  void Tighten(std::size_t j, double end, bool is_upper, double rounding) {
    double& mine = is_upper ? upper_[j] : lower_[j];
    const double other = is_upper ? lower_[j] : upper_[j];
    const double sign = is_upper ? 1 : -1;
    const double width = kWidth * (1 + std::abs(other));
    if (rounding > width) return;  // beside the others' the coefficient is next to nothing
    if (sign * (mine - end) <= rounding) return;
    if (sign * (end - other) <= rounding) {
      if (sign * (other - end) > width) contradiction_ = true;
      end = other;  // no width is left but by rounding
    }
    moved_ = true;
    mine = end;
  }

  std::vector<double> lower_, upper_;
  std::vector<Term> terms_;
  bool moved_ = false;
  bool contradiction_ = false;
};

}  // namespace

std::vector<FixedCoordinate> FixedEnds(const SetBox& u, const SetBox& v,
                                       std::span<const PlacedBlock> blocks) {
  return Propagation(u, v).Run(blocks);
}

}  // namespace switchyard
