#include <array>

#include <fmt/format.h>

#include "generate.hpp"
#include "random.hpp"

namespace switchyard::cli {
namespace {

constexpr std::array<std::array<int, 2>, 4> kSteps = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

struct Wall {
  int cell;
  int neighbour;
};

/// The cells of a size x size grid, numbered by rows.
class Maze {
 public:
  Maze(int size, Random& random) : size_(size), random_(random), seen_(Count()) {}

  /// The walls that are open: a spanning tree, then some more.
  std::vector<Wall> Open() {
    GrowTree();
    constexpr int kOneIn = 20;
    std::vector<Wall> open = tree_;
    for (const Wall& wall : Closed()) {
      if (random_.Below(kOneIn) == 0) open.push_back(wall);
    }
    return open;
  }

 private:
  [[nodiscard]] std::size_t Count() const {
    return static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_);
  }
  /// -1: outside.
  [[nodiscard]] int Neighbour(int cell, const std::array<int, 2>& step) const {
    const int x = cell % size_ + step[0];
    const int y = cell / size_ + step[1];
    return x < 0 || y < 0 || x >= size_ || y >= size_ ? -1 : y * size_ + x;
  }

  // Walks to a random neighbour not seen yet, and goes back where there is none.
  void GrowTree() {
    std::vector<int> way{0};
    seen_[0] = true;
    while (!way.empty()) {
      const int cell = way.back();
      std::vector<int> fresh;
      for (const auto& step : kSteps) {
        const int next = Neighbour(cell, step);
        if (next >= 0 && !seen_[static_cast<std::size_t>(next)]) fresh.push_back(next);
      }
      if (fresh.empty()) {
        way.pop_back();
        continue;
      }
      const int next =
          fresh[static_cast<std::size_t>(random_.Below(static_cast<int>(fresh.size())))];
      seen_[static_cast<std::size_t>(next)] = true;
      tree_.push_back({cell, next});
      way.push_back(next);
    }
  }

  [[nodiscard]] std::vector<Wall> Closed() const {
    std::vector<std::array<bool, 2>> open(Count());  // to the right, upwards
    for (const Wall& wall : tree_) {
      const int low = std::min(wall.cell, wall.neighbour);
      const bool upwards = std::abs(wall.cell - wall.neighbour) == size_ && size_ > 1;
      open[static_cast<std::size_t>(low)][upwards ? 1 : 0] = true;
    }
    std::vector<Wall> closed;
    for (int cell = 0; cell < static_cast<int>(Count()); ++cell) {
      for (std::size_t way = 0; way < 2; ++way) {
        const int next = Neighbour(cell, kSteps[way]);
        if (next >= 0 && !open[static_cast<std::size_t>(cell)][way]) closed.push_back({cell, next});
      }
    }
    return closed;
  }

  int size_;
  Random& random_;
  std::vector<bool> seen_;
  std::vector<Wall> tree_;
};

}  // namespace

GraphProblem GenerateMaze(int size, std::uint64_t seed, StepCost cost) {
  Random random(seed);
  FloorGraph floor(fmt::format("maze_{}_{}", size, seed), cost);
  std::vector<FloorGraph::Vertex*> cells;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      cells.push_back(floor.AddBox({x, y}, {x + 1, y + 1}, fmt::format("cell{}_{}", x, y)));
    }
  }
  for (const Wall& wall : Maze(size, random).Open()) {
    floor.Join(cells[static_cast<std::size_t>(wall.cell)],
               cells[static_cast<std::size_t>(wall.neighbour)]);
  }
  constexpr double kHalf = 0.5;
  floor.SetEnds(Eigen::Vector2d::Constant(kHalf), cells.front(),
                Eigen::Vector2d::Constant(size - kHalf), cells.back());
  return floor.Take();
}

}  // namespace switchyard::cli
