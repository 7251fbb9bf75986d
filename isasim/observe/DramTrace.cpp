/// `--dram-trace`: what DRAM was asked for and what its controllers did, for
/// other people's models (docs/debugging.md).

#include "observe/Tool.h"
#include "timing/common/TimeObserver.h"
#include "vorion/isasim/Machine.h"
#include "vorion/support/GrowingFile.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace vorion::isasim {

namespace {

std::string requestsOf(const std::string &Prefix) {
  return Prefix + ".requests";
}

std::string commandsOf(const std::string &Prefix, unsigned Channel) {
  return fmt::format("{}.{}.commands", Prefix, Channel);
}

/// As DRAMPower calls it.
std::string_view commandName(dram::Command C) {
  return C == dram::Command::RefreshBank ? "REFB" : name(C);
}

class DramTraceTool : public Tool, public TimeObserver {
public:
  DramTraceTool(std::string PrefixIn, GrowingFile RequestsIn)
      : Prefix(std::move(PrefixIn)), Requests(std::move(RequestsIn)) {}

  std::vector<TimeObserver *> timeObservers() override { return {this}; }
  Expected<Success> attach(Machine &M) override;
  Expected<Success> runEnded(const std::string &, const RunResult &) override;

  void dramRequest(unsigned, uint32_t Address, bool IsWrite) override {
    append(Requests.stream(), "0x{:08x} {}\n", Address, IsWrite ? 'W' : 'R');
  }
  void dramCommand(unsigned Number, const dram::Issued &What,
                   CycleSpan) override {
    // Other models take both halves of an activation for one command.
    if (What.What == dram::Command::Activate2)
      return;
    Channels[Number].Issued.push_back(What);
  }

private:
  struct Channel {
    GrowingFile Commands;
    std::vector<dram::Issued> Issued; ///< in this run
  };
  std::string Prefix;
  GrowingFile Requests;
  std::vector<Channel> Channels;
};

Expected<Success> DramTraceTool::attach(Machine &M) {
  Channels.clear();
  for (unsigned N = 0; N != M.config().Timing.Dram.Channels; ++N) {
    auto File = GrowingFile::open(commandsOf(Prefix, N));
    if (!File)
      return File.error();
    Channels.push_back({std::move(*File), {}});
  }
  return Success{};
}

Expected<Success> DramTraceTool::runEnded(const std::string &,
                                          const RunResult &) {
  for (Channel &C : Channels) {
    // A device with two command buses may have two under way.
    std::ranges::sort(C.Issued, {}, [](const dram::Issued &I) {
      return std::pair(I.At, I.What);
    });
    for (const dram::Issued &I : C.Issued)
      append(C.Commands.stream(), "{},{},{}\n", I.At, commandName(I.What),
             I.Where.Bank);
    C.Issued.clear();
    if (const Expected<Success> Done = C.Commands.complete(); !Done)
      return Done;
  }
  return Requests.complete();
}

Expected<std::unique_ptr<Tool>> make(const std::string &Text,
                                     const ToolOutput &) {
  Expected<GrowingFile> Requests = GrowingFile::open(requestsOf(Text));
  if (!Requests)
    return Requests.error();
  return std::unique_ptr<Tool>(
      std::make_unique<DramTraceTool>(Text, std::move(*Requests)));
}

/// How many channels there are is not known here.
std::vector<NamedFile> outputs(const std::string &Text) {
  return {{"--dram-trace", requestsOf(Text)},
          {"--dram-trace", commandsOf(Text, 0)}};
}

} // namespace

const ToolKind tools::DramTrace{
    .Make = make, .Outputs = outputs, .NeedsClock = true};

} // namespace vorion::isasim
