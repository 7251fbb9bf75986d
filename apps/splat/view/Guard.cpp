#include "view/Guard.h"

#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <unistd.h>

namespace vorion::splat {

bool sameInConstantTime(std::string_view Kept, std::string_view Asked) {
  unsigned Differs = Kept.size() == Asked.size() ? 0U : 1U;
  for (std::size_t I = 0; I != Asked.size(); ++I) {
    const char Other = Kept.empty() ? '\0' : Kept[I % Kept.size()];
    Differs |= static_cast<unsigned char>(Asked[I]) ^
               static_cast<unsigned>(static_cast<unsigned char>(Other));
  }
  return Differs == 0;
}

Expected<Guard> Guard::make() {
  std::array<unsigned char, 16> Random{};
  if (getentropy(Random.data(), Random.size()) != 0)
    return Error{"", "the system has no random bytes for a token, expected "
                     "getrandom() to work"};
  std::string Token;
  for (const unsigned char Byte : Random)
    Token += fmt::format("{:02x}", Byte);
  return Guard(std::move(Token));
}

void Guard::listensOn(int Port) {
  ByAddress = fmt::format("127.0.0.1:{}", Port);
  ByName = fmt::format("localhost:{}", Port);
}

std::optional<std::string> Guard::refuse(const Visitor &V) const {
  if (V.Host != ByAddress && V.Host != ByName)
    return "the request's host is not this server";
  // Its absence is no browser's: curl sends none with a GET.
  if ((V.IsPost || !V.Origin.empty()) && V.Origin != "http://" + V.Host)
    return "the request's origin is not a page of this server";
  if (!V.IsPage && !sameInConstantTime(Secret, V.Token))
    return "the token is missing or invalid, expected the address that splat "
           "view has printed";
  return std::nullopt;
}

} // namespace vorion::splat
