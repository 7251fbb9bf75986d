#include "view/HttpServer.h"

#include "vorion/support/Tool.h"

#include <algorithm>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core/error.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/system/system_error.hpp>
#include <csignal>
#include <exception>
#include <fcntl.h>
#include <fmt/format.h>
#include <limits>
#include <list>
#include <map>
#include <optional>
#include <sys/socket.h>
#include <utility>

namespace vorion::splat {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using asio::ip::tcp;
using Failure = beast::error_code;

namespace {

/// Of a body that is read at a time.
constexpr std::size_t PieceBytes = 64 << 10;
/// Until it is asked again for a connection that it could not have.
constexpr std::chrono::milliseconds AcceptAgain{50};

class Connection;

/// A process that is started meanwhile would keep the connection open.
void closeOnExec(int Socket) { ::fcntl(Socket, F_SETFD, FD_CLOEXEC); }

} // namespace

struct HttpServer::Parts {
  Fields Always;
  Admit Decide;
  Refuse Say;
  HttpLimits Most;

  /// \name Of the connections; used by the thread of serve() alone
  /// @{
  std::list<Connection *> Strangers; ///< oldest first
  std::map<std::string, std::size_t> RequestsOf;
  std::size_t Requests = 0;
  std::uint64_t BodyBytes = 0;
  /// @}

  asio::io_context Io{1};
  tcp::acceptor Acceptor{Io};
  asio::steady_timer Later{Io};
  asio::signal_set Signals{Io};
  asio::thread_pool Workers;

  Parts(Fields F, Admit D, Refuse S, HttpLimits L)
      : Always(std::move(F)), Decide(std::move(D)), Say(std::move(S)), Most(L),
        Workers(L.Requests) {}

  void accept();
  void dropOldest(std::size_t Left);
};

namespace {

/// One request and its answer. Its functions run on the thread of serve().
class Connection : public std::enable_shared_from_this<Connection> {
public:
  Connection(HttpServer::Parts &S, tcp::socket Accepted)
      : Server(S), Socket(std::move(Accepted)), Deadline(S.Io),
        Buffer(S.Most.HeadBytes) {}
  Connection(const Connection &) = delete;
  Connection &operator=(const Connection &) = delete;
  ~Connection() {
    endWork();
    if (Place)
      Server.Strangers.erase(*Place);
  }

  void start();
  /// Ends all that it waits for.
  void drop() {
    Failure Ignored;
    if (Socket.close(Ignored))
      return; // for it is closed
  }

private:
  HttpServer::Parts &Server;
  tcp::socket Socket;
  asio::steady_timer Deadline;
  beast::flat_buffer Buffer;
  std::optional<http::request_parser<http::string_body>> Parser;
  std::optional<std::list<Connection *>::iterator> Place; ///< if a stranger's
  std::optional<HttpWork> Work;
  std::uint64_t BodyBytes = 0; ///< that are reserved for Work
  http::response<http::string_body> Response;
  std::atomic<bool> HasLeft = false;

