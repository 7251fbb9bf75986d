/// The server of `splat view`, accessible only from this computer.
#pragma once

#include "view/Session.h"

#include <functional>
#include <memory>
#include <string>

namespace vorion::splat {

class Server {
public:
  /// Listens on \p Port of 127.0.0.1, 0 for a free one. \p Shown must outlive
  /// the server. Fails if the port is in use.
  static Expected<std::unique_ptr<Server>> listen(int Port, Session &Shown);
  ~Server();

  /// The URL of the page, including the token.
  std::string address() const;

  /// Serves until SIGHUP, SIGINT or SIGTERM, which are handled from before the
  /// call of \p Announce. A second signal terminates the process immediately.
  void serve(const std::function<void()> &Announce);

private:
  struct Parts;
  explicit Server(std::unique_ptr<Parts> P);
  std::unique_ptr<Parts> All;
};

} // namespace vorion::splat
