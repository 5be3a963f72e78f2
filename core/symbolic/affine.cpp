#include <numeric>
#include <span>

#include "core/symbolic/columns.hpp"
#include "core/symbolic/node.hpp"
#include "switchyard/error.hpp"
#include "switchyard/symbolic/decompose.hpp"

namespace switchyard {
namespace {

struct Entry {
  int row;
  int column;
  double value;
};

// The coefficients of all rows, those of one variable in one row added up.
class Entries {
 public:
  explicit Entries(std::span<const Expression> rows) : columns_(rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (const auto& t : rows[i].linear()) {
        Add(static_cast<int>(i), columns_.Of(t.variable), t.coefficient);
      }
    }
    std::erase_if(entries_, [](const Entry& e) { return e.value == 0; });
  }

  // Column by column, and in each by rows: the order of counting, since rows came in order.
  AffineForm Sorted(Eigen::Index rows) const {
    const std::vector<int> place = UsedColumns();
    const int used = place.empty() ? 0 : place.back();
    AffineForm form{SparseMatrix(rows, used), Eigen::VectorXd(rows), VectorXDecisionVariable(used)};
    form.A.resizeNonZeros(static_cast<Eigen::Index>(entries_.size()));
    int* start = form.A.outerIndexPtr();
    for (const Entry& e : entries_) ++start[NewColumn(place, e.column) + 1];
    std::partial_sum(start, start + used + 1, start);
    std::vector<int> next(start, start + used);
    for (const Entry& e : entries_) {
      const int at = next[static_cast<std::size_t>(NewColumn(place, e.column))]++;
      form.A.innerIndexPtr()[at] = e.row;
      form.A.valuePtr()[at] = e.value;
      form.variables[NewColumn(place, e.column)] =
          columns_.variables()[static_cast<std::size_t>(e.column)];
    }
    return form;
  }

 private:
  void Add(int row, int column, double value) {
    const auto j = static_cast<std::size_t>(column);
    if (j == last_.size()) last_.push_back({-1, 0});
    if (last_[j].row == row) {
      entries_[last_[j].entry].value += value;
    } else {
      last_[j] = {row, entries_.size()};
      entries_.push_back({row, column, value});
    }
  }

  // How many of the columns up to each one have an entry.
  [[nodiscard]] std::vector<int> UsedColumns() const {
    std::vector<int> used(static_cast<std::size_t>(columns_.size()), 0);
    for (const Entry& e : entries_) used[static_cast<std::size_t>(e.column)] = 1;
    std::partial_sum(used.begin(), used.end(), used.begin());
    return used;
  }
  static int NewColumn(const std::vector<int>& used_up_to, int column) {
    return used_up_to[static_cast<std::size_t>(column)] - 1;
  }

  struct Last {
    int row;
    std::size_t entry;
  };
  Columns columns_;
  std::vector<Entry> entries_;
  std::vector<Last> last_;  // of each column: where it last had an entry
};

}  // namespace

AffineForm DecomposeAffine(const ExpressionVectorRef& e) {
  const std::span rows(e.data(), static_cast<std::size_t>(e.size()));
  for (const Expression& row : rows) {
    if (IsAffine(row)) continue;
    const auto& [node, coefficient] = row.nonlinear().front();
    Refuse(row.to_string(60), " is not affine: the term ",
           Expression(coefficient, node).to_string(60), " is not");
  }
  AffineForm form = Entries(rows).Sorted(e.size());
  for (Eigen::Index i = 0; i < e.size(); ++i) form.b[i] = e[i].constant();
  return form;
}

}  // namespace switchyard
