#pragma once

#include <mutex>
#include <string>

namespace switchyard::dynamics {

/// While it lives, what the URDF library says on this thread of errors is kept, and not written to
/// stderr; what other threads of the process write by the same logging library goes where it went.
/// One at a time.
class CapturedLog {
 public:
  CapturedLog();
  CapturedLog(const CapturedLog&) = delete;
  CapturedLog& operator=(const CapturedLog&) = delete;
  ~CapturedLog();

  /// What was said of errors so far, as one line.
  [[nodiscard]] std::string Text() const;

 private:
  std::unique_lock<std::mutex> alone_;
};

/// Of what the library says in several lines, the one that says it.
std::string Sentence(const std::string& text);

}  // namespace switchyard::dynamics
