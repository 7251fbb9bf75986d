#include "device/CompileNotice.h"

#include "vorion/support/StatusLine.h"

#include <chrono>
#include <fmt/format.h>
#include <utility>

namespace vorion::splat {

static constexpr std::chrono::seconds Patience{2};

CompileNotice::CompileNotice(std::string What,
                             std::function<bool()> IsCompiling)
    : What(std::move(What)), IsCompiling(std::move(IsCompiling)),
      Waiting([this] { waitAndTell(); }) {}

CompileNotice::~CompileNotice() {
  {
    const std::lock_guard Hold(Lock);
    IsOver = true;
  }
  Ended.notify_one();
  Waiting.join();
}

void CompileNotice::waitAndTell() {
  std::unique_lock Hold(Lock);
  if (!Ended.wait_for(Hold, Patience, [this] { return IsOver; }) &&
      IsCompiling())
    showStatus(fmt::format("splat: compiling {} ...", What));
}

} // namespace vorion::splat
