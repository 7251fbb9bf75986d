/// Access control of the server of `splat view`: only its own page, opened by
/// the printed address, may use it.
#pragma once

#include "vorion/support/Expected.h"

#include <optional>
#include <string>
#include <string_view>

namespace vorion::splat {

/// The origin of a request; empty strings for absent fields.
struct Visitor {
  bool IsPost = false;
  bool IsPage = false; ///< requests a file of the page, which is not secret
  std::string Host, Origin, Token;
};

/// Compares the strings in a time that depends only on the length of \p Asked.
bool sameInConstantTime(std::string_view Kept, std::string_view Asked);

class Guard {
public:
  /// Creates a token of 128 random bits. Fails if the system provides no random
  /// numbers.
  static Expected<Guard> make();
  explicit Guard(std::string Token) : Secret(std::move(Token)) {}

  /// Sets the loopback port of the server.
  void listensOn(int Port);

  /// The reason to reject \p V, as text; empty if it is accepted. Accepted
  /// requests satisfy:
  /// - The header Host names the loopback address and the port. This excludes
  ///   DNS rebinding, where Host is the name of another page.
  /// - Origin, which browsers send with every POST, is this server's page.
  /// - All requests except those for the page's files have the token.
  std::optional<std::string> refuse(const Visitor &V) const;

  const std::string &token() const { return Secret; }

private:
  std::string Secret, ByAddress, ByName;
};

} // namespace vorion::splat
