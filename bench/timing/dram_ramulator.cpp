// Runs lists of requests (dram_patterns --list) through a controller of
// Ramulator 2.1 and prints what came out as JSON.
// bench/timing/dram_ramulator.py compiles it against a checkout and calls it.
//
// usage: dram_ramulator CONFIGURATION.json TICKS_TO_WRITTEN LIST...
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <fstream>
#include <ramulator/base/config.h>
#include <ramulator/base/factory.h>
#include <ramulator/controller/controller_base.h>
#include <ramulator/frontend/i_frontend.h>
#include <ramulator/memory_system/i_memory_system.h>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr int64_t LineBytes = 64;

struct Operation {
  int64_t At;
  bool IsWrite;
  int64_t Line;
  int Group, Bank, Row, Column;
};

/// What a controller says to none but its kind.
struct Waiting : Ramulator::ControllerBase {
  static size_t writes(Ramulator::ControllerBase &C) {
    return (C.*&Waiting::m_write_buffer).size();
  }
  static void writeFirst(Ramulator::ControllerBase &C) {
    C.*&Waiting::m_is_write_mode = true;
  }
  static size_t freeReads(Ramulator::ControllerBase &C) {
    auto &Buffer = C.*&Waiting::m_read_buffer;
    return Buffer.max_size - Buffer.size();
  }
  static size_t freeWrites(Ramulator::ControllerBase &C) {
    auto &Buffer = C.*&Waiting::m_write_buffer;
    return Buffer.max_size - Buffer.size();
  }
};
struct Parts : Ramulator::IMemorySystem {
  static auto &of(Ramulator::IMemorySystem &M) {
    return M.*&Parts::m_components;
  }
};

struct Result {
  std::string Name;
  int64_t End = 0;
  std::vector<int64_t> Latencies;
};

