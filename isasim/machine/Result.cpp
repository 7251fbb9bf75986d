#include "vorion/isasim/Result.h"

#include "vorion/support/Json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::isasim {

namespace {

using Json = nlohmann::ordered_json;

Json json(const auto &Table, const auto &Counters) {
  Json Object;
  for (const auto &C : Table)
    Object[C.Name] = Counters.*C.Member;
  return Object;
}

Json placesJson(const std::vector<SourcePlace> &Places) {
  Json List = Json::array();
  for (const SourcePlace &P : Places)
    List.push_back({{"file", P.File},
                    {"line", P.Line},
                    {"near", P.IsNear},
                    {"function", P.Function}});
  return List;
}

Json fault(const Trap &T) {
  return {{"cause", describe(T.Cause)},
          {"pc", fmt::format("0x{:08x}", T.Pc)},
          {"core", T.Core},
          {"warp", T.Warp},
          {"lane_mask", fmt::format("0x{:04x}", T.LaneMask)},
          {"lane", T.Lane},
          {"address", fmt::format("0x{:08x}", T.Address)},
          {"instruction", fmt::format("0x{:08x}", T.Instruction)},
          {"symbol", T.Symbol},
          {"source", placesJson(T.Source)}};
}

} // namespace

std::string_view describe(TrapCause Cause) {
  switch (Cause) {
  case TrapCause::IllegalInstruction:
    return "illegal instruction";
  case TrapCause::FetchFault:
    return "instruction fetch fault";
  case TrapCause::MisalignedFetch:
    return "misaligned jump target";
  case TrapCause::LoadFault:
    return "load access fault";
  case TrapCause::StoreFault:
    return "store access fault";
  case TrapCause::MisalignedLoad:
    return "misaligned load";
  case TrapCause::MisalignedStore:
    return "misaligned store";
  case TrapCause::Breakpoint:
    return "breakpoint";
  case TrapCause::EnvironmentCall:
    return "environment call";
  case TrapCause::DivergentBranch:
    return "divergent branch";
  case TrapCause::DivergentJump:
    return "divergent jump";
  case TrapCause::DivergenceOverflow:
    return "divergence stack overflow";
  case TrapCause::DivergenceUnderflow:
    return "vx_join without a split";
  case TrapCause::EmptyMask:
    return "vx_pred leaves no lane active";
  case TrapCause::StackOverflow:
    return "stack overflow";
  case TrapCause::DivergentBarrier:
    return "barrier that not all lanes of the warp have reached";
  case TrapCause::BadBarrier:
    return "no such barrier";
  }
  return "unknown";
}

std::string_view describe(Outcome O) {
  switch (O) {
  case Outcome::Done:
    return "done";
  case Outcome::GuestFailed:
    return "guest failed";
  case Outcome::Trap:
    return "trap";
  case Outcome::Hang:
    return "hang";
  case Outcome::LimitReached:
    return "limit reached";
  }
  return "unknown";
}

std::vector<NamedCounter> counters(const RunResult &R) {
  std::vector<NamedCounter> All;
  for (const auto &C : CoreCounterTable)
    All.push_back({"core", C.Name, C.Doc, R.Total.*C.Member});
  for (const auto &C : RasterCounterTable)
    All.push_back({"raster", C.Name, C.Doc, R.Raster.*C.Member});
  return All;
}

std::string toJson(const RunResult &R) {
  Json Object;
  Object["outcome"] = describe(R.End);
  Object["exit_code"] = R.ExitCode;
  if (R.End == Outcome::Trap)
    Object["trap"] = fault(R.Fault);
  Object["total"] = json(CoreCounterTable, R.Total);
  for (const CoreCounters &C : R.Cores)
    Object["cores"].push_back(json(CoreCounterTable, C));
  Object["raster"] = json(RasterCounterTable, R.Raster);
  if (R.Time)
    Object["time"] = ownJson<Json>(toJson(*R.Time));
  Object["sync_points"] = R.SyncPoints;
  Object["host_seconds"] = R.HostSeconds;
  Object["host_cpu_seconds"] = R.HostCpuSeconds;
  return jsonText(Object, 2) + "\n";
}

} // namespace vorion::isasim
