#include "solvers/conic/product_cone.hpp"

#include <algorithm>

#include "solvers/cones/kinds.hpp"

namespace switchyard::conic {

using cones::Orthant;

ProductCone::ProductCone(const Form& form, linalg::Workers* workers)
    : workers_(workers),
      orthant_(form.shape.cone_rows),
      count_(form.shape.slacks() - form.shape.cone_rows) {
  for (const ConeGroup& g : form.cones) {
    parts_.push_back({g.first, cones::FindKind(g.kind)->make(g.layout, g.parameter)});
    degree_ += parts_.back().group->degree();
    symmetric_ = symmetric_ && parts_.back().group->symmetric();
  }
  degree_ += count_;
  h_.assign(count_, 1.0);
  found_.resize(parts_.size());
}

template <class Body>
void ProductCone::EachGroup(Body&& body) const {
  linalg::EachPart(workers_, parts_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) body(p, *parts_[p].group, parts_[p].first);
  });
}

template <class Body>
void ProductCone::EachRange(Body&& body) const {
  constexpr std::size_t kGrain = 4096;
  linalg::EachPart(workers_, static_cast<std::size_t>(count_), kGrain,
                   [&](std::size_t begin, std::size_t end) {
                     body(static_cast<Index>(begin), static_cast<Index>(end - begin));
                   });
}

void ProductCone::Center(Vector& s) const {
  for (const Part& p : parts_) p.group->Center(s.data() + p.first);
  std::fill(s.begin() + orthant_, s.end(), 1.0);
}

double ProductCone::Depth(const Vector& v) const {
  double least = kInfinity;
  for (const Part& p : parts_) least = std::min(least, p.group->Depth(v.data() + p.first));
  for (auto i = static_cast<std::size_t>(orthant_); i < v.size(); ++i) {
    least = std::min(least, v[i]);
  }
  return least;
}

bool ProductCone::Scale(const Vector& s, const Vector& z, double mu) {
  EachGroup([&](std::size_t p, cones::Group& group, Index at) {
    found_[p] = group.Scale(s.data() + at, z.data() + at, mu) ? 1 : 0;
  });
  if (std::find(found_.begin(), found_.end(), 0) != found_.end()) return false;
  EachRange([&](Index i, Index count) {
    Orthant::Scale(s.data() + orthant_ + i, z.data() + orthant_ + i, count, h_.data() + i);
  });
  return true;
}

void ProductCone::ScaleByIdentity() {
  for (const Part& p : parts_) p.group->ScaleByIdentity();
  std::fill(h_.begin(), h_.end(), 1.0);
}

void ProductCone::Multiply(const Vector& v, Vector& out) const {
  EachGroup([&](std::size_t, const cones::Group& group, Index at) {
    group.Multiply(v.data() + at, out.data() + at);
  });
  EachRange([&](Index first, Index count) {
    for (Index i = first; i < first + count; ++i) out[orthant_ + i] = h_[i] * v[orthant_ + i];
  });
}

void ProductCone::Divide(const Vector& v, double r, Vector& out) const {
  EachGroup([&](std::size_t, const cones::Group& group, Index at) {
    group.Divide(v.data() + at, r, out.data() + at);
  });
}

void ProductCone::Mend(const Vector& e, Vector& ds) const {
  EachGroup([&](std::size_t, const cones::Group& group, Index at) {
    group.Mend(e.data() + at, ds.data() + at);
  });
}

void ProductCone::Unmended(Vector& e) const {
  if (parts_.empty()) return;
  mended_.assign(orthant_, 0.0);
  Mend(e, mended_);
  for (Index i = 0; i < orthant_; ++i) e[i] -= mended_[i];
}

void ProductCone::Correct(const Vector& s, const Vector& z, const Vector& ds, const Vector& dz,
                          double target, Vector& xi) const {
  EachGroup([&](std::size_t, const cones::Group& group, Index at) {
    group.Correct(s.data() + at, z.data() + at, ds.data() + at, dz.data() + at, target,
                  xi.data() + at);
  });
  EachRange([&](Index first, Index count) {
    const Index at = orthant_ + first;
    Orthant::Correct(s.data() + at, z.data() + at, ds.data() + at, dz.data() + at, count, target,
                     xi.data() + at);
  });
}

void ProductCone::Recenter(const Vector& trial_s, const Vector& trial_z, const Vector& z,
                           double low, double high, Vector& xi) const {
  EachGroup([&](std::size_t, const cones::Group& group, Index at) {
    group.Recenter(trial_s.data() + at, trial_z.data() + at, low, high, xi.data() + at);
  });
  EachRange([&](Index first, Index count) {
    const Index at = orthant_ + first;
    Orthant::Recenter(trial_s.data() + at, trial_z.data() + at, z.data() + at, count, low, high,
                      xi.data() + at);
  });
}

double ProductCone::Step(const Vector& s, const Vector& z, const Vector& ds, const Vector& dz,
                         double most) const {
  const double step = Orthant::Step(s.data() + orthant_, z.data() + orthant_, ds.data() + orthant_,
                                    dz.data() + orthant_, count_, most);
  EachGroup([&](std::size_t p, const cones::Group& group, Index at) {
    found_[p] = group.Step(s.data() + at, z.data() + at, ds.data() + at, dz.data() + at, step);
  });
  return found_.empty() ? step : *std::min_element(found_.begin(), found_.end());
}

bool ProductCone::NearPath(const Vector& s, const Vector& z, double mu) const {
  return std::all_of(parts_.begin(), parts_.end(), [&](const Part& p) {
    return p.group->NearPath(s.data() + p.first, z.data() + p.first, mu);
  });
}

}  // namespace switchyard::conic
