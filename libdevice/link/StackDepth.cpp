#include "StackDepth.h"

#include <vorion_abi.h>

#include <algorithm>
#include <cstring>
#include <elf.h>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <string_view>

using namespace vorion;
using namespace vorion::link;

namespace {

/// A function, or what calls through pointers may reach.
struct Node {
  uint64_t Frame = 0;
  bool Repeats = false;
  std::vector<std::size_t> Callees; ///< numbers of nodes
};

/// What the deepest path from a node on needs.
struct Depth {
  uint64_t Bytes = 0;
  bool Repeats = false;

  uint64_t all() const { return Bytes + (Repeats ? VX_REPEAT_BYTES : 0); }
};

/// The depths of all nodes, by Tarjan's strongly connected components: each is
/// complete when all that it calls are.
class DepthFinder {
public:
  explicit DepthFinder(const std::vector<Node> &Nodes)
      : Nodes(Nodes), Order(Nodes.size()), Lowest(Nodes.size()),
        Depths(Nodes.size()) {}

  std::vector<Depth> find() {
    for (std::size_t N = 0; N != Nodes.size(); ++N)
      if (Order[N] == 0)
        visit(N);
    return Depths;
  }

private:
  /// Without recursion: paths of calls may be longer than the host's stack.
  void visit(std::size_t First) {
    struct Call {
      std::size_t Caller, NextCallee;
    };
    std::vector<Call> Path;
    const auto Enter = [&](std::size_t N) {
      Order[N] = Lowest[N] = ++Count;
      Open.push_back(N);
      Path.push_back({N, 0});
    };
    Enter(First);
    while (!Path.empty()) {
      const std::size_t N = Path.back().Caller;
      if (Path.back().NextCallee == Nodes[N].Callees.size()) {
        Path.pop_back();
        if (!Path.empty())
          Lowest[Path.back().Caller] =
              std::min(Lowest[Path.back().Caller], Lowest[N]);
        if (Lowest[N] == Order[N])
          complete(N);
        continue;
      }
      const std::size_t Callee = Nodes[N].Callees[Path.back().NextCallee++];
      if (Order[Callee] == 0)
        Enter(Callee);
      else if (Lowest[Callee] != Completed)
        Lowest[N] = std::min(Lowest[N], Order[Callee]);
    }
  }

  /// \p Root and what was entered since form a circle of calls, or are \p Root
  /// alone.
  void complete(std::size_t Root) {
    // The root is near the end: what was entered before it is still open.
    const auto Begin =
        std::prev(std::find(Open.rbegin(), Open.rend(), Root).base());
    const std::vector<std::size_t> Circle(Begin, Open.end());
    Open.erase(Begin, Open.end());
    Depth All, Deepest;
    All.Repeats = Circle.size() > 1;
    for (const std::size_t N : Circle) {
      All.Bytes += Nodes[N].Frame;
      All.Repeats |= Nodes[N].Repeats;
      for (const std::size_t Callee : Nodes[N].Callees) {
        const bool IsInside = Lowest[Callee] != Completed;
        All.Repeats |= IsInside || Depths[Callee].Repeats;
        if (!IsInside)
          Deepest.Bytes = std::max(Deepest.Bytes, Depths[Callee].Bytes);
      }
    }
    All.Bytes += Deepest.Bytes;
    for (const std::size_t N : Circle) {
      Depths[N] = All;
      Lowest[N] = Completed;
    }
  }

  static constexpr std::size_t Completed = ~std::size_t{0};
  const std::vector<Node> &Nodes;
  std::size_t Count = 0;
  std::vector<std::size_t> Order; ///< in which nodes were entered, from 1 on
  std::vector<std::size_t> Lowest;
  std::vector<std::size_t> Open; ///< entered and not complete
  std::vector<Depth> Depths;
};

class Program {
public:
  explicit Program(std::span<std::byte> Bytes) : File(Bytes) {}

  bool isElf() {
    return get(Header, 0) &&
           std::memcmp(Header.e_ident, ELFMAG, SELFMAG) == 0 &&
           Header.e_ident[EI_CLASS] == ELFCLASS32 && Header.e_type == ET_EXEC;
  }
  /// Fills in the nodes; false if something is malformed.
  bool read() {
    Nodes.resize(1); // what calls through pointers may reach
    return findSections() && readFunctions();
  }
  std::vector<StackNeed> write();

private:
  template <typename T> bool get(T &To, uint64_t Offset) const {
    if (Offset > File.size() || File.size() - Offset < sizeof(T))
      return false;
    std::memcpy(&To, File.data() + Offset, sizeof(T));
    return true;
  }
  void put(uint32_t Value, uint64_t Offset) {
    std::memcpy(File.data() + Offset, &Value, sizeof(Value));
  }
  std::string textAt(uint64_t Offset) const;
  /// Where in the file the section \p S has address \p Address.
  static uint64_t placeIn(const Elf32_Shdr &S, uint32_t Address) {
    return uint64_t{S.sh_offset} + (Address - S.sh_addr);
  }
  bool findSections();
  bool readFunctions();
  std::size_t nodeAt(uint32_t Address);
  std::optional<uint64_t> needOf(uint32_t Address) const;

