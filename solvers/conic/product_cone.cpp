#include "solvers/conic/product_cone.hpp"

#include <algorithm>

#include "solvers/cones/kinds.hpp"

namespace switchyard::conic {

using cones::Orthant;

ProductCone::ProductCone(const Form& form)
    : orthant_(form.shape.cone_rows), count_(form.shape.slacks() - form.shape.cone_rows) {
  for (const ConeGroup& g : form.cones) {
    parts_.push_back({g.first, cones::FindKind(g.kind)->make(g.layout, g.parameter)});
    degree_ += parts_.back().group->degree();
    symmetric_ = symmetric_ && parts_.back().group->symmetric();
  }
  degree_ += count_;
  h_.assign(count_, 1.0);
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
  for (const Part& p : parts_) {
    if (!p.group->Scale(s.data() + p.first, z.data() + p.first, mu)) return false;
  }
  Orthant::Scale(s.data() + orthant_, z.data() + orthant_, count_, h_.data());
  return true;
}

void ProductCone::ScaleByIdentity() {
  for (const Part& p : parts_) p.group->ScaleByIdentity();
  std::fill(h_.begin(), h_.end(), 1.0);
}

void ProductCone::Multiply(const Vector& v, Vector& out) const {
  for (const Part& p : parts_) p.group->Multiply(v.data() + p.first, out.data() + p.first);
  for (Index i = 0; i < count_; ++i) out[orthant_ + i] = h_[i] * v[orthant_ + i];
}

void ProductCone::Divide(const Vector& v, double r, Vector& out) const {
  for (const Part& p : parts_) p.group->Divide(v.data() + p.first, r, out.data() + p.first);
}

void ProductCone::Mend(const Vector& e, Vector& ds) const {
  for (const Part& p : parts_) p.group->Mend(e.data() + p.first, ds.data() + p.first);
}

void ProductCone::Unmended(Vector& e) const {
  if (parts_.empty()) return;
  mended_.assign(orthant_, 0.0);
  Mend(e, mended_);
  for (Index i = 0; i < orthant_; ++i) e[i] -= mended_[i];
}

void ProductCone::Correct(const Vector& s, const Vector& z, const Vector& ds, const Vector& dz,
                          double target, Vector& xi) const {
  for (const Part& p : parts_) {
    const Index at = p.first;
    p.group->Correct(s.data() + at, z.data() + at, ds.data() + at, dz.data() + at, target,
                     xi.data() + at);
  }
  Orthant::Correct(s.data() + orthant_, z.data() + orthant_, ds.data() + orthant_,
                   dz.data() + orthant_, count_, target, xi.data() + orthant_);
}

void ProductCone::Recenter(const Vector& trial_s, const Vector& trial_z, const Vector& z,
                           double low, double high, Vector& xi) const {
  for (const Part& p : parts_) {
    p.group->Recenter(trial_s.data() + p.first, trial_z.data() + p.first, low, high,
                      xi.data() + p.first);
  }
  Orthant::Recenter(trial_s.data() + orthant_, trial_z.data() + orthant_, z.data() + orthant_,
                    count_, low, high, xi.data() + orthant_);
}

double ProductCone::Step(const Vector& s, const Vector& z, const Vector& ds, const Vector& dz,
                         double most) const {
  double step = Orthant::Step(s.data() + orthant_, z.data() + orthant_, ds.data() + orthant_,
                              dz.data() + orthant_, count_, most);
  for (const Part& p : parts_) {
    const Index at = p.first;
    step = p.group->Step(s.data() + at, z.data() + at, ds.data() + at, dz.data() + at, step);
  }
  return step;
}

bool ProductCone::NearPath(const Vector& s, const Vector& z, double mu) const {
  return std::all_of(parts_.begin(), parts_.end(), [&](const Part& p) {
    return p.group->NearPath(s.data() + p.first, z.data() + p.first, mu);
  });
}

}  // namespace switchyard::conic
