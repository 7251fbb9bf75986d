/// Answers to the debugger's packets (gdb's manual, "GDB Remote Serial
/// Protocol").

#include "observe/gdb/Session.h"

#include "vorion/isasim/Machine.h"

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>

namespace vorion::isasim::gdb {

namespace {

/// A hexadecimal number at the front of \p Text, which is taken off with the
/// separator behind it.
uint32_t takeHex(std::string_view &Text) {
  uint32_t Value = 0;
  const auto R =
      std::from_chars(Text.data(), Text.data() + Text.size(), Value, 16);
  Text.remove_prefix(static_cast<size_t>(R.ptr - Text.data()));
  if (!Text.empty())
    Text.remove_prefix(1);
  return Value;
}

} // namespace

void Session::answerMemory(std::string_view Packet) {
  const bool Writes = Packet[0] == 'M';
  Packet.remove_prefix(1);
  const uint32_t Address = takeHex(Packet), Bytes = takeHex(Packet);
  if (Writes)
    return reply(Lanes.writeMemory(Current, Address, fromHex(Packet)));
  constexpr uint32_t MostBytes = 4096;
  const std::string Read =
      Lanes.readMemory(Current, Address, std::min(Bytes, MostBytes));
  Peer.send(Read.empty() && Bytes ? "E14" : toHex(Read));
}

void Session::answerRegister(std::string_view Packet) {
  const bool Writes = Packet[0] == 'P';
  Packet.remove_prefix(1);
  const uint32_t Number = takeHex(Packet);
  if (!Writes) {
    const auto Value = Lanes.readRegister(Current, Number);
    return Peer.send(Value ? toHex({reinterpret_cast<const char *>(&*Value), 4})
                           : "E01");
  }
  const std::string Bytes = fromHex(Packet);
  uint32_t Value = 0;
  if (Bytes.size() == sizeof(Value))
    std::memcpy(&Value, Bytes.data(), sizeof(Value));
  if (Bytes.size() != sizeof(Value))
    return reply(false);
  if (Number == PcNumber)
    return reply(movePc(Value));
  if (Number == RaNumber)
    ReturnTo = {Current, Value};
  reply(Lanes.writeRegister(Current, Number, Value));
  if (RestoresRegisters)
    Lanes.takeWrites();
}

void Session::answerPoint(std::string_view Packet) {
  const bool Sets = Packet[0] == 'Z';
  const char Kind = Packet.size() > 1 ? Packet[1] : ' ';
  Packet.remove_prefix(std::min<size_t>(3, Packet.size()));
  const uint32_t Address = takeHex(Packet), Bytes = takeHex(Packet);
  if (Kind == '0' || Kind == '1') {
    if (Sets)
      Breakpoints.insert(Address);
    else if (Breakpoints.erase(Address) != 0)
      Lifted.insert(Address);
    return reply(true);
  }
  if (Kind < '2' || Kind > '4')
    return Peer.send("");
  const Watchpoint W{Address, Bytes, Kind != '2', Kind != '3'};
  if (Sets)
    Watched.push_back(W);
  else
    std::erase(Watched, W);
  reply(true);
}

std::string Session::threadList() const {
  std::string Text = "<?xml version=\"1.0\"?><threads>";
  for (ThreadId T = 1; T <= Lanes.numThreads(); ++T)
    if (Lanes.isAlive(T) || T == Current)
      Text += fmt::format("<thread id=\"{:x}\" core=\"{}\">{}</thread>", T,
                          Lanes.coreOf(T), Lanes.describe(T));
  return Text + "</threads>";
}

std::string Session::programPath() const {
  char *Path = realpath(Program->name().c_str(), nullptr);
  std::string Text = Path ? Path : "";
  std::free(Path);
  return Text;
}

/// "qXfer:OBJECT:read:ANNEX:OFFSET,LENGTH".
void Session::answerTransfer(std::string_view Packet) {
  std::string Document;
  if (Packet.starts_with("qXfer:features:read:target.xml:"))
    Document = Target::description();
  else if (Packet.starts_with("qXfer:threads:read::")) {
    Document = threadList();
    UserLooks = true;
    Lanes.showOwnPcs();
  } else if (Packet.starts_with("qXfer:exec-file:read:"))
    Document = programPath();
  else
    return Peer.send("");
  Packet.remove_prefix(Packet.rfind(':') + 1);
  const size_t Offset = takeHex(Packet), Length = takeHex(Packet);
  if (Offset >= Document.size())
    return Peer.send("l");
  const std::string Part = Document.substr(Offset, Length);
  Peer.send((Offset + Part.size() == Document.size() ? "l" : "m") + Part);
}

void Session::answerQuery(std::string_view Packet) {
  if (Packet.starts_with("qSupported")) {
    KnowsPrograms = Packet.find("exec-events+") != std::string_view::npos;
    return Peer.send("PacketSize=4000;QStartNoAckMode+;vContSupported+;"
                     "exec-events+;qXfer:features:read+;"
                     "qXfer:threads:read+;qXfer:exec-file:read+");
  }
  if (Packet.starts_with("qXfer:"))
    return answerTransfer(Packet);
  if (Packet == "QStartNoAckMode") {
    reply(true);
    return Peer.stopAcknowledging();
  }
  if (Packet == "qC")
    return Peer.send(fmt::format("QC{:x}", Current));
  // An existing process: gdb lets it run on when it leaves.
  if (Packet.starts_with("qAttached"))
    return Peer.send("1");
  Peer.send("");
}

/// "vCont;ACTION[:THREAD]...": the first step decides, else all go on.
void Session::answerContinue(std::string_view Packet) {
  if (Packet == "vCont?")
    return Peer.send("vCont;c;C;s;S");
  ThreadId Step = 0;
  while (!Packet.empty()) {
    const size_t End = std::min(Packet.size(), Packet.find(';', 1));
    std::string_view Action = Packet.substr(0, End);
    Packet.remove_prefix(End);
    if (!Action.starts_with(";s") && !Action.starts_with(";S"))
      continue;
    const size_t Colon = Action.find(':');
    Action.remove_prefix(std::min(Action.size(), Colon));
    Action.remove_prefix(Action.empty() ? 0 : 1);
    if (!Step)
      Step = Action.empty() ? Current : takeHex(Action);
  }
  resume(Step);
}

bool Session::answer(std::string_view Packet) {
  RestoresRegisters &= Packet.starts_with('P');
  switch (Packet.empty() ? '\0' : Packet[0]) {
  case '?':
    Peer.send(stopReply());
    break;
  case 'g':
    Peer.send(toHex(Lanes.registers(Current)));
    break;
  case 'p':
  case 'P':
    answerRegister(Packet);
    break;
  case 'm':
  case 'M':
    answerMemory(Packet);
    break;
  case 'Z':
  case 'z':
    answerPoint(Packet);
    break;
  case 'q':
  case 'Q':
    answerQuery(Packet);
    break;
  case 'H': {
    std::string_view Number = Packet.substr(std::min<size_t>(2, Packet.size()));
    const ThreadId T = Number.starts_with('-') ? 0 : takeHex(Number);
    if (T && !Lanes.warpOf(T)) {
      reply(false);
      break;
    }
    if (T && Packet[1] == 'g')
      Current = T;
    reply(true);
    break;
  }
  case 'T': {
    std::string_view Number = Packet.substr(1);
    reply(Lanes.isAlive(takeHex(Number)));
    break;
  }
  case 'c':
    resume(0);
    break;
  case 's':
    resume(Current);
    break;
  case 'v':
    if (Packet.starts_with("vCont"))
      answerContinue(Packet.size() > 5 && Packet[5] == '?' ? Packet
                                                           : Packet.substr(5));
    else
      Peer.send("");
    break;
  case 'D':
    reply(true);
    Peer.close();
    return true;
  case 'k':
    Lanes.device().requestStop();
    Peer.close();
    return true;
  default:
    Peer.send("");
  }
  return false;
}

} // namespace vorion::isasim::gdb
