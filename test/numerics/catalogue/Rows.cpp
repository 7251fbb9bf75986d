#include "Rows.h"

#include <fstream>

namespace vorion::test {

Expected<Rows> Rows::open(const std::string &Path) {
  Rows R;
  R.File = Path;
  std::ifstream In(Path);
  for (std::string Line; !Path.empty() && std::getline(In, Line);) {
    // The last line of an interrupted run may be incomplete.
    auto Row = nlohmann::json::parse(Line, nullptr, false);
    if (!Row.is_object() || !Row.contains("key"))
      continue;
    const auto Key = Row["key"].get<std::string>();
    R.Known[Key] = std::move(Row);
  }
  return R;
}

const nlohmann::json *Rows::find(const std::string &Key) const {
  const auto It = Known.find(Key);
  return It == Known.end() ? nullptr : &It->second;
}

Expected<Success> Rows::add(const nlohmann::json &Row) {
  Known[Row["key"].get<std::string>()] = Row;
  if (File.empty())
    return Success{};
  std::ofstream Out(File, std::ios::app);
  Out << Row.dump() << '\n';
  if (!Out.flush())
    return Error{File, "cannot write, expected a file that can be appended to"};
  return Success{};
}

} // namespace vorion::test
