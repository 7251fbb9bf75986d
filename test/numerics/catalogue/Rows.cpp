#include "Rows.h"

#include "vorion/support/Json.h"
#include "vorion/support/JsonShape.h"

#include <fstream>

namespace vorion::test {

Expected<Rows> Rows::open(const std::string &Path) {
  Rows R;
  R.File = Path;
  const auto Shape = JsonShape::object({{"key", JsonShape::text()}});
  std::ifstream In(Path);
  for (std::string Line; !Path.empty() && std::getline(In, Line);) {
    // The last line of an interrupted run may be incomplete.
    auto Row = parseJson<nlohmann::json>(Line, Path, "a row");
    if (!Row || !Shape.check(*Row, Path))
      continue;
    const auto Key = (*Row)["key"].get<std::string>();
    R.Known[Key] = std::move(*Row);
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
  Out << jsonText(Row) << '\n';
  if (!Out.flush())
    return Error{File, "cannot write, expected a file that can be appended to"};
  return Success{};
}

} // namespace vorion::test
