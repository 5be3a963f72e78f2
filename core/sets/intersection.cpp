#include "switchyard/sets/intersection.hpp"

#include "core/sets/scaled_rows.hpp"
#include "switchyard/error.hpp"

namespace switchyard {

Intersection::Intersection(ConvexSets sets)
    : ConvexSet(sets.empty() ? 0 : sets.front()->ambient_dimension()), sets_(std::move(sets)) {
  for (const ConvexSetPointer& set : sets_) {
    Require(set->ambient_dimension() == ambient_dimension(), "intersection: sets in R^",
            ambient_dimension(), " and in R^", set->ambient_dimension(), " do not meet");
  }
}

std::unique_ptr<ConvexSet> Intersection::DoClone() const {
  return std::make_unique<Intersection>(*this);
}

// The elements' rows and cones, one below the other; their own variables side by side.
ScaledSet Intersection::DoScaled() const {
  int num_aux = 0;
  for (const ConvexSetPointer& set : sets_) num_aux += set->scaled().num_aux;
  ScaledRows rows(ambient_dimension(), num_aux);
  int first_aux = 1 + ambient_dimension();
  for (const ConvexSetPointer& element : sets_) {
    const ScaledSet& set = element->scaled();
    std::vector<int> row;
    std::vector<int> cone_row;
    for (std::size_t i = 0; i < set.lower.size(); ++i) {
      row.push_back(rows.AddRow(set.lower[i], set.upper[i]));
    }
    for (const sy_cone& cone : set.cones) {
      const int first = rows.AddCone(cone);
      for (int i = 0; i < cone.dim; ++i) cone_row.push_back(first + i);
    }
    for (int j = 0; j < set.num_columns(); ++j) {
      const int column = j <= set.dim ? j : first_aux + j - 1 - set.dim;
      const auto at = static_cast<std::size_t>(j);
      for (auto k = static_cast<std::size_t>(set.A.start[at]);
           k < static_cast<std::size_t>(set.A.start[at + 1]); ++k) {
        rows.Set(row[static_cast<std::size_t>(set.A.row[k])], column, set.A.value[k]);
      }
      for (auto k = static_cast<std::size_t>(set.F.start[at]);
           k < static_cast<std::size_t>(set.F.start[at + 1]); ++k) {
        rows.SetCone(cone_row[static_cast<std::size_t>(set.F.row[k])], column, set.F.value[k]);
      }
    }
    first_aux += set.num_aux;
  }
  return rows.Finish();
}

}  // namespace switchyard
