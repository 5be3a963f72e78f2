#include "core/gcs/written_program.hpp"

#include <utility>

namespace switchyard {

void PathLists::Clear() {
  for (auto* list : {&flow, &scale, &arc_in, &arc_out, &dim}) list->clear();
  sets.clear();
}

void WrittenProgram::SwapLists(ProblemData& d) {
  BlockProgram& p = programs.now;
  d.q.swap(p.q);
  d.x_lower.swap(p.x_lower);
  d.x_upper.swap(p.x_upper);
  d.integer.swap(p.integer);
  d.row_lower.swap(p.row_lower);
  d.row_upper.swap(p.row_upper);
  d.cones.swap(p.cones);
  lent = !lent;
}

void WrittenProgram::BeginNext() {
  if (lent) problem.Change([this](ProblemData& d) { SwapLists(d); });
  std::swap(programs.now, programs.before);
  programs.now.Clear();
}

}  // namespace switchyard
