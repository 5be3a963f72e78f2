// coin/host_log.hpp - the messages of a COIN-OR library, to the host instead of standard output.
#pragma once

#include "CoinMessageHandler.hpp"
#include "switchyard/abi.h"

namespace switchyard::coin {

class HostLog : public CoinMessageHandler {
 public:
  explicit HostLog(const sy_host& host) : host_(&host) { setLogLevel(0); }

  /// The libraries set levels of their own on the way; at 0 nothing is heard whatever they set.
  void SetVerbosity(int verbosity) {
    silent_ = verbosity <= 0;
    setLogLevel(silent_ ? 0 : verbosity);
  }

  int print() override {
    if (!silent_ && logLevel() > 0 && host_->log != nullptr) {
      host_->log(host_->context, SY_LOG_INFO, messageBuffer());
    }
    return 0;
  }
  // The base ends the process at a severe message.
  void checkSeverity() override {}
  [[nodiscard]] CoinMessageHandler* clone() const override { return new HostLog(*this); }

 private:
  const sy_host* host_;  // outlives every instance
  bool silent_ = true;
};

}  // namespace switchyard::coin
