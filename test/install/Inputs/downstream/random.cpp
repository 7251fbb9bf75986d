// Somebody else's replacement: a core's data cache replaces any line of a set,
// as a generator of random numbers says.
#include <string_view>
#include <vorion/isasim/Plugin.h>

using namespace vorion::isasim;

namespace {

class Random : public Replacement {
public:
  explicit Random(const CacheInfo &Of) : Ways(Of.Ways), State(1 + Of.Number) {}

  void use(const LineUse &) override {}
  Victim victim(uint32_t) override {
    State ^= State << 13;
    State ^= State >> 17;
    State ^= State << 5;
    return {State % Ways};
  }
  void clear() override {}

private:
  uint32_t Ways, State;
};

std::unique_ptr<Replacement> make(const CacheInfo &Of) {
  if (std::string_view(Of.Name) != "core")
    return nullptr; // which keeps its own
  return std::make_unique<Random>(Of);
}

} // namespace

const Plugin vorion_plugin = {.Policies = {.Cache = make}};
