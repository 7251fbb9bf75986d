#include "Points.h"

#include "vorion/support/File.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fmt/format.h>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <thread>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

std::string asFileName(std::string Name) {
  std::replace(Name.begin(), Name.end(), '/', '_');
  return Name;
}

Expected<Json> readJson(const std::string &Path) {
  return vorion::readJson<Json>(Path, "what splat wrote there");
}

Expected<Success> makeFolders(const std::string &Folder) {
  for (const char *Name : {"points", "work", "references"}) {
    std::error_code Problem;
    std::filesystem::create_directories(Folder + "/" + Name, Problem);
    if (Problem)
      return Error{Folder, fmt::format("cannot make the folder: {}, expected "
                                       "one that can be written",
                                       Problem.message())};
  }
  return Success{};
}

Expected<Success>
measureAll(const std::vector<Measuring> &Wanted, unsigned Jobs,
           const std::function<void(std::string_view)> &Said) {
  std::atomic<std::size_t> Next = 0;
  std::mutex Lock;
  std::size_t Done = 0;
  std::optional<Error> Failure;
  const auto Work = [&] {
    for (std::size_t I = Next++; I < Wanted.size(); I = Next++) {
      auto Measured = Wanted[I].Measure();
      std::optional<Error> Problem;
      if (!Measured)
        Problem = Measured.error();
      else if (auto Kept = writeFileAtomically(Wanted[I].File,
                                               jsonText(*Measured, 1) + "\n");
               !Kept)
        Problem = Kept.error();
      const std::lock_guard Guard(Lock);
      if (Problem) {
        Failure = Problem;
        Next = Wanted.size();
        return;
      }
      Said(fmt::format("[{}/{}] {}: {}", ++Done, Wanted.size(), Wanted[I].Name,
                       Wanted[I].Say(*Measured)));
    }
  };
  std::vector<std::thread> Others;
  for (unsigned I = 1; I < Jobs; ++I)
    Others.emplace_back(Work);
  Work();
  for (std::thread &Other : Others)
    Other.join();
  if (Failure)
    return *Failure;
  return Success{};
}

} // namespace vorion::splat
