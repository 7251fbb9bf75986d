/// Lines about what happens, by category (docs/trace-format.md).
#include "core/Core.h"
#include "core/Isa.h"
#include "machine/Report.h"
#include "observe/CodeText.h"
#include "observe/NameList.h"
#include "observe/Tool.h"
#include "raster/WorkLog.h"
#include "vorion/isasim/Machine.h"
#include "vorion/isasim/Observer.h"
#include "vorion/support/Expected.h"
#include "vorion/support/GrowingFile.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace vorion::isasim {

/// What `--trace` asks for.
struct TraceRequest {
  /// One bit for each line of TraceCategories.def.
  uint32_t Categories = 0;
  std::string File; ///< empty for stderr

  /// "cat,cat[:FILE]"; "all" stands for every category.
  static Expected<TraceRequest> parse(std::string_view Text);
};

class Trace : public Observer {
public:
  /// Writes to \p OutIn, which must outlive the trace; the header at once.
  Trace(std::FILE *OutIn, uint32_t CategoriesIn);

  void runBegins(const RunStart &R) override;
  void commit(const Commit &C) override;
  void syncPoint(std::span<const std::unique_ptr<Core>> Cores) override;
  void rasterCommand(const raster::CommandWork &W) override;
  void tail(const raster::TailWork &W) override;
  void trap(const Trap &T) override;
  void runEnds(const RunResult &R) override;

private:
  enum class Category : unsigned;
  bool wants(Category C) const {
    return Categories >> static_cast<unsigned>(C) & 1;
  }

  /// What is the same each time that an instruction executes.
  struct Texts {
    std::string Place, Instruction;
  };
  const Texts &textsOf(const Step &S);

  std::FILE *Out;
  uint32_t Categories;
  std::shared_ptr<const Image> Program;
  unsigned CoresPerSocket = 1, CoresPerCluster = 1;
  std::unordered_map<uint32_t, Texts> ByPc; ///< of the program
  uint64_t Runs = 0, SyncPoints = 0;
};

namespace {

/// Changes with every change of a line's form (docs/trace-format.md).
constexpr int FormatVersion = 1;

constexpr std::string_view Names[] = {
#define VORION_TRACE(NAME) #NAME,
#include "observe/TraceCategories.def"
};

void appendWord(std::string &To, uint32_t Value) {
  // Most of a trace is made of these: eight times faster than a format string.
  constexpr char Digits[] = "0123456789abcdef";
  To += ' ';
  for (int Shift = 28; Shift >= 0; Shift -= 4)
    To += Digits[Value >> Shift & 15];
}

/// " value" if all active lanes agree, else the value of each active lane.
std::string laneWords(std::span<const uint32_t> Values, uint32_t Mask) {
  std::string Text;
  bool Same = true;
  const uint32_t *First = nullptr;
  for (size_t L = 0; L != Values.size(); ++L) {
    if (!(Mask >> L & 1))
      continue;
    if (!First)
      First = &Values[L];
    Same &= Values[L] == *First;
    appendWord(Text, Values[L]);
  }
  if (First && Same) {
    Text.clear();
    appendWord(Text, *First);
  }
  return Text;
}

bool isSimt(Op O) {
  switch (O) {
  case Op::VX_TMC:
  case Op::VX_WSPAWN:
  case Op::VX_SPLIT:
  case Op::VX_SPLIT_N:
  case Op::VX_JOIN:
  case Op::VX_BAR:
  case Op::VX_PRED:
  case Op::VX_PRED_N:
    return true;
  default:
    return false;
  }
}

std::string_view nameOf(MemoryAccess::Kind Kind) {
  switch (Kind) {
  case MemoryAccess::Load:
    return "load";
  case MemoryAccess::Store:
    return "store";
  case MemoryAccess::Atomic:
    return "atomic";
  }
  return "?";
}

/// The tile and the list of a command, as in its CSRs.
std::string tileAndList(const raster::Job &J) {
  using namespace raster;
  return fmt::format("origin 0x{:08x} shape 0x{:08x} list 0x{:08x} count {}",
                     TileOriginX.put(J.X) | TileOriginY.put(J.Y),
                     TileShapeWidth.put(J.Width) |
                         TileShapeHeight.put(J.Height),
                     J.List, J.Count);
}

} // namespace

Expected<TraceRequest> TraceRequest::parse(std::string_view Text) {
  TraceRequest R;
  const size_t Colon = Text.find(':');
  if (Colon != std::string_view::npos)
    R.File = Text.substr(Colon + 1);
  const Expected<uint32_t> Listed = parseNameList(
      "trace category", Text.substr(0, Colon), Names, ", followed by :FILE");
  if (!Listed)
    return Listed.error();
  R.Categories = *Listed;
  return R;
}

Trace::Trace(std::FILE *OutIn, uint32_t CategoriesIn)
    : Out(OutIn), Categories(CategoriesIn) {
  append(Out, "# vorion-trace {}\n", FormatVersion);
}

enum class Trace::Category : unsigned {
#define VORION_TRACE(NAME) NAME,
#include "observe/TraceCategories.def"
};

