// Somebody else's scheduler of DRAM: first come, first served.
#include <vorion/isasim/Plugin.h>

using namespace vorion::isasim;

namespace {

class Fcfs : public DramScheduler {
  uint64_t rank(const DramCandidate &C) const override { return C.Order; }
};

} // namespace

const Plugin vorion_plugin = {
    .Policies = {
        .Dram = [](const DramInfo &) -> std::unique_ptr<DramScheduler> {
          return std::make_unique<Fcfs>();
        }}};
