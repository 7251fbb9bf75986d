// Somebody else's observer: counts what each warp instruction did to memory.
#include <cstdio>
#include <vorion/isasim/Plugin.h>

using namespace vorion::isasim;

namespace {

class Counts : public Observer {
  void commit(const Commit &C) override {
    ++Instructions;
    Lanes += __builtin_popcount(C.LaneMask);
    if (C.Access)
      ++(C.Access->What == MemoryAccess::Load ? Loads : Others);
  }
  void runEnds(const RunResult &) override {
    std::fprintf(stderr,
                 "counts: %llu instructions, %llu loads, %llu other accesses, "
                 "%.1f lanes each\n",
                 Instructions, Loads, Others,
                 static_cast<double>(Lanes) /
                     static_cast<double>(Instructions));
  }

  unsigned long long Instructions = 0, Lanes = 0, Loads = 0, Others = 0;
};

} // namespace

#ifndef VERSION
#define VERSION PluginVersion
#endif
#ifndef LAYOUT
#define LAYOUT pluginLayout()
#endif
const Plugin vorion_plugin = {
    VERSION, LAYOUT,
    []() -> std::unique_ptr<Observer> { return std::make_unique<Counts>(); }};
