#include "train/run/Ranks.h"

#include <fmt/format.h>
#include <string>

namespace vorion::splat {

bool Ranks::any(bool Mine) {
  bool Found = false;
  for (unsigned From = 0; From < size(); ++From) {
    unsigned char Theirs = Mine ? 1 : 0;
    share(From, &Theirs, 1);
    Found |= Theirs != 0;
  }
  return Found;
}

Expected<Success> Ranks::agree(const Expected<Success> &Mine) {
  const auto ShareText = [this](unsigned From, std::string &Text) {
    uint64_t Size = Text.size();
    share(From, &Size, sizeof(Size));
    Text.resize(Size);
    share(From, Text.data(), Size);
  };
  for (unsigned From = 0; From < size(); ++From) {
    Error Theirs{"", "", ExitCode::Ok};
    if (!Mine)
      Theirs = Mine.error();
    share(From, &Theirs.Code, sizeof(Theirs.Code));
    if (Theirs.Code == ExitCode::Ok)
      continue;
    ShareText(From, Theirs.Where);
    ShareText(From, Theirs.What);
    if (From != 0)
      Theirs.What += fmt::format(" (process {})", From);
    return Theirs;
  }
  return Success{};
}

bool Ranks::allSucceeded(Launcher &Launch) {
  const auto All = agree(Launch.failure() ? Expected<Success>(*Launch.failure())
                                          : Success{});
  if (!All)
    Launch.fail(All.error());
  return static_cast<bool>(All);
}

} // namespace vorion::splat
