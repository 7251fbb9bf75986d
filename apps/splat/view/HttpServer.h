/// Answers HTTP/1.1 on 127.0.0.1. Whatever a client sends, or does not send,
/// takes bounded memory for a bounded time and keeps no other client waiting.
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

/// A whole request.
struct HttpCall {
  const HttpRequest &Request;
  /// Whether the client has closed the connection meanwhile.
  std::function<bool()> HasLeft;
};

/// What answers a request that is worth reading its body and a thread.
struct HttpWork {
  std::string Client;         ///< who asks, for HttpLimits::RequestsOfClient
  std::uint64_t MostBody = 0; ///< bytes
  std::function<HttpAnswer(const HttpCall &)> Answer; ///< on another thread
};

/// What clients may have. A connection begins, and ends, as a stranger's: it
/// has not shown yet, or not any more, a request that becomes HttpWork.
struct HttpLimits {
  std::size_t HeadBytes = 8 << 10;  ///< of a request line and all header lines
  std::size_t Strangers = 512;      ///< one more, and the oldest is closed
  std::size_t Requests = 16;        ///< one more is answered with 503
  std::size_t RequestsOfClient = 6; ///< one more is answered with 429
  /// Of the bodies of all requests; more is answered with 503.
  std::uint64_t BodyBytes = 16 << 20;

  /// \name From the first byte that is awaited to the last
  /// @{
  std::chrono::milliseconds Head{10'000};
  std::chrono::milliseconds Body{10'000}; ///< and a second more for each MiB
  std::chrono::milliseconds Answer{30'000};
  /// For what is still sent while a request is refused: to close at once would
  /// take the answer from the client.
  std::chrono::milliseconds Linger{1'000};
  /// @}
};

class HttpServer {
public:
  /// Decides by the head alone, at once: an answer, or the work to do.
  using Admit =
      std::function<std::variant<HttpAnswer, HttpWork>(const HttpHead &)>;
  /// The answer of this server itself, such as 431, about a request.
  using Refuse =
      std::function<HttpAnswer(unsigned Status, const std::string &Why)>;

  /// Names and values that every answer has.
  using Fields = std::vector<std::pair<std::string, std::string>>;

  /// Listens on \p Port of 127.0.0.1, 0 for a free one. Fails where the port is
  /// in use or not allowed.
  static Expected<std::unique_ptr<HttpServer>> listen(int Port, Fields Always,
                                                      Admit Decide, Refuse Say,
                                                      HttpLimits Most = {});
  ~HttpServer();

  int port() const;

  /// Answers until SIGHUP, SIGINT or SIGTERM, which count from before the call
  /// of \p Announce on, or until stop(). \p OnEnd is then called before the
  /// requests at work are waited for. A second signal ends the process at once.
  void serve(const std::function<void()> &Announce,
             const std::function<void()> &OnEnd);

  /// From any thread.
  void stop();

  struct Parts;

private:
  explicit HttpServer(std::unique_ptr<Parts> P);
  std::unique_ptr<Parts> All;
};

} // namespace vorion::splat
