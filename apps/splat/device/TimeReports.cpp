#include "TimeReports.h"

#include "vorion/support/Json.h"

#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

/// Members that describe the machine.
static bool isConstant(const std::string &Name) {
  return Name == "clock_mhz" || Name == "host" || Name == "lane_areas";
}

/// Members of which the later one counts.
static bool isState(const std::string &Name) { return Name == "commands_left"; }

static void add(Json &To, const Json &From) {
  if (To.is_number_unsigned()) {
    To = To.get<std::uint64_t>() + From.get<std::uint64_t>();
  } else if (To.is_object()) {
    for (auto &[Name, Value] : To.items())
      if (isState(Name) && From.contains(Name))
        Value = From[Name];
      else if (!isConstant(Name) && From.contains(Name))
        add(Value, From[Name]);
  } else if (To.is_array()) {
    for (std::size_t N = 0; N != To.size() && N != From.size(); ++N)
      add(To[N], From[N]);
  }
}

void addTimeReport(Json &Sum, const Json &Report) {
  if (Sum.is_null())
    Sum = Report;
  else if (!Report.is_null())
    add(Sum, Report);
}

std::string addTimeReports(const std::string &A, const std::string &B) {
  if (A.empty() || B.empty())
    return A.empty() ? B : A;
  Json Sum = ownJson<Json>(A);
  addTimeReport(Sum, ownJson<Json>(B));
  return jsonText(Sum);
}

} // namespace vorion::splat
