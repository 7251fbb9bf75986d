#include "machine/ShortKeys.h"

#include <algorithm>
#include <fmt/format.h>

namespace vorion::isasim {

namespace {

std::string setRasterizers(Config &C, uint64_t Number, bool) {
  if (Number == 0 || Number % C.Clusters != 0)
    return fmt::format("rasterizers is {}, expected a multiple of {}, the "
                       "clusters",
                       Number, C.Clusters);
  C.SocketsPerCluster = static_cast<unsigned>(Number / C.Clusters);
  return {};
}

std::string setCores(Config &C, uint64_t Number, bool KeepsSockets) {
  const uint64_t Of =
      KeepsSockets ? C.sockets() : uint64_t{C.Clusters} * C.CoresPerSocket;
  if (Number == 0 || Number % Of != 0)
    return fmt::format(
        "cores is {}, expected a multiple of {}{}", Number, Of,
        KeepsSockets
            ? ", the sockets"
            : ": clusters times cores_per_socket, which can also be set");
  (KeepsSockets ? C.CoresPerSocket : C.SocketsPerCluster) =
      static_cast<unsigned>(Number / Of);
  return {};
}

constexpr ShortKey All[] = {
    {"lanes", "timing.raster.lanes", nullptr,
     "lanes of a rasterizer; those of a core are lanes_per_warp"},
    {"dram", "timing.dram.standard", nullptr, "standard of the DRAM"},
    {"rasterizers", "", setRasterizers,
     "number in the machine, one per socket: sets sockets_per_cluster"},
    {"cores", "", setCores,
     "number in the machine: sets sockets_per_cluster, or cores_per_socket if "
     "rasterizers or sockets_per_cluster are given, too"},
};

} // namespace

std::span<const ShortKey> shortKeys() { return All; }

const ShortKey *findShortKey(std::string_view Name) {
  const auto *const Found = std::ranges::find(All, Name, &ShortKey::Name);
  return Found == std::end(All) ? nullptr : Found;
}

std::string shortKeysMarkdown() {
  std::string Text = "\nShort names that `--set` takes, too\n\n"
                     "| name | stands for |\n|---|---|\n";
  for (const ShortKey &S : All)
    Text += fmt::format("| `{}` | {}{} |\n", S.Name,
                        S.Key.empty() ? "" : fmt::format("`{}`: ", S.Key),
                        S.Meaning);
  return Text;
}

std::vector<std::string> keysEndingWith(std::string_view End,
                                        const std::vector<std::string> &Keys) {
  const std::string Tail = fmt::format(".{}", End);
  std::vector<std::string> Found;
  for (const std::string &Key : Keys)
    if (Key.ends_with(Tail))
      Found.push_back(Key);
  return Found;
}

} // namespace vorion::isasim
