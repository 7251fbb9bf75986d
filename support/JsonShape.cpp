#include "vorion/support/JsonShape.h"

#include "vorion/support/Printable.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace vorion {
namespace {

constexpr uint64_t NoBound = std::numeric_limits<uint64_t>::max();

std::string bounds(uint64_t Least, uint64_t Most) {
  if (Most != NoBound)
    return fmt::format("{} to {}", Least, Most);
  return fmt::format("{} or more", Least);
}

template <typename Kind> std::string described(const Kind &J) {
  if (J.is_number_integer())
    return J.dump();
  return J.is_null() ? "null" : fmt::format("of type {}", J.type_name());
}

} // namespace

JsonShape::JsonShape(Type WhatIn) : What(WhatIn) {}
JsonShape JsonShape::anything() { return JsonShape(Type::Anything); }
JsonShape JsonShape::boolean() { return JsonShape(Type::Boolean); }
JsonShape JsonShape::text() { return JsonShape(Type::Text); }
JsonShape JsonShape::number() { return JsonShape(Type::Number); }

JsonShape JsonShape::whole(uint64_t Least, uint64_t Most) {
  JsonShape S(Type::Whole);
  S.Least = Least;
  S.Most = Most;
  return S;
}

JsonShape JsonShape::list(JsonShape Of, uint64_t Least, uint64_t Most) {
  JsonShape S(Type::List);
  S.Least = Least;
  S.Most = Most;
  S.Elements.push_back(std::move(Of));
  return S;
}

JsonShape JsonShape::object(std::vector<JsonField> Fields) {
  JsonShape S(Type::Object);
  S.Fields = std::move(Fields);
  return S;
}

JsonShape JsonShape::orNull() const {
  JsonShape S = *this;
  S.MayBeNull = true;
  return S;
}

JsonShape JsonShape::closed() const {
  JsonShape S = *this;
  S.IsClosed = true;
  return S;
}

std::string JsonShape::name() const {
  switch (What) {
  case Type::Anything:
    return "anything";
  case Type::Boolean:
    return "true or false";
  case Type::Text:
    return "a string";
  case Type::Number:
    return "a number";
  case Type::Whole:
    return Least == 0 && Most == NoBound
               ? "a whole number"
               : "a whole number, " + bounds(Least, Most);
  case Type::List:
    return Least == 0 && Most == NoBound
               ? "a list"
               : fmt::format("a list of {} values", bounds(Least, Most));
  case Type::Object:
    return "an object";
  }
  return {};
}

template <typename Kind> bool JsonShape::hasType(const Kind &J) const {
  switch (What) {
  case Type::Anything:
    return true;
  case Type::Boolean:
    return J.is_boolean();
  case Type::Text:
    return J.is_string();
  case Type::Number:
    return J.is_number();
  case Type::Whole:
    return J.is_number_unsigned() && J.template get<uint64_t>() >= Least &&
           J.template get<uint64_t>() <= Most;
  case Type::List:
    return J.is_array() && J.size() >= Least && J.size() <= Most;
  case Type::Object:
    return J.is_object();
  }
  return false;
}

template <typename Kind>
std::string JsonShape::problem(const Kind &J, const std::string &Path) const {
  if (MayBeNull && J.is_null())
    return {};
  if (!hasType(J))
    return fmt::format("{}{}, expected {}",
                       Path.empty() ? "a document "
                                    : fmt::format("key {} is ", Path),
                       described(J), name());
  if (What == Type::List)
    for (std::size_t I = 0; I < J.size(); ++I)
      if (auto Wrong =
              Elements[0].problem(J[I], fmt::format("{}[{}]", Path, I));
          !Wrong.empty())
        return Wrong;
  const auto Inside = [&Path](const std::string &Key) {
    return Path.empty() ? escaped(Key) : Path + "." + escaped(Key);
  };
  for (const JsonField &F : Fields) {
    const auto It = J.find(F.Name);
    if (It == J.end() && !F.Required)
      continue;
    if (It == J.end())
      return fmt::format("key {} is missing, expected {}", Inside(F.Name),
                         F.Shape.name());
    if (auto Wrong = F.Shape.problem(*It, Inside(F.Name)); !Wrong.empty())
      return Wrong;
  }
  if (!IsClosed)
    return {};
  for (const auto &[Key, Value] : J.items())
    if (std::ranges::find(Fields, Key, &JsonField::Name) == Fields.end()) {
      std::string Known;
      for (const JsonField &F : Fields)
        Known += (Known.empty() ? "" : ", ") + F.Name;
      return fmt::format("unknown key {}, expected one of {}", Inside(Key),
                         Known);
    }
  return {};
}

template <typename Kind>
Expected<Success> JsonShape::check(const Kind &J,
                                   const std::string &Where) const {
  if (std::string Wrong = problem(J, ""); !Wrong.empty())
    return Error{Where, std::move(Wrong)};
  return Success{};
}

template Expected<Success> JsonShape::check(const nlohmann::json &,
                                            const std::string &) const;
template Expected<Success> JsonShape::check(const nlohmann::ordered_json &,
                                            const std::string &) const;

} // namespace vorion
