/// Who may use the server of `splat view`: the page that it sends itself, in
/// the hands of somebody who knows the address that was printed.
#pragma once

#include "vorion/support/Expected.h"

#include <optional>
#include <string>
#include <string_view>

namespace vorion::splat {

/// What a request says of where it comes from; empty where it says nothing.
struct Visitor {
  bool IsPost = false;
  bool IsPage = false; ///< asks for a file of the page, which holds no secret
  std::string Host, Origin, Token;
};

/// Whether both are the same; the time depends on the length of \p Asked alone.
bool sameInConstantTime(std::string_view Kept, std::string_view Asked);

class Guard {
public:
  /// With a token of 128 random bits. Fails where the system has none.
  static Expected<Guard> make();
  explicit Guard(std::string Token) : Secret(std::move(Token)) {}

  /// What is listened on, of the loopback.
  void listensOn(int Port);

  /// Why \p V may not pass, for people; nothing if it may.
  /// - The header Host names the loopback and our port: a page elsewhere whose
  ///   name is made to point here (DNS rebinding) names itself.
  /// - Origin, which browsers send with every POST, is our own page.
  /// - All but the page's files need the token.
  std::optional<std::string> refuse(const Visitor &V) const;

  const std::string &token() const { return Secret; }

private:
  std::string Secret, ByAddress, ByName;
};

} // namespace vorion::splat
