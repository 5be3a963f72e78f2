#include "options.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <vector>

#include "linear/settings.hpp"

namespace switchyard::highs {
namespace {

// These would write to standard output; the log goes to the host by sy_control.verbosity.
bool IsTheHosts(const std::string& name) {
  return name == "output_flag" || name == "log_to_console";
}

// A description lists the words that are allowed in quotes; "" stands for any text.
std::vector<std::string> QuotedWords(const std::string& description) {
  std::vector<std::string> words;
  for (std::size_t at = description.find('"'); at != std::string::npos;) {
    const std::size_t end = description.find('"', at + 1);
    if (end == std::string::npos) break;
    words.push_back(description.substr(at + 1, end - at - 1));
    at = description.find('"', end + 1);
  }
  const bool plain = std::all_of(words.begin(), words.end(), [](const std::string& word) {
    return !word.empty() && word.find('\\') == std::string::npos;
  });
  return plain && words.size() > 1 ? words : std::vector<std::string>();
}

// Owns the texts that the table points to, for the life of the process.
struct TableOfOptions {
  HighsOptions options;
  std::deque<std::vector<std::string>> words;
  std::deque<std::vector<const char*>> choices;
  std::deque<sy_option> rows;
  std::vector<const sy_option*> list;

  TableOfOptions() {
    for (const OptionRecord* record : options.records) {
      if (IsTheHosts(record->name)) continue;
      sy_option row = {};
      row.size = sizeof row;
      row.name = record->name.c_str();
      row.help = record->description.c_str();
      Fill(*record, row);
      rows.push_back(row);
    }
    for (const sy_option& row : rows) list.push_back(&row);
    list.push_back(nullptr);
  }

  void Fill(const OptionRecord& record, sy_option& row) {
    if (record.type == HighsOptionType::kBool) {
      row.fallback.as.integer = static_cast<const OptionRecordBool&>(record).default_value;
      row.upper = 1;
    } else if (record.type == HighsOptionType::kInt) {
      const auto& own = static_cast<const OptionRecordInt&>(record);
      row.fallback.as.integer = own.default_value;
      row.lower = own.lower_bound;
      row.upper = own.upper_bound;
    } else if (record.type == HighsOptionType::kDouble) {
      const auto& own = static_cast<const OptionRecordDouble&>(record);
      row.fallback.type = SY_REAL;
      row.fallback.as.real = own.default_value;
      row.lower = own.lower_bound;
      row.upper = own.upper_bound;
    } else {
      row.fallback.type = SY_TEXT;
      row.fallback.as.text = static_cast<const OptionRecordString&>(record).default_value.c_str();
      words.push_back(QuotedWords(record.description));
      if (words.back().empty()) return;
      choices.emplace_back();
      for (const std::string& word : words.back()) choices.back().push_back(word.c_str());
      choices.back().push_back(nullptr);
      row.choices = choices.back().data();
    }
  }
};

const TableOfOptions& Table() {
  static const TableOfOptions table;
  return table;
}

template <class T>
T Clamped(std::int64_t value) {
  constexpr std::int64_t most = std::numeric_limits<T>::max();
  return static_cast<T>(std::clamp<std::int64_t>(value, 0, most));
}

}  // namespace

const sy_option* const* OptionTable() { return Table().list.data(); }

void Options::Set(std::string_view name, const sy_value& value) {
  linear::CheckOption(OptionTable(), "HiGHS", name, value);
  for (OptionRecord* record : own_.records) {
    if (name != record->name) continue;
    const double number =
        value.type == SY_REAL ? value.as.real : static_cast<double>(value.as.integer);
    if (record->type == HighsOptionType::kBool) {
      static_cast<OptionRecordBool*>(record)->assignvalue(value.as.integer != 0);
    } else if (record->type == HighsOptionType::kInt) {
      static_cast<OptionRecordInt*>(record)->assignvalue(static_cast<HighsInt>(value.as.integer));
    } else if (record->type == HighsOptionType::kDouble) {
      static_cast<OptionRecordDouble*>(record)->assignvalue(number);
    } else {
      static_cast<OptionRecordString*>(record)->assignvalue(value.as.text);
    }
  }
  chosen_.emplace(name);
}

HighsOptions Options::For(const sy_control& control) const {
  HighsOptions o = own_;
  o.log_to_console = false;
  o.output_flag = control.verbosity > 0;
  Prefer(o.threads, "threads", std::max(1, control.threads));
  Prefer(o.random_seed, "random_seed", control.seed & 0x7fffffffu);
  Prefer(o.simplex_iteration_limit, "simplex_iteration_limit",
         Clamped<HighsInt>(control.iterations));
  Prefer(o.ipm_iteration_limit, "ipm_iteration_limit", Clamped<HighsInt>(control.iterations));
  Prefer(o.pdlp_iteration_limit, "pdlp_iteration_limit", Clamped<HighsInt>(control.iterations));
  Prefer(o.qp_iteration_limit, "qp_iteration_limit", Clamped<HighsInt>(control.iterations));
  Prefer(o.mip_max_nodes, "mip_max_nodes", Clamped<HighsInt>(control.nodes));
  Prefer(o.objective_bound, "objective_bound", control.cutoff);
  Prefer(o.objective_target, "objective_target", control.target);
  // HiGHS refuses what is below its least tolerance, which is then the nearest it can do.
  const auto tolerance = [this](double& field, const char* name, double asked, double least) {
    if (!std::isnan(asked)) Prefer(field, name, std::max(asked, least));
  };
  tolerance(o.primal_feasibility_tolerance, "primal_feasibility_tolerance", control.feasibility,
            kMinimumKktTolerance);
  tolerance(o.dual_feasibility_tolerance, "dual_feasibility_tolerance", control.optimality,
            kMinimumKktTolerance);
  tolerance(o.ipm_optimality_tolerance, "ipm_optimality_tolerance", control.optimality,
            kMinimumIpmTolerance);
  tolerance(o.pdlp_optimality_tolerance, "pdlp_optimality_tolerance", control.optimality,
            kMinimumKktTolerance);
  tolerance(o.mip_feasibility_tolerance, "mip_feasibility_tolerance", control.integrality,
            kMinimumMipTolerance);
  tolerance(o.mip_abs_gap, "mip_abs_gap", control.absolute_gap, 0);
  tolerance(o.mip_rel_gap, "mip_rel_gap", control.relative_gap, 0);
  return o;
}

}  // namespace switchyard::highs
