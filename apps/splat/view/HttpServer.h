/// HTTP/1.1 server on 127.0.0.1. Memory and time of a client are bounded
/// whatever it sends, and it cannot block other clients.
#pragma once

#include "vorion/support/Expected.h"

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace vorion::splat {

using HttpHead = boost::beast::http::request_header<>;
using HttpRequest =
    boost::beast::http::request<boost::beast::http::string_body>;

struct HttpAnswer {
  unsigned Status = 200;
  std::string Type, Body;
};

/// A complete request.
struct HttpCall {
  const HttpRequest &Request;
  /// Whether the client has closed the connection.
  std::function<bool()> HasLeft;
};

/// The work for a request that needs its body and a thread.
struct HttpWork {
  std::string Client;         ///< client name, for HttpLimits::RequestsOfClient
  std::uint64_t MostBody = 0; ///< bytes
  std::function<HttpAnswer(const HttpCall &)> Answer; ///< on another thread
};

/// Limits of clients. A connection without a request that is HttpWork counts as
/// a stranger: before its first request and after the last.
struct HttpLimits {
  std::size_t HeadBytes = 8 << 10;  ///< of a request line and all header lines
  std::size_t Strangers = 512;      ///< beyond that, the oldest is closed
  std::size_t Requests = 16;        ///< beyond that, status 503
  std::size_t RequestsOfClient = 6; ///< beyond that, status 429
  /// Total size of all bodies; beyond that, status 503.
  std::uint64_t BodyBytes = 16 << 20;

  /// \name Time limits, from the first awaited byte to the last
  /// @{
  std::chrono::milliseconds Head{10'000};
  std::chrono::milliseconds Body{10'000}; ///< plus one second per MiB
  std::chrono::milliseconds Answer{30'000};
  /// For data that arrives after a request is rejected: closing immediately
  /// could discard the response.
  std::chrono::milliseconds Linger{1'000};
  /// @}
};

class HttpServer {
public:
  /// Decides by the head only, without blocking: a response, or work.
  using Admit =
      std::function<std::variant<HttpAnswer, HttpWork>(const HttpHead &)>;
  /// The response to an error of the protocol, such as 431.
  using Refuse =
      std::function<HttpAnswer(unsigned Status, const std::string &Why)>;

  /// Header fields of every response.
  using Fields = std::vector<std::pair<std::string, std::string>>;

  /// Listens on \p Port of 127.0.0.1, 0 for a free one. Fails if the port is in
  /// use or not permitted.
  static Expected<std::unique_ptr<HttpServer>> listen(int Port, Fields Always,
                                                      Admit Decide, Refuse Say,
                                                      HttpLimits Most = {});
  ~HttpServer();

  int port() const;

  /// Serves until SIGHUP, SIGINT or SIGTERM, which are handled from before the
  /// call of \p Announce, or until stop(). Then calls \p OnEnd and waits for
  /// the requests in progress. A second signal terminates the process
  /// immediately.
  void serve(const std::function<void()> &Announce,
             const std::function<void()> &OnEnd);

  /// Serves until stop(), and leaves signals alone.
  void serveUntilStopped();

  /// May be called on any thread.
  void stop();

  struct Parts;

private:
  explicit HttpServer(std::unique_ptr<Parts> P);
  std::unique_ptr<Parts> All;
};

} // namespace vorion::splat
