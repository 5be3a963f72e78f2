#include "core/symbolic/columns.hpp"

#include <algorithm>
#include <limits>

#include "core/symbolic/node.hpp"

namespace switchyard {

Columns::Columns(std::span<const Expression> expressions) {
  Variable::Id low = std::numeric_limits<Variable::Id>::max();
  Variable::Id high = -1;
  std::size_t terms = 0;
  ForEachExpression(expressions, [&](const Expression& e) {
    terms += e.linear().size();
    for (const auto& t : e.linear()) {
      low = std::min(low, t.variable.get_id());
      high = std::max(high, t.variable.get_id());
    }
  });
  if (terms == 0 || high - low > 1024 + 16 * static_cast<Variable::Id>(terms)) return;
  low_ = low;
  table_.assign(static_cast<std::size_t>(high - low + 1), -1);
}

}  // namespace switchyard
