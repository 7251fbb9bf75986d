#include "observe/gdb/Target.h"

#include "core/Core.h"
#include "core/HostFp.h"
#include "core/IsaTables.h"
#include "core/Rounding.h"
#include "vorion/isasim/Machine.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace vorion::isasim::gdb {

namespace {

// Numbers of registers. x0 to x31, pc, f0 to f31 and the three after them are
// as gdb numbers RISC-V's; the rest is ours.
enum Register : unsigned {
  Pc = PcNumber,
  FirstF = 33,
  Fflags = 65,
  Frm,
  Fcsr,
  Mask,
  Depth,
  NumRegisters
};

constexpr const char *XNames[] = {
    "zero", "ra", "sp", "gp", "tp",  "t0",  "t1", "t2", "fp", "s1", "a0",
    "a1",   "a2", "a3", "a4", "a5",  "a6",  "a7", "s2", "s3", "s4", "s5",
    "s6",   "s7", "s8", "s9", "s10", "s11", "t3", "t4", "t5", "t6"};
constexpr const char *FNames[] = {
    "ft0", "ft1", "ft2",  "ft3",  "ft4", "ft5", "ft6",  "ft7",
    "fs0", "fs1", "fa0",  "fa1",  "fa2", "fa3", "fa4",  "fa5",
    "fa6", "fa7", "fs2",  "fs3",  "fs4", "fs5", "fs6",  "fs7",
    "fs8", "fs9", "fs10", "fs11", "ft8", "ft9", "ft10", "ft11"};

std::string entry(const char *Name, const char *Type) {
  return fmt::format("<reg name=\"{}\" bitsize=\"32\" type=\"{}\"/>", Name,
                     Type);
}

constexpr unsigned FrmShift = 5; ///< in fcsr

} // namespace

void Target::begin(const RunStart &R) {
  const Config &Shape = R.Shape;
  Device = R.Device;
  Program = &R.Program;
  Cores = R.Cores;
  WarpsPerCore = Shape.WarpsPerCore;
  Lanes = Shape.LanesPerWarp;
  Warps = Shape.cores() * WarpsPerCore;
}

ThreadId Target::threadOf(const WarpState &S, unsigned Lane) const {
  return 1 + (S.Owner->id() * WarpsPerCore + S.WarpId) * Lanes + Lane;
}

WarpState *Target::warpOf(ThreadId T) const {
  const unsigned Warp = (T - 1) / Lanes;
  return T == 0 || Warp >= Warps
             ? nullptr
             : &Cores[Warp / WarpsPerCore]->warps()[Warp % WarpsPerCore];
}

bool Target::isActive(ThreadId T) const {
  const WarpState *S = warpOf(T);
  return S && S->Why != Stop::Ended && (S->Mask >> laneOf(T) & 1);
}

bool Target::isAlive(ThreadId T) const {
  const WarpState *S = warpOf(T);
  return S && S->Why != Stop::Ended;
}

std::string Target::describe(ThreadId T) const {
  return fmt::format("core {}, warp {}, lane {}, {}", coreOf(T),
                     (T - 1) / Lanes % WarpsPerCore, laneOf(T),
                     isActive(T) ? "active" : "off");
}

/// Where the lane goes on: one that waits for the other side of a split begins
/// there; any other that is off goes on with its warp.
uint32_t Target::pc(ThreadId T) const {
  const WarpState &S = *warpOf(T);
  if (const auto Other = Shown.find(T); Other != Shown.end())
    return Other->second;
  for (uint32_t D = S.StackDepth; D-- != 0 && !isActive(T);)
    if (S.Stack[D].Other >> laneOf(T) & 1)
      return S.pcOf(S.Stack[D].Pc);
  return S.pcOf(S.Next);
}

std::optional<uint32_t> Target::readRegister(ThreadId T, unsigned N) const {
  WarpState *S = warpOf(T);
  if (!S || N >= NumRegisters)
    return std::nullopt;
  switch (N) {
  case Pc:
    return pc(T);
  case Fflags:
    return S->Fflags;
  case Frm:
    return S->Frm;
  case Fcsr:
    return S->Frm << FrmShift | S->Fflags;
  case Mask:
    return S->Mask;
  case Depth:
    return S->StackDepth;
  default:
    break;
  }
  const unsigned Index = N < Pc ? XBase + N : FBase + (N - FirstF);
  return S->lanes(Index * sizeof(LaneWords))[laneOf(T)];
}

