/// The server of `splat view`, for this computer alone.
#pragma once

#include "view/Session.h"

#include <functional>
#include <memory>
#include <string>

namespace vorion::splat {

class Server {
public:
  /// Listens on \p Port of 127.0.0.1, 0 for a free one. \p Shown must outlive
  /// this. Fails where the port is in use.
  static Expected<std::unique_ptr<Server>> listen(int Port, Session &Shown);
  ~Server();

  /// With the token.
  std::string address() const;

  /// Answers until SIGHUP, SIGINT or SIGTERM, which count from before the call
  /// of \p Announce on; a second one ends the process at once.
  void serve(const std::function<void()> &Announce);

private:
  struct Parts;
  explicit Server(std::unique_ptr<Parts> P);
  std::unique_ptr<Parts> All;
};

} // namespace vorion::splat
