#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <queue>

#include <fmt/format.h>

#include "generate.hpp"
#include "random.hpp"

namespace switchyard::cli {
namespace {

// Lengths are integers, in quarters of a meter: the same on every machine, and short in the file.
constexpr double kUnit = 0.25;
constexpr int kWall = 1;       // between the rooms of two tiles: the last unit of the first tile
constexpr int kDoor = 4;       // width of a doorway
constexpr int kSide = 10;      // the least side of a tile
constexpr int kArea = 448;     // of a tile, on average: 28 square meters
constexpr double kWide = 1.6;  // width of the floor by its depth
// A tile that is still to be split is at least as large as the average, so one of its sides can be.
static_assert(kArea >= (2 * kSide) * (2 * kSide));
static_assert(kSide >= kDoor + 2 * kWall);

/// A room and its walls on the right and above.
struct Tile {
  std::array<int, 2> lower;
  std::array<int, 2> upper;
  [[nodiscard]] int Extent(std::size_t axis) const { return upper[axis] - lower[axis]; }
  [[nodiscard]] std::int64_t Area() const { return std::int64_t{1} * Extent(0) * Extent(1); }
};

/// Tiles i and j meet at right angles to the axis, j behind i; along the other axis they have
/// [from, to] in common.
struct Shared {
  std::size_t i, j;
  std::size_t axis;
  int from, to;
};

/// The largest tile is split across its longer side until there are enough.
std::vector<Tile> Tiles(int count, Random& random) {
  const auto width = static_cast<int>(std::ceil(std::sqrt(kWide * kArea * count)));
  const int depth = (kArea * count + width - 1) / width;
  std::vector<Tile> tiles{{{0, 0}, {std::max(width, kSide), std::max(depth, kSide)}}};
  std::priority_queue<std::pair<std::int64_t, std::size_t>> by_area;
  by_area.emplace(tiles[0].Area(), 0);
  while (static_cast<int>(tiles.size()) < count) {
    const std::size_t largest = by_area.top().second;
    by_area.pop();
    Tile& a = tiles[largest];
    const std::size_t axis = a.Extent(0) >= a.Extent(1) ? 0 : 1;
    const int least = std::max(kSide, a.Extent(axis) * 3 / 10);
    const int cut = a.lower[axis] + random.Between(least, a.Extent(axis) - least);
    Tile b = a;
    a.upper[axis] = b.lower[axis] = cut;
    by_area.emplace(a.Area(), largest);
    by_area.emplace(b.Area(), tiles.size());
    tiles.push_back(b);
  }
  return tiles;
}

/// Pairs of tiles with a common stretch that is wide enough for a door. They connect all tiles: on
/// the cut that made two halves, the first tiles of either side begin at the same end and have
/// kSide in common.
std::vector<Shared> CommonWalls(const std::vector<Tile>& tiles) {
  std::vector<Shared> walls;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::size_t along = 1 - axis;
    std::map<int, std::array<std::vector<std::size_t>, 2>> lines;  // those before, those behind
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      lines[tiles[i].upper[axis]][0].push_back(i);
      lines[tiles[i].lower[axis]][1].push_back(i);
    }
    for (auto& [place, sides] : lines) {
      for (auto& side : sides) {
        std::sort(side.begin(), side.end(), [&](std::size_t i, std::size_t j) {
          return tiles[i].lower[along] < tiles[j].lower[along];
        });
      }
      for (std::size_t b = 0, a = 0; a < sides[0].size() && b < sides[1].size();) {
        const Tile& before = tiles[sides[0][a]];
        const Tile& behind = tiles[sides[1][b]];
        const int from = std::max(before.lower[along], behind.lower[along]);
        const int to = std::min(before.upper[along], behind.upper[along]);
        if (to - from >= kDoor + 2 * kWall) {
          walls.push_back({sides[0][a], sides[1][b], axis, from, to});
        }
        before.upper[along] < behind.upper[along] ? ++a : ++b;
      }
    }
  }
  return walls;
}

/// The walls that get a door: a random spanning tree, and every third of the others.
std::vector<Shared> Doors(std::vector<Shared> walls, std::size_t num_tiles, Random& random) {
  std::vector<std::size_t> parent(num_tiles);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  random.Shuffle(walls);
  std::vector<Shared> doors;
  constexpr int kOneIn = 3;
  for (const Shared& wall : walls) {
    const std::size_t i = root(wall.i);
    const std::size_t j = root(wall.j);
    if (i == j && random.Below(kOneIn) != 0) continue;
    parent[i] = j;
    doors.push_back(wall);
  }
  return doors;
}

Eigen::Vector2d Meters(int x, int y) { return Eigen::Vector2d(x, y) * kUnit; }

FloorGraph::Vertex* AddDoorway(const Shared& wall, const Tile& before, Random& random,
                               FloorGraph& floor) {
  std::array<int, 2> lower{};
  lower[wall.axis] = before.upper[wall.axis] - kWall;
  lower[1 - wall.axis] = random.Between(wall.from + kWall, wall.to - kWall - kDoor);
  std::array<int, 2> upper = lower;
  upper[wall.axis] += kWall;
  upper[1 - wall.axis] += kDoor;
  return floor.AddBox(Meters(lower[0], lower[1]), Meters(upper[0], upper[1]),
                      fmt::format("door{}_{}", wall.i, wall.j));
}

}  // namespace

GraphProblem GenerateBuilding(int size, std::uint64_t seed, StepCost cost) {
  Random random(seed);
  const std::vector<Tile> tiles = Tiles(size, random);
  FloorGraph floor(fmt::format("building_{}_{}", size, seed), cost);
  std::vector<FloorGraph::Vertex*> rooms;
  for (const Tile& t : tiles) {
    rooms.push_back(floor.AddBox(Meters(t.lower[0], t.lower[1]),
                                 Meters(t.upper[0] - kWall, t.upper[1] - kWall),
                                 fmt::format("room{}", rooms.size())));
  }
  for (const Shared& wall : Doors(CommonWalls(tiles), tiles.size(), random)) {
    FloorGraph::Vertex* door = AddDoorway(wall, tiles[wall.i], random, floor);
    floor.Join(rooms[wall.i], door);
    floor.Join(door, rooms[wall.j]);
  }
  const auto by_corner = [](const Tile& a, const Tile& b) {
    return a.lower[0] + a.lower[1] < b.lower[0] + b.lower[1];
  };
  const auto far = [](const Tile& a, const Tile& b) {
    return a.upper[0] + a.upper[1] < b.upper[0] + b.upper[1];
  };
  const auto first = std::min_element(tiles.begin(), tiles.end(), by_corner) - tiles.begin();
  const auto last = std::max_element(tiles.begin(), tiles.end(), far) - tiles.begin();
  constexpr int kFromWall = 4;  // one meter
  const Tile& from = tiles[static_cast<std::size_t>(first)];
  const Tile& to = tiles[static_cast<std::size_t>(last)];
  floor.SetEnds(Meters(from.lower[0] + kFromWall, from.lower[1] + kFromWall),
                rooms[static_cast<std::size_t>(first)],
                Meters(to.upper[0] - kWall - kFromWall, to.upper[1] - kWall - kFromWall),
                rooms[static_cast<std::size_t>(last)]);
  return floor.Take();
}

}  // namespace switchyard::cli
