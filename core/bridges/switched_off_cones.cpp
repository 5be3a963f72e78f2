// Cones that an update switched off are left out; their duals are 0. Not a row of the table: it
// removes no feature, and comes first where a backend cannot switch cones itself.
#include <cmath>

#include "core/bridges/bridges.hpp"
#include "switchyard/problem_update.hpp"

namespace switchyard {
namespace {

class SwitchedOffBridge final : public Bridge {
 public:
  explicit SwitchedOffBridge(std::vector<std::uint8_t> kept) : kept_(std::move(kept)) {}

  void Back(Vectors& v) const override {
    std::vector<double> all(kept_.size(), 0.0);
    std::size_t from = 0;
    for (std::size_t i = 0; i < all.size() && from < v.cone_dual.size(); ++i) {
      if (kept_[i] != 0) all[i] = v.cone_dual[from++];
    }
    v.cone_dual = std::move(all);
  }

  void Forward(Vectors& v) const override {
    if (!v.cone_dual.empty()) v.cone_dual = Keep(v.cone_dual, kept_);
  }

 private:
  std::vector<std::uint8_t> kept_;  // of each cone row
};

}  // namespace

Bridged LeaveOutSwitchedOff(ProblemData d) {
  std::vector<std::uint8_t> kept;
  for (std::size_t c = 0; c < d.cones.size(); ++c) {
    kept.insert(kept.end(), static_cast<std::size_t>(d.cones[c].dim), d.cone_on[c]);
  }
  const std::vector<std::uint8_t> on = d.cone_on;
  problem_detail::KeepCones(on, d);
  d.cone_on.clear();
  return {std::move(d), std::make_unique<SwitchedOffBridge>(std::move(kept))};
}

}  // namespace switchyard
