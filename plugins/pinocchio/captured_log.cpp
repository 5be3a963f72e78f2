#include "captured_log.hpp"

#include <console_bridge/console.h>

namespace switchyard::dynamics {
namespace {

std::mutex one_at_a_time;

class Capture : public console_bridge::OutputHandler {
 public:
  void log(const std::string& text, console_bridge::LogLevel level, const char* file,
           int line) override {
    if (!captures_here) {
      if (before != nullptr) before->log(text, level, file, line);
    } else if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR &&
               lines.find(text) == std::string::npos) {  // geometry is read apart: said again
      if (!lines.empty()) lines += "; ";
      lines += text;
    }
  }

  console_bridge::OutputHandler* before = nullptr;
  std::string lines;
  static thread_local bool captures_here;
};

thread_local bool Capture::captures_here = false;

// Never destroyed: another thread may be in it when the process ends.
Capture& TheCapture() {
  static Capture& capture = *new Capture;
  return capture;
}

}  // namespace

CapturedLog::CapturedLog() : alone_(one_at_a_time) {
  Capture& capture = TheCapture();
  capture.before = console_bridge::getOutputHandler();
  capture.lines.clear();
  Capture::captures_here = true;
  console_bridge::useOutputHandler(&capture);
}

CapturedLog::~CapturedLog() {
  console_bridge::useOutputHandler(TheCapture().before);
  Capture::captures_here = false;
}

std::string CapturedLog::Text() const { return TheCapture().lines; }

// "From file: ...", "in function: ...", "at line: ...", "message: what is wrong", or one line.
std::string Sentence(const std::string& text) {
  const std::string mark = "message:";
  const std::size_t at = text.find(mark);
  const std::size_t from =
      at != std::string::npos ? text.find_first_not_of(" \n", at + mark.size()) : 0;
  if (from == std::string::npos) return text;
  return text.substr(from, text.find('\n', from) - from);
}

}  // namespace switchyard::dynamics