const Trace::Texts &Trace::textsOf(const Step &S) {
  Texts &Known = ByPc[S.Pc];
  if (Known.Place.empty())
    Known = {fmt::format("0x{:08x} <{}>", S.Pc, Program->symbolize(S.Pc)),
             instructionText(S.Word, S.Pc)};
  return Known;
}

void Trace::runBegins(const RunStart &R) {
  if (Program != R.Program)
    ByPc.clear();
  Program = R.Program;
  SyncPoints = 0;
  CoresPerSocket = R.Shape.CoresPerSocket;
  CoresPerCluster = R.Shape.coresPerCluster();
  append(Out, "run {} {} launch 0x{:08x}\n", ++Runs, Program->name(),
         R.LaunchBlock);
}

void Trace::commit(const Commit &C) {
  if (wants(Category::insn) ||
      (wants(Category::simt) && isSimt(C.Insn.Opcode))) {
    std::string Result;
    for (const std::span<const uint32_t> Register : {C.Result, C.HighResult})
      if (!Register.empty())
        Result += " ->" + laneWords(Register, C.LaneMask);
    const Texts &T = textsOf(C);
    append(Out, "{} {}.{} {} {:04x} {}{}\n",
           wants(Category::insn) ? "insn" : "simt", C.Core, C.Warp, T.Place,
           C.LaneMask, T.Instruction, Result);
  }
  if (C.Access && wants(Category::mem))
    append(Out, "mem {}.{} 0x{:08x} {:04x} {} {}{}\n", C.Core, C.Warp, C.Pc,
           C.LaneMask, nameOf(C.Access->What), C.Access->Bytes,
           laneWords(C.Access->Addresses, C.LaneMask));
}

void Trace::syncPoint(std::span<const std::unique_ptr<Core>> Cores) {
  ++SyncPoints;
  if (!wants(Category::sync))
    return;
  append(Out, "sync {}\n", SyncPoints);
  for (const auto &C : Cores)
    for (const WarpState &S : std::as_const(*C).warps())
      if (S.Why != Stop::Ended)
        append(Out, "sync {}.{} 0x{:08x} {}\n", C->id(), S.WarpId,
               S.pcOf(S.Next), waitsFor(S));
}

void Trace::rasterCommand(const raster::CommandWork &W) {
  if (wants(Category::raster))
    append(Out,
           "raster {} core {} {} output 0x{:08x} gaussians {} clipped {} "
           "fragments {} blends {}\n",
           W.Core / CoresPerSocket, W.Core, tileAndList(W.What), W.What.Output,
           W.Counts.Gaussians, W.Counts.Clipped, W.Counts.Fragments,
           W.Counts.Blends);
}

void Trace::tail(const raster::TailWork &W) {
  if (wants(Category::raster))
    append(Out, "tail {} core {} {} pixels {} visits {} blends {}\n",
           W.Core / CoresPerCluster, W.Core, tileAndList(W.What),
           W.Counts.TailPixels, W.Counts.TailVisits, W.Counts.TailBlends);
}

void Trace::trap(const Trap &T) {
  if (wants(Category::trap))
    append(Out, "trap {}.{} 0x{:08x} <{}> {:04x} lane {} {} 0x{:08x}\n", T.Core,
           T.Warp, T.Pc, T.Symbol, T.LaneMask, T.Lane, describe(T.Cause),
           T.Address);
}

void Trace::runEnds(const RunResult &R) {
  append(Out, "end {} exit {} instructions {}\n", describe(R.End), R.ExitCode,
         R.Total.WarpInstructions);
  std::fflush(Out);
}

namespace {

class TraceTool : public Tool {
public:
  TraceTool(std::optional<GrowingFile> FileIn, uint32_t Categories)
      : File(std::move(FileIn)),
        Lines(File ? File->stream() : stderr, Categories) {}
  std::vector<Observer *> observers() override { return {&Lines}; }
  Expected<Success> runEnded(const std::string &, const RunResult &) override {
    return File ? File->complete() : Success{};
  }

private:
  std::optional<GrowingFile> File;
  Trace Lines;
};

Expected<std::unique_ptr<Tool>> make(const std::string &Text,
                                     const ToolOutput &) {
  const Expected<TraceRequest> Request = TraceRequest::parse(Text);
  if (!Request)
    return Request.error();
  std::optional<GrowingFile> File;
  if (!Request->File.empty()) {
    Expected<GrowingFile> Opened = GrowingFile::open(Request->File);
    if (!Opened)
      return Opened.error();
    File = std::move(*Opened);
  }
  return std::unique_ptr<Tool>(
      std::make_unique<TraceTool>(std::move(File), Request->Categories));
}

std::vector<NamedFile> outputs(const std::string &Text) {
  const Expected<TraceRequest> Request = TraceRequest::parse(Text);
  return Request ? std::vector<NamedFile>{{"--trace", Request->File}}
                 : std::vector<NamedFile>{};
}

} // namespace

const ToolKind tools::Trace{.Make = make, .Outputs = outputs, .Names = Names};

} // namespace vorion::isasim
