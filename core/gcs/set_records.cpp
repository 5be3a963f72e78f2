#include "core/gcs/set_records.hpp"

namespace switchyard {

const sy_set* SetRecords::Of(const ConvexSet& set) {
  const auto [place, fresh] = of_.try_emplace(&set, nullptr);
  if (!fresh) return place->second;
  const ScaledSet& scaled = set.scaled();
  Record& r = records_.emplace_back();
  r.At = Transpose(scaled.A.View());
  r.Ft = Transpose(scaled.F.View());
  r.at = r.At.View();
  r.ft = r.Ft.View();
  r.record = {};
  r.record.size = sizeof r.record;
  r.record.dim = scaled.dim;
  r.record.num_aux = scaled.num_aux;
  r.record.num_rows = scaled.A.rows;
  r.record.num_cones = static_cast<std::int32_t>(scaled.cones.size());
  r.record.num_cone_rows = scaled.F.rows;
  r.record.At = &r.at;
  r.record.row_lower = scaled.lower.data();
  r.record.row_upper = scaled.upper.data();
  r.record.Ft = &r.ft;
  r.record.cones = scaled.cones.data();
  return place->second = &r.record;
}

}  // namespace switchyard
