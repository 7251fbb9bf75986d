#include "view/Server.h"

#include "io/Inside.h"
#include "view/Interrupt.h"
#include "view/PageFiles.h"
#include "vorion/support/Json.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <fmt/format.h>
#include <httplib.h>
#include <thread>
#include <utility>

namespace vorion::splat {

namespace {

constexpr const char *Loopback = "127.0.0.1";
constexpr const char *TokenHeader = "X-Splat-Token";

/// The page may run its own scripts and talk to this server, and nothing else;
/// no other page may show it in a frame.
const httplib::Headers Always{
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'self'; style-src 'self'; "
     "connect-src 'self'; img-src 'self' data:; base-uri 'none'; "
     "form-action 'none'; frame-ancestors 'none'"},
    {"X-Content-Type-Options", "nosniff"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Cache-Control", "no-store"}};

bool isPage(const std::string &Path) {
  return std::ranges::any_of(pageFiles(),
                             [&](const PageFile &F) { return F.Path == Path; });
}

void answerJson(httplib::Response &To, const std::string &Text) {
  To.set_content(Text, "application/json");
}

void refuse(httplib::Response &To, int Status, const std::string &Why) {
  To.status = Status;
  answerJson(To, jsonText(nlohmann::json{{"error", Why}}));
}

/// On one line, as a message of the command would have it.
void refuse(httplib::Response &To, const Error &E) {
  const bool IsAskers =
      E.Code == ExitCode::Usage || E.Code == ExitCode::InputFile;
  refuse(To,
         isSuperseded(E) ? 409
         : IsAskers      ? 400
                         : 500,
         E.Where.empty() ? escaped(E.What)
                         : escaped(E.Where) + ": " + escaped(E.What));
}

/// The facts' size in 4 bytes, little endian, the facts, the pixels.
std::string packed(const ViewAnswer &A) {
  const std::string Facts = jsonText(A.Facts);
  const auto Size = static_cast<uint32_t>(Facts.size());
  std::string Bytes(sizeof(Size), '\0');
  std::memcpy(Bytes.data(), &Size, sizeof(Size));
  return Bytes + Facts + A.Rgba;
}

} // namespace

struct Server::Parts {
  Parts(Guard D, Session &S) : Door(std::move(D)), Shown(S) {}

  Guard Door;
  Session &Shown;
  httplib::Server Http;
  int Port = 0;

  void setUp();
  void addRoutes();
};

void Server::Parts::setUp() {
  // SO_REUSEPORT, which the library sets else, would let two servers share a
  // port.
  Http.set_socket_options([](auto Socket) {
    const int Yes = 1;
    setsockopt(Socket, SOL_SOCKET, SO_REUSEADDR, &Yes, sizeof(Yes));
  });
  Http.set_tcp_nodelay(true);
  Http.set_default_headers(Always);
  Http.set_payload_max_length(LargestScene);
  // A body that is refused is not read, and may not become the next request.
  Http.set_keep_alive_max_count(1);
  Http.set_pre_routing_handler(
      [this](const httplib::Request &From, httplib::Response &To) {
        const auto Why = Door.refuse(
            {From.method == "POST", From.method == "GET" && isPage(From.path),
             From.get_header_value("Host"), From.get_header_value("Origin"),
             From.get_header_value(TokenHeader)});
        if (!Why)
          return httplib::Server::HandlerResponse::Unhandled;
        refuse(To, 403, *Why);
        return httplib::Server::HandlerResponse::Handled;
      });
  Http.set_error_handler(
      [](const httplib::Request & /*From*/, httplib::Response &To) {
        if (!To.body.empty())
          return;
        refuse(To, To.status,
               To.status == 413
                   ? fmt::format("the scene is too large, expected at most "
                                 "{} MiB",
                                 LargestScene >> 20)
                   : "there is nothing of this name");
      });
  Http.set_exception_handler([](const httplib::Request & /*From*/,
                                httplib::Response &To,
                                std::exception_ptr Thrown) {
    try {
      std::rethrow_exception(std::move(Thrown));
    } catch (const std::bad_alloc &) {
      refuse(To, 500, "memory ran out");
    } catch (const std::exception &E) {
      refuse(To, 500, fmt::format("a bug of ours: {}", escaped(E.what())));
    }
  });
  addRoutes();
}

void Server::Parts::addRoutes() {
  for (const PageFile &F : pageFiles())
    Http.Get(std::string(F.Path), [&F](const httplib::Request & /*From*/,
                                       httplib::Response &To) {
      To.set_content(F.Text.data(), F.Text.size(), std::string(F.Type));
    });
  Http.Get("/scene",
           [this](const httplib::Request & /*From*/, httplib::Response &To) {
             answerJson(To, Shown.describe());
           });
  Http.Post("/scene",
            [this](const httplib::Request &From, httplib::Response &To) {
              const std::string Name =
                  asFileName(printable(From.get_param_value("name")));
              if (auto Done = Shown.replace(Name, From.body); !Done)
                return refuse(To, Done.error());
              answerJson(To, Shown.describe());
            });
  Http.Post("/frame",
            [this](const httplib::Request &From, httplib::Response &To) {
              const auto Asked = parseViewRequest(From.body);
              if (!Asked)
                return refuse(To, Asked.error());
              const auto Answer = Shown.frame(*Asked);
              if (!Answer)
                return refuse(To, Answer.error());
              To.set_content(packed(*Answer), "application/octet-stream");
            });
  Http.Post("/pixel",
            [this](const httplib::Request &From, httplib::Response &To) {
              const auto Asked = parseViewRequest(From.body);
              if (!Asked)
                return refuse(To, Asked.error());
              answerJson(To, Shown.pixel(*Asked));
            });
}

Server::Server(std::unique_ptr<Parts> P) : All(std::move(P)) {}
Server::~Server() = default;

Expected<std::unique_ptr<Server>> Server::listen(int Port, Session &Shown) {
  auto Door = Guard::make();
  if (!Door)
    return Door.error();
  auto P = std::make_unique<Parts>(std::move(*Door), Shown);
  P->setUp();
  P->Port = Port == 0 ? P->Http.bind_to_any_port(Loopback)
            : P->Http.bind_to_port(Loopback, Port) ? Port
                                                   : -1;
  if (P->Port <= 0)
    return Error{"",
                 fmt::format("--port {}: is in use or not allowed, expected a "
                             "free one, or 0 for any",
                             Port),
                 ExitCode::Usage};
  P->Door.listensOn(P->Port);
  return std::unique_ptr<Server>(new Server(std::move(P)));
}

std::string Server::address() const {
  // Browsers keep what is behind the # to themselves.
  return fmt::format("http://{}:{}/#{}", Loopback, All->Port,
                     All->Door.token());
}

void Server::serve(const std::function<void()> &Announce) {
  std::atomic<bool> Ended = false;
  const Interrupt OnSignal([&] {
    All->Shown.giveUp();
    // Until it has begun, the library does not hear it.
    while (!Ended) {
      All->Http.stop();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  });
  Announce();
  All->Http.listen_after_bind();
  Ended = true;
}

} // namespace vorion::splat