/// As Run::closed() of dram_patterns.cpp, a tick at a time.
Result run(const Ramulator::ConfigNode &Config, int64_t TicksToWritten,
           const char *File) {
  std::ifstream In(File);
  Result R;
  size_t ReadSlots = 0, WriteSlots = 0;
  In >> R.Name >> ReadSlots >> WriteSlots;
  std::vector<Operation> All;
  for (Operation O{}; In >> O.At >> O.IsWrite >> O.Line >> O.Group >> O.Bank >>
                      O.Row >> O.Column;)
    All.push_back(O);

  auto *Frontend = Ramulator::Factory::create_frontend(Config);
  auto *Memory = Ramulator::Factory::create_memory_system(Config);
  Frontend->connect_memory_system(Memory);
  Memory->connect_frontend(Frontend);
  Ramulator::ControllerBase *Controller = nullptr;
  for (auto *Part : Parts::of(*Memory))
    if (auto *Found = dynamic_cast<Ramulator::ControllerBase *>(Part))
      Controller = Found;
  const int BurstBytes = Memory->get_tx_bytes();
  const auto Bursts = static_cast<size_t>(LineBytes / BurstBytes);
  const auto &Spec = *Controller->m_device.m_spec;
  const auto Level = [&](const char *Name) {
    const auto Found = Spec.levels.find(Name);
    return Found == Spec.levels.end() ? -1 : Found->second;
  };
  const int Rank = Level("Rank") >= 0 ? Level("Rank") : Level("PseudoChannel");
  const int Group = Level("BankGroup"), Bank = Level("Bank"),
            Row = Level("Row"), Column = Level("Column");

  size_t Next = 0, ReadsOut = 0, WritesInFront = 0, Left = All.size();
  std::deque<size_t> Front;
  std::vector<int64_t> IssuedAt(All.size());
  std::vector<size_t> BurstsLeft(All.size(), Bursts);
  const auto Done = [&](size_t N, int64_t At) {
    if (--BurstsLeft[N] != 0)
      return;
    --Left;
    R.End = std::max(R.End, At);
    if (All[N].IsWrite)
      return;
    R.Latencies.push_back(At - IssuedAt[N]);
    --ReadsOut;
  };
  // Our model begins with writes, because no read waits in front of tick 0.
  Waiting::writeFirst(*Controller);
  // Ramulator hands back a read that a waiting write answers behind those whose
  // data are still to come. It is known a tick after it was sent.
  std::vector<size_t> Forwarded, Ignored(All.size());
  for (int64_t Now = 0; Left != 0; ++Now) {
    for (const size_t N : std::exchange(Forwarded, {}))
      Done(N, Now);
    const auto HandOver = [&] {
      while (!Front.empty()) {
        const size_t N = Front.front();
        const Operation &O = All[N];
        if ((O.IsWrite ? Waiting::freeWrites(*Controller)
                       : Waiting::freeReads(*Controller)) < Bursts)
          return;
        for (size_t B = 0; B != Bursts; ++B) {
          Ramulator::Request Q(O.Line * LineBytes +
                                   static_cast<int64_t>(B) * BurstBytes,
                               O.IsWrite, 0, {});
          Q.addr_vec.assign(static_cast<size_t>(Spec.level_count), 0);
          const auto Set = [&](int At, int Value) {
            if (At >= 0)
              Q.addr_vec[static_cast<size_t>(At)] = Value;
          };
          Set(Rank, 0);
          Set(Group, O.Group);
          Set(Bank, O.Bank);
          Set(Row, O.Row);
          Set(Column,
              O.Column * static_cast<int>(Bursts) + static_cast<int>(B));
          Q.size_bytes = BurstBytes;
          const bool IsWrite = O.IsWrite;
          // A write calls when it is issued, in the tick that is Now + 1 here.
          Q.callback = [&, N, IsWrite](Ramulator::Request &Served) {
            if (Ignored[N] != 0) {
              --Ignored[N];
              return;
            }
            Done(N,
                 IsWrite ? Controller->m_clk + TicksToWritten : Served.depart);
          };
          const size_t Free = Waiting::freeReads(*Controller);
          if (!Memory->send(Q))
            std::fprintf(stderr, "a request was refused\n");
          if (!O.IsWrite && Waiting::freeReads(*Controller) == Free) {
            Forwarded.push_back(N);
            ++Ignored[N];
          }
        }
        WritesInFront -= O.IsWrite;
        Front.pop_front();
      }
    };
    HandOver();
    while (Next != All.size() && All[Next].At <= Now) {
      const bool IsWrite = All[Next].IsWrite;
      const size_t InQueue =
          (Waiting::writes(*Controller) + Bursts - 1) / Bursts;
      if (IsWrite ? WritesInFront + InQueue >= WriteSlots
                  : ReadsOut >= ReadSlots)
        break;
      Front.push_back(Next);
      IssuedAt[Next] = Now;
      ++(IsWrite ? WritesInFront : ReadsOut);
      ++Next;
      HandOver();
    }
    Memory->tick();
  }
  return R;
}

} // namespace

int main(int Argc, char **Argv) {
  std::ifstream File(Argv[1]);
  std::stringstream Text;
  Text << File.rdbuf();
  std::printf("{");
  for (int N = 3; N < Argc; ++N) {
    const auto Config = Ramulator::Config::parse_config_string(Text.str());
    Result R = run(Config, std::stoll(Argv[2]), Argv[N]);
    std::sort(R.Latencies.begin(), R.Latencies.end());
    int64_t Sum = 0;
    for (const int64_t L : R.Latencies)
      Sum += L;
    const auto Reads = static_cast<double>(R.Latencies.size());
    std::printf(
        "%s\n \"%s\": {\"ticks\": %lld, \"mean_read_ticks\": %.6f, "
        "\"read_95_ticks\": %lld}",
        N == 3 ? "" : ",", R.Name.c_str(), static_cast<long long>(R.End),
        Reads > 0 ? static_cast<double>(Sum) / Reads : 0.0,
        static_cast<long long>(
            R.Latencies.empty() ? 0
                                : R.Latencies[R.Latencies.size() * 95 / 100]));
  }
  std::printf("\n}\n");
  return 0;
}
