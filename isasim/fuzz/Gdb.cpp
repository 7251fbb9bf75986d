#include "fuzz/Targets.h"

#include "observe/gdb/GdbServer.h"
#include "testing/Encode.h"
#include "vorion/isasim/Machine.h"

#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace vorion::isasim::fuzz {

namespace {

using testing::encode;

constexpr uint64_t GlobalBytes = 4 << 10;
constexpr uint64_t MaxInstructions = 20000;
/// Byte offsets of functions in the program.
constexpr uint32_t Square = 4, Fault = 12, Park = 20;

Config shape() {
  Config C;
  C.Clusters = C.SocketsPerCluster = 1;
  C.CoresPerSocket = 2;
  C.WarpsPerCore = 2;
  C.GlobalBytes = GlobalBytes;
  C.LocalBytes = C.StackBytes = 4 << 10;
  C.Quantum = 64;
  C.MaxInstructions = MaxInstructions;
  C.HostThreads = 1;
  return C;
}

/// Counts in global memory, half of the lanes by calls.
std::shared_ptr<const Image> program() {
  const auto Return = encode(Op::RV_JALR, {.Rs1 = 1});
  std::vector<uint32_t> Code = {
      encode(Op::RV_JAL, {.Rd = 0, .Imm = 28}), // to begin
      // Square, Fault, Park
      encode(Op::RV_MUL, {.Rd = 10, .Rs1 = 10, .Rs2 = 10}),
      Return,
      encode(Op::RV_LW, {.Rd = 10, .Imm = 0}),
      Return,
      encode(Op::RV_AMOSWAP_W, {.Rd = 10, .Rs1 = 9, .Rs2 = 10}),
      Return,
      // begin
      encode(Op::RV_LUI, {.Rd = 5, .Imm = 0x10}),
      encode(Op::RV_ADDI, {.Rd = 5, .Rs1 = 5, .Imm = -1}),
      encode(Op::VX_TMC, {.Rs1 = 5}),
      encode(Op::RV_LUI, {.Rd = 9, .Imm = VX_GLOBAL_BASE >> 12}),
      encode(Op::RV_LUI, {.Rd = 2, .Imm = VX_STACK_TOP >> 12}),
      encode(Op::RV_CSRRS, {.Rd = 6, .Csr = CSR_MHARTID}),
      encode(Op::RV_SLLI, {.Rd = 7, .Rs1 = 6, .Imm = 12}),
      encode(Op::RV_SUB, {.Rd = 2, .Rs1 = 2, .Rs2 = 7}),
      encode(Op::RV_ADDI, {.Rd = 2, .Rs1 = 2, .Imm = -64}),
      encode(Op::RV_SH2ADD, {.Rd = 9, .Rs1 = 6, .Rs2 = 9}),
      encode(Op::RV_ADDI, {.Rd = 8, .Imm = 20}),
  };
  // Again and again: the odd lanes call.
  const auto Loop = static_cast<int32_t>(Code.size() * 4);
  Code.push_back(encode(Op::VX_SPLIT, {.Rd = 11, .Rs1 = 6}));
  Code.push_back(encode(Op::RV_ADDI, {.Rd = 10, .Rs1 = 8}));
  Code.push_back(
      encode(Op::RV_JAL, {.Rd = 1,
                          .Imm = static_cast<int32_t>(Square) -
                                 static_cast<int32_t>(Code.size() * 4)}));
  Code.push_back(encode(Op::VX_JOIN, {.Rs1 = 11}));
  Code.push_back(encode(Op::RV_LW, {.Rd = 12, .Rs1 = 9}));
  Code.push_back(encode(Op::RV_ADD, {.Rd = 12, .Rs1 = 12, .Rs2 = 10}));
  Code.push_back(encode(Op::RV_SW, {.Rs1 = 9, .Rs2 = 12}));
  Code.push_back(encode(Op::RV_ADDI, {.Rd = 8, .Rs1 = 8, .Imm = -1}));
  Code.push_back(encode(Op::RV_BNE,
                        {.Rs1 = 8,
                         .Rs2 = 0,
                         .Imm = Loop - static_cast<int32_t>(Code.size() * 4)}));
  Code.push_back(encode(Op::VX_TMC, {.Rs1 = 0}));
  Image::Segment S;
  S.Address = VX_IMAGE_BASE;
  S.MemBytes = static_cast<uint32_t>(Code.size() * 4);
  const auto Raw = std::as_bytes(std::span(Code));
  S.Bytes.assign(Raw.begin(), Raw.end());
  S.Executable = true;
  return Image::raw(std::move(S), "fuzz");
}

struct Outcomes {
  RunResult Result;
  std::vector<std::byte> Global;
};

Outcomes run(Observer *Watcher) {
  auto M = Machine::create(shape());
  if (!M) // the host has no memory for it
    std::abort();
  if (Watcher)
    (*M)->setObservers({Watcher});
  (*M)->load(program());
  Outcomes O;
  O.Result = (*M)->run();
  O.Global.resize(GlobalBytes);
  (*M)->read(VX_GLOBAL_BASE, O.Global);
  return O;
}

struct Session {
  std::string Packets;
  bool ReadsOnly = true; ///< no packet can change anything
};

/// "$LINE#sum" for each line, and lines that begin with '!' as they are.
Session sessionOf(std::string_view Text) {
  constexpr std::string_view Changing = "PMGXk";
  Session S;
  while (!Text.empty()) {
    const std::string_view Line = Text.substr(0, Text.find('\n'));
    Text.remove_prefix(std::min(Text.size(), Line.size() + 1));
    if (Line.starts_with('!')) {
      S.Packets += Line.substr(1);
      S.ReadsOnly &= Line.find_first_of(Changing) == std::string_view::npos;
      continue;
    }
    unsigned Sum = 0;
    for (const char C : Line)
      Sum += static_cast<unsigned char>(C);
    S.Packets += fmt::format("${}#{:02x}", Line, Sum & 0xFF);
    S.ReadsOnly &=
        Line.substr(0, 1).find_first_of(Changing) == std::string_view::npos;
  }
  return S;
}

/// Register \p Number as 'P' has it.
std::string setRegister(unsigned Number, uint32_t Value) {
  return fmt::format("P{:x}={:08x}\n", Number, __builtin_bswap32(Value));
}

/// What gdb sends for a call of the function at \p Offset, with breakpoint and
/// return.
std::string call(uint32_t Offset, uint32_t Stack) {
  const uint32_t Entry = VX_IMAGE_BASE + Offset;
  return fmt::format("M{:x},4:13000000\n", Stack) + setRegister(10, 7) +
         setRegister(1, Stack) + setRegister(2, Stack - 16) +
         setRegister(32, Entry) + fmt::format("Z0,{:x},4\nvCont;c\n", Stack) +
         "g\n" + fmt::format("z0,{:x},4\n", Stack);
}

} // namespace

