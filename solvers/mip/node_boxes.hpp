// solvers/mip/node_boxes.hpp - the boxes of a node's variables, with a trail of their changes, so
// that plunging, strong branching and probing go back to where they were.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "switchyard/boxes.hpp"

namespace switchyard::mip {

/// What leaves no point in the boxes, by more than rounding.
struct Contradiction {
  enum class Source : std::uint8_t { kNone, kVariable, kRow, kCone, kGroup, kCutoff };
  Source source = Source::kNone;
  std::int32_t index = -1;  // of the variable, row, cone or group

  explicit operator bool() const { return source != Source::kNone; }
  /// "x[3]", "row[3]", "cone[3]", "group[3]", "cutoff"; "" for none.
  [[nodiscard]] std::string Name() const {
    constexpr const char* kNames[] = {"", "x", "row", "cone", "group", "cutoff"};
    std::string name = kNames[static_cast<std::size_t>(source)];
    if (index >= 0) name.append("[").append(std::to_string(index)).append("]");
    return name;
  }
};

/// A box of one variable.
struct VariableBox {
  std::int32_t variable;
  double lower;
  double upper;
};

/// lower[j] <= x_j <= upper[j] while they are narrowed and widened again. Made by a Propagator, and
/// of use with that one alone; a copy is boxes of its own.
class NodeBoxes {
 public:
  /// The moment that UndoTo goes back to.
  struct Mark {
    std::size_t num_changes = 0;
    std::size_t num_propagated = 0;  // of the changes, those whose consequences were drawn
    double cutoff = kInfinity;       // the last that was propagated
    bool fresh = true;               // nothing was propagated yet
    Contradiction contradiction;
  };

  /// Borrows `integer`, one flag for each variable. Integers' ends are rounded inward.
  NodeBoxes(std::vector<double> lower, std::vector<double> upper, const std::uint8_t* integer)
      : lower_(std::move(lower)), upper_(std::move(upper)), integer_(integer) {}

  [[nodiscard]] double lower(std::int32_t j) const { return lower_[At(j)]; }
  [[nodiscard]] double upper(std::int32_t j) const { return upper_[At(j)]; }
  [[nodiscard]] const std::vector<double>& lower() const { return lower_; }
  [[nodiscard]] const std::vector<double>& upper() const { return upper_; }
  [[nodiscard]] bool IsFixed(std::int32_t j) const { return lower(j) == upper(j); }
  [[nodiscard]] bool IsInteger(std::int32_t j) const { return integer_[j] != 0; }
  /// kNone while, as far as is known, a point is left. Stays until it is undone.
  [[nodiscard]] const Contradiction& contradiction() const { return now_.contradiction; }

  /// From here on x_j is in [lower, upper] too; an infinite end says nothing. A range that misses
  /// the box by more than rounding is a contradiction; one that misses it by less changes nothing.
  void Impose(std::int32_t j, double lower, double upper) {
    if (Raise(j, lower) == Narrowed::kEmpty || Cut(j, upper) == Narrowed::kEmpty) {
      SayEmpty({Contradiction::Source::kVariable, j});
    }
  }

  [[nodiscard]] const Mark& Now() const { return now_; }
  /// Every box as it was at `mark`, bit for bit. Later marks are void from here on.
  void UndoTo(const Mark& mark) {
    for (; trail_.size() > mark.num_changes; trail_.pop_back()) {
      const VariableBox& old = trail_.back();
      lower_[At(old.variable)] = old.lower;
      upper_[At(old.variable)] = old.upper;
    }
    now_ = mark;
  }
  /// What was changed so far can no longer be undone, and needs no memory. All marks are void.
  void Commit() {
    const std::size_t pending = now_.fresh ? 0 : now_.num_changes - now_.num_propagated;
    trail_.erase(trail_.begin(), trail_.end() - static_cast<std::ptrdiff_t>(pending));
    now_.num_changes = pending;
    now_.num_propagated = 0;
  }

  /// The changes since a mark, in their order, by the box before each. A variable may be in
  /// several.
  [[nodiscard]] std::span<const VariableBox> ChangesSince(const Mark& mark) const {
    return std::span(trail_).subspan(mark.num_changes);
  }
  /// The boxes that differ from those at a mark, by variable: what makes a node of its parent.
  [[nodiscard]] std::vector<VariableBox> NarrowedSince(const Mark& mark) const {
    std::vector<VariableBox> narrowed;
    NarrowedSince(mark, narrowed);
    return narrowed;
  }
  /// Likewise, in the memory of `narrowed`.
  void NarrowedSince(const Mark& mark, std::vector<VariableBox>& narrowed) const {
    narrowed.clear();
    for (const VariableBox& old : ChangesSince(mark)) {
      narrowed.push_back({old.variable, lower(old.variable), upper(old.variable)});
    }
    const auto before = [](const VariableBox& a, const VariableBox& b) {
      return a.variable < b.variable;
    };
    const auto same = [](const VariableBox& a, const VariableBox& b) {
      return a.variable == b.variable;
    };
    std::sort(narrowed.begin(), narrowed.end(), before);
    narrowed.erase(std::unique(narrowed.begin(), narrowed.end(), same), narrowed.end());
  }

 private:
  friend class Propagator;
  friend class Narrowing;

  enum class Narrowed : std::uint8_t { kNot, kSlightly, kRelevantly, kEmpty };

  static std::size_t At(std::int32_t j) { return static_cast<std::size_t>(j); }

  /// x_j <= v is proven. Taken as Ranges of box_ranges.hpp takes it, and relevant as there, or
  /// where an integer's end moves.
  Narrowed Cut(std::int32_t j, double v) {
    using namespace boxes_detail;
    const double old = upper(j);
    if (v < old && IsInteger(j)) v = IntegerBelow(v);
    if (!(v < old) || !std::isfinite(v)) return Narrowed::kNot;
    if (v < lower(j)) return IsWrong(lower(j) - v, 0) ? Narrowed::kEmpty : Narrowed::kNot;
    Remember(j);
    upper_[At(j)] = v;
    return IsInteger(j) || IsRelevant(v, old, lower(j)) ? Narrowed::kRelevantly
                                                        : Narrowed::kSlightly;
  }
  /// x_j >= v likewise.
  Narrowed Raise(std::int32_t j, double v) {
    using namespace boxes_detail;
    const double old = lower(j);
    if (v > old && IsInteger(j)) v = IntegerAbove(v);
    if (!(v > old) || !std::isfinite(v)) return Narrowed::kNot;
    if (v > upper(j)) return IsWrong(v - upper(j), 0) ? Narrowed::kEmpty : Narrowed::kNot;
    Remember(j);
    lower_[At(j)] = v;
    return IsInteger(j) || IsRelevant(v, old, upper(j)) ? Narrowed::kRelevantly
                                                        : Narrowed::kSlightly;
  }
  void Remember(std::int32_t j) {
    trail_.push_back({j, lower(j), upper(j)});
    now_.num_changes = trail_.size();
  }
  void SayEmpty(const Contradiction& found) {
    if (!now_.contradiction) now_.contradiction = found;
  }

  std::vector<double> lower_, upper_;
  const std::uint8_t* integer_;
  std::vector<VariableBox> trail_;  // boxes before each change
  Mark now_;
};

}  // namespace switchyard::mip