std::string Target::registers(ThreadId T) const {
  std::string Bytes;
  for (unsigned N = 0; N != NumRegisters; ++N) {
    const uint32_t Value = readRegister(T, N).value_or(0);
    Bytes.append(reinterpret_cast<const char *>(&Value), sizeof(Value));
  }
  return Bytes;
}

bool Target::writeRegister(ThreadId T, unsigned N, uint32_t Value) {
  WarpState *S = warpOf(T);
  // gdb writes everything back after a call.
  if (!S || N == 0 || (N >= Fflags && N != Fflags && N != Frm) || N == Pc)
    return readRegister(T, N) == Value;
  if (N == Fflags)
    S->Fflags = Value & 31;
  else if (N == Frm) {
    const HostFp Host; // which may be another warp's
    setFrm(S, Value & 7);
  } else {
    uint32_t *Word = &S->lanes((N < Pc ? XBase + N : FBase + (N - FirstF)) *
                               sizeof(LaneWords))[laneOf(T)];
    Writes.push_back({Word, std::exchange(*Word, Value)});
  }
  return true;
}

void Target::undo(const std::vector<RegisterWrite> &Writes) {
  for (auto W = Writes.rbegin(); W != Writes.rend(); ++W)
    *W->Word = W->Before;
}

std::string Target::readMemory(ThreadId T, uint32_t Address,
                               uint32_t Bytes) const {
  std::string Result;
  const WarpState *S = warpOf(T);
  for (uint32_t N = 0; N != Bytes; ++N) {
    const uint32_t At = Address + N;
    char Byte = 0;
    if (S && S->Mem->Local.Host && At - S->Mem->Local.Lo < S->Mem->Local.Bytes)
      Byte = static_cast<char>(*S->Mem->Local.at(At));
    else if (!Device->read(At, std::as_writable_bytes(std::span(&Byte, 1))))
      break;
    Result += Byte;
  }
  return Result;
}

bool Target::writeMemory(ThreadId T, uint32_t Address, std::string_view Bytes) {
  const WarpState *S = warpOf(T);
  for (uint32_t N = 0; N != Bytes.size(); ++N) {
    const uint32_t At = Address + N;
    const bool IsCode = std::any_of(
        program().segments().begin(), program().segments().end(),
        [At](const Image::Segment &Part) {
          return Part.Executable && At - Part.Address < Part.MemBytes;
        });
    if (IsCode)
      return false;
    if (S && At - S->Mem->Local.Lo < S->Mem->Local.Bytes)
      *S->Mem->Local.at(At) = static_cast<std::byte>(Bytes[N]);
    else if (!Device->write(At, std::as_bytes(std::span(&Bytes[N], 1))))
      return false;
  }
  return true;
}

std::string Target::description() {
  std::string Text =
      "<?xml version=\"1.0\"?><!DOCTYPE target SYSTEM \"gdb-target.dtd\">"
      "<target "
      "version=\"1.0\"><architecture>riscv:rv32</architecture><osabi>none</"
      "osabi>"
      "<feature name=\"org.gnu.gdb.riscv.cpu\">";
  for (const char *Name : XNames)
    Text += entry(Name, Name == XNames[SpNumber] ? "data_ptr" : "int");
  Text += entry("pc", "code_ptr");
  Text += "</feature><feature name=\"org.gnu.gdb.riscv.fpu\">";
  for (const char *Name : FNames)
    Text += entry(Name, "ieee_single");
  for (const char *Name : {"fflags", "frm", "fcsr"})
    Text += entry(Name, "int");
  Text += "</feature><feature name=\"org.vorion.simt\">";
  // Active lanes of the warp, and its splits that are not joined.
  for (const char *Name : {"mask", "depth"})
    Text += entry(Name, "int");
  return Text + "</feature></target>";
}

} // namespace vorion::isasim::gdb