void debug(std::span<const std::byte> Bytes) {
  const Session Said =
      sessionOf({reinterpret_cast<const char *>(Bytes.data()), Bytes.size()});
  int Ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, Ends) != 0)
    std::abort();
  // The debugger: says everything, and hears everything.
  std::thread Debugger([&] {
    std::string_view Rest = Said.Packets;
    while (!Rest.empty()) {
      const ssize_t Sent =
          send(Ends[1], Rest.data(), std::min<size_t>(Rest.size(), 512),
               MSG_NOSIGNAL | MSG_DONTWAIT);
      if (Sent > 0)
        Rest.remove_prefix(static_cast<size_t>(Sent));
      char Answer[4096];
      if (recv(Ends[1], Answer, sizeof(Answer), MSG_DONTWAIT) == 0)
        break;
    }
    shutdown(Ends[1], SHUT_WR);
    for (char Answer[4096]; recv(Ends[1], Answer, sizeof(Answer), 0) > 0;)
      ;
  });
  Outcomes Debugged;
  {
    const std::unique_ptr<Observer> Server = serveGdb(Ends[0]);
    Debugged = run(Server.get());
  }
  Debugger.join();
  close(Ends[1]);
  if (!Said.ReadsOnly)
    return;
  static const Outcomes Plain = run(nullptr);
  if (Plain.Result.End != Debugged.Result.End ||
      Plain.Result.Total.WarpInstructions !=
          Debugged.Result.Total.WarpInstructions ||
      Plain.Global != Debugged.Global) {
    std::fprintf(stderr, "a debugger that only looks has changed the run\n");
    std::abort();
  }
}

std::vector<std::vector<std::byte>> debuggerSeeds() {
  const std::string Hello =
      "qSupported:multiprocess+;swbreak+\nQStartNoAckMode\n!+\nHg0\nHc-1\n?\n"
      "qC\nqAttached\nqXfer:features:read:target.xml:0,ffb\n"
      "qXfer:threads:read::0,1000\nqXfer:exec-file:read:1:0,ffb\n";
  const uint32_t Stack = VX_STACK_TOP - 128;
  const std::string Texts[] = {
      Hello + "g\nD\n",
      Hello + "vCont?\nvCont;s:1\nvCont;s\ns\nc\n",
      Hello + "Z0,80000004,4\nc\ng\nHg3\np20\nz0,80000004,4\nvCont;c:p1.-1\n",
      Hello + "Z2,10000,4\nZ3,10004,4\nZ4,10008,4\nc\nc\nc\nz2,10000,4\nc\n",
      Hello +
          "m10000,40\nM10000,4:01020304\nm80000000,40\nm80000000,0\nX10000,1:"
          "a\nmffffffff,ffff\nc\n",
      Hello + "s\ns\ns\ns\ns\ns\ns\ns\ns\ns\ns\ns\n" + call(Square, Stack) +
          setRegister(1, 0) + setRegister(32, VX_IMAGE_BASE + 28) + "c\n",
      Hello + "Z0,80000004,4\nc\n" + call(Square, Stack) +
          call(Fault, Stack - 64) + call(Park, Stack - 128) + "c\nc\n",
      Hello + "Z0,80000008,4\nc\n" + call(Square, Stack) + "D\n",
      Hello + "Hg2\n" + call(Park, Stack - 4096) + "!\x03" + "c\nk\n",
      "!$g#00\n!$g#67\n!+++---\n!$$$#00#\n?\n!$qSupported#37",
      // Packets that are cut short or ask for what is not there.
      std::string("T1\nTffff\nHgffffffff\nHg-1\nH\nP\nP20=\nPzz=00\n") +
          "p45\npffffffff\nv\nvCont\nvCont;\nvCont;s:ffffffff\n" +
          "Z\nz\nZ9\nZ0\nqXfer:\nqXfer:threads:read::zz\n",
  };
  std::vector<std::vector<std::byte>> Seeds;
  for (const std::string &Text : Texts) {
    const auto Raw = std::as_bytes(std::span(Text));
    Seeds.emplace_back(Raw.begin(), Raw.end());
  }
  return Seeds;
}

} // namespace vorion::isasim::fuzz
