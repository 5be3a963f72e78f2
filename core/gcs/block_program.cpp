#include "core/gcs/block_program.hpp"

#include <algorithm>

namespace switchyard {
namespace {

std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

template <class T>
void AppendPart(const std::vector<T>& from, std::int32_t first, std::int32_t last,
                std::vector<T>& to) {
  to.insert(to.end(), from.begin() + first, from.begin() + last);
}

}  // namespace

BlockProgram::Place BlockProgram::Here() const {
  const auto count = [](const auto& list) { return static_cast<std::int32_t>(list.size()); };
  return {count(q), count(row_lower), count(cones), F.rows(), count(ends), -1};
}

void BlockProgram::List(std::uint64_t owner) {
  if (owner >= first_of_.size()) first_of_.resize(owner + owner / 2 + 1, 0);
  if (first_of_[owner] == 0) first_of_[owner] = num_blocks() + 1;
}

void BlockProgram::Begin(const BlockKey& key) {
  List(key.owner);
  keys_.push_back(key);
  places.push_back(Here());
}

void BlockProgram::EndBlocks() { places.push_back(Here()); }

std::int32_t BlockProgram::Find(const BlockKey& key, std::int32_t n) const {
  const bool ended = places.size() == keys_.size() + 1;
  if (!ended || key.owner >= first_of_.size() || first_of_[key.owner] == 0) return -1;
  const std::int32_t first = first_of_[key.owner] - 1;
  if (first + n < num_blocks() && keys_[At(first + n)] == key) return first + n;
  return keys_[At(first)] == key ? first : -1;
}

void BlockProgram::Append(const BlockProgram& from, std::int32_t first, std::int32_t last) {
  const Place begin = from.places[At(first)], end = from.places[At(last)], here = Here();
  const std::int32_t blocks = num_blocks() - first;
  for (std::int32_t b = first; b < last; ++b) {
    Place p = from.places[At(b)];
    p.x += here.x - begin.x;
    p.row += here.row - begin.row;
    p.cone += here.cone - begin.cone;
    p.cone_row += here.cone_row - begin.cone_row;
    p.end += here.end - begin.end;
    List(from.keys_[At(b)].owner);
    keys_.push_back(from.keys_[At(b)]);
    places.push_back(p);
  }
  AppendPart(from.q, begin.x, end.x, q);
  AppendPart(from.x_lower, begin.x, end.x, x_lower);
  AppendPart(from.x_upper, begin.x, end.x, x_upper);
  AppendPart(from.integer, begin.x, end.x, integer);
  AppendShifted(from.block_of_x, begin.x, end.x, blocks, block_of_x);
  A.Append(from.A, begin.row, end.row, here.x - begin.x);
  AppendPart(from.row_lower, begin.row, end.row, row_lower);
  AppendPart(from.row_upper, begin.row, end.row, row_upper);
  AppendShifted(from.block_of_row, begin.row, end.row, blocks, block_of_row);
  F.Append(from.F, begin.cone_row, end.cone_row, here.x - begin.x);
  AppendPart(from.cones, begin.cone, end.cone, cones);
  AppendShifted(from.block_of_cone, begin.cone, end.cone, blocks, block_of_cone);
  AppendPart(from.ends, begin.end, end.end, ends);
  for (std::size_t k = At(here.end); k < ends.size(); ++k) {
    if (ends[k].variable >= 0) ends[k].variable += here.x - begin.x;
  }
}

void BlockProgram::Clear() {
  for (auto* list : {&q, &x_lower, &x_upper, &row_lower, &row_upper}) list->clear();
  for (auto* list : {&block_of_x, &block_of_row, &block_of_cone}) list->clear();
  integer.clear();
  A.Clear();
  F.Clear();
  cones.clear();
  ends.clear();
  places.clear();
  keys_.clear();
  std::fill(first_of_.begin(), first_of_.end(), 0);
}

void BlockCopies::Add(std::int32_t block) {
  if (block != last_ || first_ == last_) {
    Flush();
    first_ = block;
  }
  last_ = block + 1;
}

void BlockCopies::Flush() {
  if (first_ < last_) to_.Append(from_, first_, last_);
  first_ = last_ = 0;
}

}  // namespace switchyard