  std::span<std::byte> File;
  Elf32_Ehdr Header{};
  std::vector<Elf32_Shdr> Sections;
  Elf32_Shdr Stacks{}, Kernels{};
  uint32_t Main = 0;
  std::map<uint32_t, std::size_t> NodeOf; ///< by address
  std::vector<Node> Nodes;
  std::vector<Depth> Depths;
};

std::string Program::textAt(uint64_t Offset) const {
  if (Offset >= File.size())
    return {};
  const auto *Begin = reinterpret_cast<const char *>(File.data() + Offset);
  return {Begin, strnlen(Begin, File.size() - Offset)};
}

bool Program::findSections() {
  for (unsigned N = 0; N != Header.e_shnum; ++N)
    if (!get(Sections.emplace_back(),
             Header.e_shoff + uint64_t{N} * sizeof(Elf32_Shdr)))
      return false;
  if (Header.e_shstrndx >= Sections.size())
    return Sections.empty();
  for (const Elf32_Shdr &S : Sections) {
    const std::string Called =
        textAt(uint64_t{Sections[Header.e_shstrndx].sh_offset} + S.sh_name);
    if (Called == "vorion_stacks")
      Stacks = S;
    else if (Called == "vorion_kernels")
      Kernels = S;
    if (S.sh_type != SHT_SYMTAB || S.sh_link >= Sections.size())
      continue;
    for (uint64_t At = 0; At + sizeof(Elf32_Sym) <= S.sh_size;
         At += sizeof(Elf32_Sym)) {
      Elf32_Sym Symbol;
      if (!get(Symbol, S.sh_offset + At))
        return false;
      if (ELF32_ST_TYPE(Symbol.st_info) == STT_FUNC &&
          textAt(uint64_t{Sections[S.sh_link].sh_offset} + Symbol.st_name) ==
              "vorion_main")
        Main = Symbol.st_value;
    }
  }
  return true;
}

std::size_t Program::nodeAt(uint32_t Address) {
  const auto [Found, New] = NodeOf.emplace(Address, Nodes.size());
  if (New)
    // Until its record comes.
    Nodes.emplace_back().Repeats = true;
  return Found->second;
}

bool Program::readFunctions() {
  for (uint64_t At = 0; At != Stacks.sh_size;) {
    vx_stack Record;
    if (Stacks.sh_size - At < sizeof(Record) ||
        !get(Record, Stacks.sh_offset + At))
      return false;
    At += sizeof(Record);
    if ((Stacks.sh_size - At) / sizeof(uint32_t) < Record.num_callees)
      return false;
    Node Function;
    Function.Frame = Record.frame_bytes;
    Function.Repeats =
        (Record.flags & (VX_STACK_INDIRECT | VX_STACK_REPEATS)) != 0;
    if (Record.flags & VX_STACK_INDIRECT)
      Function.Callees.push_back(0);
    for (uint32_t N = 0; N != Record.num_callees; ++N, At += sizeof(uint32_t)) {
      uint32_t Callee = 0;
      if (!get(Callee, Stacks.sh_offset + At))
        return false;
      if (Callee != 0) // a weak function that is not there
        Function.Callees.push_back(nodeAt(Callee));
    }
    const std::size_t Number = nodeAt(Record.function);
    Nodes[Number] = std::move(Function);
    if (Record.flags & VX_STACK_ADDRESS_TAKEN)
      Nodes[0].Callees.push_back(Number);
  }
  return true;
}

std::optional<uint64_t> Program::needOf(uint32_t Address) const {
  const auto Found = NodeOf.find(Address);
  if (Found == NodeOf.end())
    return std::nullopt;
  return Depths[Found->second].all();
}

std::vector<StackNeed> Program::write() {
  Depths = DepthFinder(Nodes).find();
  const auto Clip = [](uint64_t Bytes) {
    return static_cast<uint32_t>(
        std::min<uint64_t>(Bytes, std::numeric_limits<uint32_t>::max()));
  };
  std::vector<StackNeed> Needs;
  for (uint64_t At = Kernels.sh_offset;
       At + sizeof(vx_kernel) <= Kernels.sh_offset + uint64_t{Kernels.sh_size};
       At += sizeof(vx_kernel)) {
    vx_kernel Record;
    if (!get(Record, At))
      break;
    const auto Need = needOf(Record.entry);
    if (!Need)
      continue;
    put(Clip(*Need), At + offsetof(vx_kernel, stack_bytes));
    std::string Called;
    for (const Elf32_Shdr &S : Sections)
      if ((S.sh_flags & SHF_ALLOC) && Record.name - S.sh_addr < S.sh_size)
        Called = textAt(placeIn(S, Record.name));
    Needs.push_back({"kernel " + Called, *Need});
  }
  const auto Need = needOf(Main);
  for (unsigned N = 0; Need && N != Header.e_phnum; ++N) {
    const uint64_t At = Header.e_phoff + uint64_t{N} * sizeof(Elf32_Phdr);
    Elf32_Phdr Segment;
    if (!get(Segment, At) || Segment.p_type != PT_GNU_STACK)
      continue;
    put(Clip(*Need), At + offsetof(Elf32_Phdr, p_memsz));
    Needs.push_back({"main", *Need});
  }
  return Needs;
}

} // namespace

Expected<std::vector<StackNeed>>
link::writeStackNeeds(std::span<std::byte> File, const std::string &Name) {
  Program P(File);
  if (!P.isElf())
    return std::vector<StackNeed>();
  if (!P.read())
    return Error{Name, "malformed section headers or section vorion_stacks, "
                       "expected those of the compiler and the linker"};
  return P.write();
}
