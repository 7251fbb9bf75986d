#include "vorion/isasim/Result.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::isasim {

namespace {

using Json = nlohmann::ordered_json;

Json counters(const CoreCounters &C) {
  return {{"warp_instructions", C.WarpInstructions},
          {"lane_instructions", C.LaneInstructions},
          {"loads", C.Loads},
          {"stores", C.Stores},
          {"atomics", C.Atomics},
          {"splits", C.Splits},
          {"divergent_splits", C.DivergentSplits},
          {"parks", C.Parks}};
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
          {"symbol", T.Symbol}};
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

std::string toJson(const RunResult &R) {
  Json Object;
  Object["outcome"] = describe(R.End);
  Object["exit_code"] = R.ExitCode;
  if (R.End == Outcome::Trap)
    Object["trap"] = fault(R.Fault);
  Object["total"] = counters(R.Total);
  for (const CoreCounters &C : R.Cores)
    Object["cores"].push_back(counters(C));
  Object["raster"] = {{"commands", R.Raster.Commands},
                      {"gaussians", R.Raster.Gaussians},
                      {"clipped", R.Raster.Clipped},
                      {"fragments", R.Raster.Fragments},
                      {"blends", R.Raster.Blends}};
  Object["sync_points"] = R.SyncPoints;
  Object["host_seconds"] = R.HostSeconds;
  return Object.dump(2) + "\n";
}

} // namespace vorion::isasim
