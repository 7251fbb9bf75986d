// Policies that do what they must not.
#include <vorion/isasim/Plugin.h>

using namespace vorion::isasim;

namespace {

struct NoWay : Replacement {
  void use(const LineUse &) override {}
  Victim victim(uint32_t) override { return {9}; }
  void clear() override {}
};

struct NoWarp : WarpScheduler {
  IssueSlot first(uint64_t, uint32_t,
                  std::span<const WarpToIssue>) const override {
    return {};
  }
};

} // namespace

const Plugin vorion_plugin = {
    .Policies = {
        .Cache = [](const CacheInfo &) -> std::unique_ptr<Replacement> {
          return std::make_unique<NoWay>();
        },
        .Warps = [](const CoreInfo &) -> std::unique_ptr<WarpScheduler> {
          return std::make_unique<NoWarp>();
        }}};
