// objdump can ask a server for debug information; that would need libcurl, and
// nothing here is to reach the network.
#include "llvm/Debuginfod/BuildIDFetcher.h"
#include "llvm/Debuginfod/Debuginfod.h"
#include "llvm/Debuginfod/HTTPClient.h"

namespace llvm {
std::optional<std::string> DebuginfodFetcher::fetch(object::BuildIDRef) const {
  return std::nullopt;
}
bool canUseDebuginfod() { return false; }
void HTTPClient::initialize() {}
} // namespace llvm