  void dropAfter(std::chrono::milliseconds Time);
  void becomeStranger();
  void decide();
  void begin(HttpWork W);
  void work();
  void watch();
  void endWork();
  void refuse(unsigned Status, const std::string &Why) {
    answer(Server.Say(Status, Why));
  }
  void refuseBody(std::uint64_t Most) {
    refuse(413, fmt::format("the request's body is too large, expected at most "
                            "{} bytes",
                            Most));
  }
  void refuseFor(Failure Why);
  void answer(HttpAnswer A);
  void finish();
  void linger();
};

/// In place of what was said before. beast::tcp_stream has no such time for a
/// client that never lets it wait.
void Connection::dropAfter(std::chrono::milliseconds Time) {
  Deadline.expires_after(Time);
  Deadline.async_wait([Of = weak_from_this()](Failure Why) {
    const auto Self = Of.lock();
    if (!Why && Self &&
        Self->Deadline.expiry() <= asio::steady_timer::clock_type::now())
      Self->drop();
  });
}

void Connection::becomeStranger() {
  Place = Server.Strangers.insert(Server.Strangers.end(), this);
  Server.dropOldest(Server.Most.Strangers);
}

void Connection::start() {
  Failure Gone;
  if (Socket.set_option(tcp::no_delay(true), Gone))
    return;
  closeOnExec(Socket.native_handle());
  becomeStranger();
  Parser.emplace();
  Parser->header_limit(static_cast<std::uint32_t>(Server.Most.HeadBytes));
  // Its limit depends on who asks.
  Parser->body_limit(std::numeric_limits<std::uint64_t>::max());
  dropAfter(Server.Most.Head);
  http::async_read_header(
      Socket, Buffer, *Parser,
      [Self = shared_from_this()](Failure Why, std::size_t) {
        if (Why)
          Self->refuseFor(Why);
        else
          Self->decide();
      });
}

void Connection::decide() {
  auto Decision = Server.Decide(Parser->get().base());
  if (auto *const A = std::get_if<HttpAnswer>(&Decision))
    answer(std::move(*A));
  else
    begin(std::get<HttpWork>(std::move(Decision)));
}

void Connection::begin(HttpWork W) {
  const auto Length = Parser->content_length();
  if (Length.value_or(0) > W.MostBody)
    return refuseBody(W.MostBody);
  const std::uint64_t Reserved = Length              ? *Length
                                 : Parser->chunked() ? W.MostBody
                                                     : 0;
  const auto Own = Server.RequestsOf.find(W.Client);
  if (Own != Server.RequestsOf.end() &&
      Own->second >= Server.Most.RequestsOfClient)
    return refuse(
        429,
        fmt::format(
            "{} requests are in progress, expected fewer concurrent requests",
            Own->second));
  if (Server.Requests >= Server.Most.Requests ||
      Server.BodyBytes + Reserved > Server.Most.BodyBytes)
    return refuse(503, "the server's queue is full, expected a later request");
  Work = std::move(W);
  BodyBytes = Reserved;
  ++Server.RequestsOf[Work->Client];
  ++Server.Requests;
  Server.BodyBytes += BodyBytes;
  Server.Strangers.erase(*std::exchange(Place, std::nullopt));

  Parser->body_limit(Work->MostBody);
  Buffer.max_size(PieceBytes);
  dropAfter(Server.Most.Body + std::chrono::seconds(Reserved >> 20));
  http::async_read(Socket, Buffer, *Parser,
                   [Self = shared_from_this()](Failure Why, std::size_t) {
                     if (Why)
                       Self->refuseFor(Why);
                     else
                       Self->work();
                   });
}

void Connection::work() {
  Deadline.cancel();
  watch();
  asio::post(Server.Workers, [Self = shared_from_this()]() mutable {
    HttpAnswer A;
    try {
      A = Self->Work->Answer(
          {Self->Parser->get(), [&] { return Self->HasLeft.load(); }});
    } catch (const std::exception &E) {
      A = Self->Server.Say(500, fmt::format("a bug of ours: {}", E.what()));
    }
    auto &Io = Self->Server.Io;
    asio::post(Io, [Self = std::move(Self), A = std::move(A)]() mutable {
      Self->answer(std::move(A));
    });
  });
}

/// Notes when the client closes the connection. One that only ends what it
/// sends looks the same; browsers do not.
void Connection::watch() {
  Socket.async_wait(tcp::socket::wait_read,
                    [Self = shared_from_this()](Failure Why) {
                      char Next = 0;
                      // Another request behind this one hides the end; it has
                      // no answer.
                      if (!Why && ::recv(Self->Socket.native_handle(), &Next, 1,
                                         MSG_PEEK | MSG_DONTWAIT) <= 0)
                        Self->HasLeft = true;
                    });
}

void Connection::endWork() {
  if (!Work)
    return;
  const auto Own = Server.RequestsOf.find(Work->Client);
  if (--Own->second == 0)
    Server.RequestsOf.erase(Own);
  --Server.Requests;
  Server.BodyBytes -= BodyBytes;
  Work.reset();
}

void Connection::refuseFor(Failure Why) {
  if (Why == http::error::header_limit || Why == http::error::buffer_overflow)
    return refuse(431, fmt::format("the request's header is too long, "
                                   "expected at most {} bytes",
                                   Server.Most.HeadBytes));
  if (Why == http::error::body_limit)
    return refuseBody(Work->MostBody);
  if (Why.category() == make_error_code(http::error::bad_method).category() &&
      Why != http::error::end_of_stream)
    refuse(400, fmt::format("the request is not HTTP: {}", Why.message()));
}

void Connection::answer(HttpAnswer A) {
  const bool IsHead = Parser->get().method() == http::verb::head;
  Parser.reset();
  Response.base() = http::response_header<>();
  for (const auto &[Name, Value] : Server.Always)
    Response.set(Name, Value);
  Response.result(A.Status);
  Response.set(http::field::content_type, A.Type);
  Response.keep_alive(false);
  if (!IsHead)
    Response.body() = std::move(A.Body);
  Response.prepare_payload();
  dropAfter(Server.Most.Answer);
  http::async_write(Socket, Response,
                    [Self = shared_from_this()](Failure Why, std::size_t) {
                      if (!Why)
                        Self->finish();
                    });
}

void Connection::finish() {
  Response.body() = {};
  if (Work) {
    endWork();
    becomeStranger();
  }
  Failure Gone;
  if (Socket.shutdown(tcp::socket::shutdown_send, Gone))
    return;
  dropAfter(Server.Most.Linger);
  linger();
}

void Connection::linger() {
  Buffer.clear();
  Socket.async_read_some(Buffer.prepare(Server.Most.HeadBytes),
                         [Self = shared_from_this()](Failure Why, std::size_t) {
                           if (Why)
                             Self->drop();
                           else
                             Self->linger();
                         });
}

} // namespace

void HttpServer::Parts::dropOldest(std::size_t Left) {
  // Each leaves the list when its last call ends, which is later.
  auto Oldest = Strangers.begin();
  for (std::size_t I = Strangers.size(); I > Left; --I)
    (*Oldest++)->drop();
}

void HttpServer::Parts::accept() {
  Acceptor.async_accept([this](Failure Why, tcp::socket Socket) {
    if (Why == asio::error::operation_aborted)
      return;
    if (!Why) {
      std::make_shared<Connection>(*this, std::move(Socket))->start();
      return accept();
    }
    // Such as a limit on the process's files.
    dropOldest(Strangers.size() / 2);
    Later.expires_after(AcceptAgain);
    Later.async_wait([this](Failure Ended) {
      if (!Ended)
        accept();
    });
  });
}

HttpServer::HttpServer(std::unique_ptr<Parts> P) : All(std::move(P)) {}
HttpServer::~HttpServer() = default;

Expected<std::unique_ptr<HttpServer>>
HttpServer::listen(int Port, Fields Always, Admit Decide, Refuse Say,
                   HttpLimits Most) {
  auto P = std::make_unique<Parts>(std::move(Always), std::move(Decide),
                                   std::move(Say), Most);
  const tcp::endpoint Here(asio::ip::address_v4::loopback(),
                           static_cast<std::uint16_t>(Port));
  tcp::acceptor &A = P->Acceptor;
  try {
    A.open(Here.protocol());
    closeOnExec(A.native_handle());
    A.set_option(tcp::acceptor::reuse_address(true));
    A.bind(Here);
    A.listen(tcp::acceptor::max_listen_connections);
  } catch (const boost::system::system_error &) {
    return Error{"",
                 fmt::format("--port {}: is in use or not permitted, expected "
                             "a free port, or 0 for any",
                             Port),
                 ExitCode::Usage};
  }
  return std::unique_ptr<HttpServer>(new HttpServer(std::move(P)));
}

int HttpServer::port() const { return All->Acceptor.local_endpoint().port(); }

void HttpServer::serve(const std::function<void()> &Announce,
                       const std::function<void()> &OnEnd) {
  for (const int Number : {SIGHUP, SIGINT, SIGTERM}) {
    struct sigaction Present{};
    sigaction(Number, nullptr, &Present);
    if (Present.sa_handler != SIG_IGN) // as nohup has it
      All->Signals.add(Number);
  }
  All->Signals.async_wait([this](Failure Why, int /*Number*/) {
    if (!Why)
      All->Io.stop();
  });
  All->accept();
  Announce();
  All->Io.run();
  All->Signals.clear();
  catchEndingSignals();
  OnEnd();
  All->Workers.join();
}

void HttpServer::serveUntilStopped() {
  All->accept();
  All->Io.run();
  All->Workers.join();
}

void HttpServer::stop() { All->Io.stop(); }

} // namespace vorion::splat
