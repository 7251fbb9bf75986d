#include "tools/Arguments.h"

#include "vorion/support/Json.h"

#include <charconv>
#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::isasim {

namespace {

Error bad(std::string_view Text, std::string_view Expectation) {
  return {"", fmt::format("argument '{}', expected {}", Text, Expectation),
          ExitCode::Usage};
}

template <typename T> bool parseNumber(std::string_view Text, T &Value) {
  int Base = 10;
  if constexpr (std::is_integral_v<T>) {
    if (Text.starts_with("0x")) {
      Base = 16;
      Text.remove_prefix(2);
    }
    const auto R =
        std::from_chars(Text.data(), Text.data() + Text.size(), Value, Base);
    return R.ec == std::errc() && R.ptr == Text.data() + Text.size();
  } else {
    const auto R =
        std::from_chars(Text.data(), Text.data() + Text.size(), Value);
    return R.ec == std::errc() && R.ptr == Text.data() + Text.size();
  }
}

template <typename T>
Expected<KernelInput> number(std::string_view All, std::string_view Text) {
  T Value{};
  if (!parseNumber(Text, Value))
    return bad(All, "a number that fits the type");
  KernelInput In;
  In.What = std::is_integral_v<T> ? KernelInput::Integer : KernelInput::Float;
  In.Bytes.resize(sizeof(T));
  std::memcpy(In.Bytes.data(), &Value, sizeof(T));
  return In;
}

Expected<KernelInput> hexBytes(std::string_view All, std::string_view Text) {
  KernelInput In;
  for (size_t At = 0; At < Text.size(); At += 2) {
    unsigned Value = 0;
    const char *First = Text.data() + At;
    const char *Last = First + std::min<size_t>(2, Text.size() - At);
    const auto R = std::from_chars(First, Last, Value, 16);
    if (Last - First != 2 || R.ec != std::errc() || R.ptr != Last)
      return bad(All, "two hexadecimal digits per byte");
    In.Bytes.push_back(static_cast<std::byte>(Value));
  }
  return In;
}

Expected<KernelInput> sized(std::string_view All, std::string_view Text,
                            KernelInput::Kind Kind) {
  KernelInput In;
  In.What = Kind;
  if (!parseNumber(Text, In.Size) || In.Size == 0)
    return bad(All, "a size in bytes, at least 1");
  return In;
}

} // namespace

Expected<KernelInput> parseInput(std::string_view Text) {
  if (Text.starts_with("buf@") && Text.size() > 4) {
    KernelInput In;
    In.What = KernelInput::Buffer;
    In.ReadFrom = Text.substr(4);
    return In;
  }
  const size_t Colon = Text.find(':');
  const std::string_view Type = Text.substr(0, Colon);
  const std::string_view Rest =
      Colon == std::string_view::npos ? "" : Text.substr(Colon + 1);
  if (Type == "i32")
    return number<int32_t>(Text, Rest);
  if (Type == "u32")
    return number<uint32_t>(Text, Rest);
  if (Type == "i64")
    return number<int64_t>(Text, Rest);
  if (Type == "u64")
    return number<uint64_t>(Text, Rest);
  if (Type == "f32")
    return number<float>(Text, Rest);
  if (Type == "bytes")
    return hexBytes(Text, Rest);
  if (Type == "buf")
    return sized(Text, Rest, KernelInput::Buffer);
  if (Type == "local")
    return sized(Text, Rest, KernelInput::Local);
  const size_t At = Rest.find('@');
  if (Type == "out" && At != std::string_view::npos && At + 1 < Rest.size()) {
    Expected<KernelInput> In =
        sized(Text, Rest.substr(0, At), KernelInput::Buffer);
    if (In)
      In->WriteTo = Rest.substr(At + 1);
    return In;
  }
  if (Type == "inout" && !Rest.empty() && At != 0) {
    KernelInput In;
    In.What = KernelInput::Buffer;
    In.ReadFrom = Rest.substr(0, At);
    In.WriteTo = At == std::string_view::npos
                     ? In.ReadFrom
                     : std::string(Rest.substr(At + 1));
    if (!In.WriteTo.empty())
      return In;
  }
  return bad(Text, "i32:N, u32:N, i64:N, u64:N, f32:X, bytes:HEX, buf:SIZE, "
                   "buf@FILE, out:SIZE@FILE, inout:FILE[@FILE] or local:SIZE");
}

unsigned parseSizes(std::string_view Text, std::array<uint32_t, 3> &Sizes) {
  Sizes = {1, 1, 1};
  for (unsigned Dim = 0; Dim != 3; ++Dim) {
    const size_t Comma = Text.find(',');
    if (!parseNumber(Text.substr(0, Comma), Sizes[Dim]) || Sizes[Dim] == 0)
      return 0;
    if (Comma == std::string_view::npos)
      return Dim + 1;
    Text.remove_prefix(Comma + 1);
  }
  return 0;
}

Expected<KernelRequest> parseRequest(std::string_view Text,
                                     const std::string &Where) {
  using Json = nlohmann::json;
  constexpr const char *Wanted =
      R"(an object of "kernel", "global", "local", "args")";
  const auto Object = parseJson<Json>(Text, Where, Wanted);
  if (!Object)
    return Object.error();
  if (!Object->is_object())
    return Error{Where, fmt::format("not a JSON object, expected {}", Wanted)};
  KernelRequest R;
  auto Sizes = [](const Json &Value, std::array<uint32_t, 3> &To) -> unsigned {
    if (!Value.is_array() || Value.empty() || Value.size() > 3)
      return 0;
    To = {1, 1, 1};
    for (size_t Dim = 0; Dim != Value.size(); ++Dim) {
      if (!Value[Dim].is_number_unsigned() ||
          Value[Dim].get<uint64_t>() - 1 >= UINT32_MAX)
        return 0;
      To[Dim] = Value[Dim].get<uint32_t>();
    }
    return static_cast<unsigned>(Value.size());
  };
  for (const auto &[Key, Value] : Object->items()) {
    if (Key == "kernel" && Value.is_string()) {
      R.Kernel = Value.get<std::string>();
    } else if (Key == "global") {
      R.WorkDim = Sizes(Value, R.Global);
    } else if (Key == "local") {
      if (!Sizes(Value, R.Local))
        return Error{Where, "\"local\": expected 1 to 3 whole numbers above 0"};
    } else if (Key == "args" && Value.is_array()) {
      for (const Json &Arg : Value) {
        if (!Arg.is_string())
          return Error{Where, "\"args\": expected strings such as \"i32:5\""};
        R.Args.push_back(Arg.get<std::string>());
      }
    } else {
      return Error{Where,
                   fmt::format("unknown or malformed key '{}', expected one "
                               "of kernel (a string), global, local (1 to 3 "
                               "whole numbers), args (strings)",
                               Key)};
    }
  }
  if (R.WorkDim == 0)
    return Error{Where, "\"global\": expected 1 to 3 whole numbers above 0"};
  return R;
}

} // namespace vorion::isasim
