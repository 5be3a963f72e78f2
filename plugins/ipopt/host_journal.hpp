// host_journal.hpp - what Ipopt prints, to the host instead of standard output.
#pragma once

#include <cstdarg>
#include <cstdio>
#include <string>

#include "IpJournalist.hpp"
#include "switchyard/abi.h"

namespace switchyard::ipopt {

/// Ipopt prints pieces of lines; the host gets whole ones. The name is that of Ipopt's own journal
/// of standard output, whose level it sets by its option print_level.
class HostJournal : public Ipopt::Journal {
 public:
  explicit HostJournal(const sy_host& host) : Journal("console", Ipopt::J_NONE), host_(host) {}
  ~HostJournal() override { FlushBufferImpl(); }
  HostJournal(const HostJournal&) = delete;
  HostJournal& operator=(const HostJournal&) = delete;

 protected:
  void PrintImpl(Ipopt::EJournalCategory, Ipopt::EJournalLevel level, const char* text) override {
    line_ += text;
    for (std::size_t end; (end = line_.find('\n')) != std::string::npos;) {
      Send(level, line_.substr(0, end));
      line_.erase(0, end + 1);
    }
  }
  void PrintfImpl(Ipopt::EJournalCategory category, Ipopt::EJournalLevel level, const char* format,
                  std::va_list values) override {
    std::va_list again;
    va_copy(again, values);
    const int length = std::vsnprintf(nullptr, 0, format, again);
    va_end(again);
    if (length < 0) return;
    std::string text(static_cast<std::size_t>(length) + 1, '\0');
    std::vsnprintf(text.data(), text.size(), format, values);
    PrintImpl(category, level, text.c_str());
  }
  void FlushBufferImpl() override {
    if (!line_.empty()) Send(Ipopt::J_SUMMARY, line_);
    line_.clear();
  }

 private:
  void Send(Ipopt::EJournalLevel level, const std::string& line) {
    if (host_.log == nullptr) return;
    host_.log(host_.context, level == Ipopt::J_ERROR ? SY_LOG_ERROR : SY_LOG_INFO, line.c_str());
  }

  const sy_host& host_;  // outlives every instance
  std::string line_;
};

}  // namespace switchyard::ipopt
