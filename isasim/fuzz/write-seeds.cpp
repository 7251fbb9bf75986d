/// Writes the fuzzers' first inputs: isasim-fuzz-seeds FOLDER makes
/// FOLDER/image, FOLDER/execute and so on, a folder for each fuzzer.

#include "fuzz/Targets.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"

#include <filesystem>
#include <fmt/format.h>

using namespace vorion;

int main(int Argc, char **Argv) {
  constexpr unsigned Programs = 200;
  constexpr std::string_view Tool = "isasim-fuzz-seeds";
  if (Argc != 2)
    return reportError(
        Tool, Error{"", "one argument, expected a folder", ExitCode::Usage});
  const std::pair<const char *, std::vector<std::vector<std::byte>>> Kinds[] = {
      {"image", isasim::fuzz::imageSeeds()},
      {"execute", isasim::fuzz::programSeeds(Programs, 1)},
      {"gdb", isasim::fuzz::debuggerSeeds()},
      {"raster", isasim::fuzz::rasterSeeds(Programs, 1)},
      {"region", isasim::fuzz::regionSeeds()}};
  for (const auto &[Kind, Seeds] : Kinds) {
    const std::string Folder = fmt::format("{}/{}", Argv[1], Kind);
    std::error_code Failed;
    std::filesystem::create_directories(Folder, Failed);
    for (size_t N = 0; N != Seeds.size(); ++N)
      if (const auto Ok = writeFileAtomically(fmt::format("{}/{}", Folder, N),
                                              Seeds[N].data(), Seeds[N].size());
          !Ok)
        return reportError(Tool, Ok.error());
  }
  return 0;
}
