// A user's warp scheduler: of the warps that can issue earliest, the one with
// the lowest number goes first.
#include <vorion/isasim/Plugin.h>

using namespace vorion::isasim;

namespace {

class Oldest : public WarpScheduler {
  IssueSlot first(uint64_t, uint32_t,
                  std::span<const WarpToIssue> Warps) const override {
    IssueSlot First;
    for (const WarpToIssue &W : Warps)
      if (W.ReadyAt < First.Cycle ||
          (W.ReadyAt == First.Cycle && W.Warp < First.Warp))
        First = {W.Warp, W.ReadyAt};
    return First;
  }
};

} // namespace

const Plugin vorion_plugin = {
    .Policies = {
        .Warps = [](const CoreInfo &) -> std::unique_ptr<WarpScheduler> {
          return std::make_unique<Oldest>();
        }}};
