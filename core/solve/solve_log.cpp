#include "core/solve/solve_log.hpp"

#include "switchyard/error.hpp"

namespace switchyard {

SolveLog::SolveLog(const Host& host, const SolverOptions& options)
    : host_(*host.table()), to_console_(options.log_to_console), file_(nullptr, &std::fclose) {
  if (!options.log_file.empty()) {
    file_.reset(std::fopen(options.log_file.c_str(), "a"));
    Require(file_ != nullptr, "log_file: ", options.log_file, " cannot be written");
  }
  wanted_ = to_console_ || file_ != nullptr;
  table_ = host_;
  table_.context = this;
  table_.log = [](void* context, sy_level level, const char* text) noexcept {
    if (text != nullptr) static_cast<SolveLog*>(context)->Write(level, text);
  };
  table_.extension = [](void* context, const char* id) noexcept {
    const sy_host& host_table = static_cast<SolveLog*>(context)->host_;
    return host_table.extension(host_table.context, id);
  };
  table_.setting = [](void* context, const char* id, const char* name) noexcept {
    const sy_host& host_table = static_cast<SolveLog*>(context)->host_;
    return host_table.setting(host_table.context, id, name);
  };
}

void SolveLog::Write(sy_level level, const char* text) {
  const std::lock_guard lock(writing_);
  for (std::FILE* out : {file_.get(), to_console_ ? stderr : nullptr}) {
    if (out == nullptr) continue;
    std::fputs(text, out);
    std::fputc('\n', out);
    std::fflush(out);
  }
  host_.log(host_.context, level, text);
}

}  // namespace switchyard
