// solvers/conic/product_cone.hpp - all cones of a problem as one.
#pragma once

#include <memory>
#include <vector>

#include "solvers/conic/form.hpp"

namespace switchyard::conic {

/// K x R_+ over all slacks: what cones::Group says of one, of all. Vectors are those of the slacks.
class ProductCone {
 public:
  /// `workers`, if any, share what is done to slacks, and outlive it.
  explicit ProductCone(const Form& form, linalg::Workers* workers = nullptr);
  [[nodiscard]] linalg::Workers* workers() const { return workers_; }

  [[nodiscard]] double degree() const { return degree_; }
  [[nodiscard]] bool symmetric() const { return symmetric_; }
  void Center(Vector& s) const;
  [[nodiscard]] double Depth(const Vector& v) const;

  bool Scale(const Vector& s, const Vector& z, double mu);
  void ScaleByIdentity();
  void Multiply(const Vector& v, Vector& h_v) const;
  /// out = (H + r)^-1 v for the rows of cones; behind them the diagonal of H is orthant().
  void Divide(const Vector& v, double r, Vector& out) const;
  void Mend(const Vector& e, Vector& ds) const;
  /// Takes away from e what Mend would add of it.
  void Unmended(Vector& e) const;
  void Correct(const Vector& s, const Vector& z, const Vector& ds, const Vector& dz, double target,
               Vector& xi) const;
  /// `trial_s`, `trial_z`: where the step so far leads.
  void Recenter(const Vector& trial_s, const Vector& trial_z, const Vector& z, double low,
                double high, Vector& xi) const;
  [[nodiscard]] double Step(const Vector& s, const Vector& z, const Vector& ds, const Vector& dz,
                            double most) const;
  [[nodiscard]] bool NearPath(const Vector& s, const Vector& z, double mu) const;

  struct Part {
    Index first;  // row
    std::unique_ptr<cones::Group> group;
  };
  [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
  [[nodiscard]] const Vector& orthant() const { return h_; }

 private:
  /// body(part) for all, by whoever is free.
  template <class Body>
  void EachGroup(Body&& body) const;
  /// body(begin, end) for parts of the numbers behind the cones.
  template <class Body>
  void EachRange(Body&& body) const;

  linalg::Workers* const workers_;
  std::vector<Part> parts_;
  Index orthant_;  // first slack
  Index count_;
  double degree_ = 0;
  bool symmetric_ = true;
  mutable Vector mended_;
  mutable std::vector<double> found_;  // by each group
  Vector h_;
};

}  // namespace switchyard::conic
