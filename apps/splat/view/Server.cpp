#include "view/Server.h"

#include "io/Inside.h"
#include "view/Guard.h"
#include "view/HttpServer.h"
#include "view/PageFiles.h"
#include "vorion/support/Json.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace vorion::splat {

namespace http = boost::beast::http;

namespace {

constexpr const char *TokenHeader = "X-Splat-Token";
constexpr const char *PageHeader = "X-Splat-Page";

/// The page may run its own scripts and talk to this server, and nothing else;
/// no other page may show it in a frame.
const HttpServer::Fields Always{
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'self'; style-src 'self'; "
     "connect-src 'self'; img-src 'self' data:; base-uri 'none'; "
     "form-action 'none'; frame-ancestors 'none'"},
    {"X-Content-Type-Options", "nosniff"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Cache-Control", "no-store"}};

HttpAnswer json(std::string Text) {
  return {200, "application/json", std::move(Text)};
}

HttpAnswer refusal(unsigned Status, const std::string &Why) {
  HttpAnswer A = json(jsonText(nlohmann::json{{"error", Why}}));
  A.Status = Status;
  return A;
}

/// On one line, as a message of the command would have it.
HttpAnswer refusalOf(const Error &E) {
  const bool IsAskers =
      E.Code == ExitCode::Usage || E.Code == ExitCode::InputFile;
  return refusal(isSuperseded(E) ? 409
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

/// What a request asks of its target.
struct Target {
  std::string_view Path, Query;
  explicit Target(std::string_view Text)
      : Path(Text.substr(0, Text.find('?'))),
        Query(Text.substr(std::min(Text.size(), Path.size() + 1))) {}
};

std::string_view viewOf(boost::beast::string_view Text) {
  return {Text.data(), Text.size()};
}

/// The bytes that \p Text has as %XX; what is none stays.
std::string unescaped(std::string_view Text) {
  std::string Bytes;
  while (!Text.empty()) {
    unsigned char Byte = 0;
    if (Text[0] == '%' && Text.size() > 2 &&
        std::from_chars(&Text[1], &Text[1] + 2, Byte, 16).ptr == &Text[1] + 2) {
      Bytes += static_cast<char>(Byte);
      Text.remove_prefix(3);
    } else {
      Bytes += Text[0];
      Text.remove_prefix(1);
    }
  }
  return Bytes;
}

std::string nameOfScene(const HttpRequest &R) {
  constexpr std::string_view Key = "name=";
  std::string_view Query = Target(viewOf(R.target())).Query;
  if (!Query.starts_with(Key))
    return "";
  Query.remove_prefix(Key.size());
  return asFileName(printable(unescaped(Query.substr(0, Query.find('&')))));
}

} // namespace

struct Server::Parts {
  Parts(Guard D, Session &S) : Door(std::move(D)), Shown(S) {}

  Guard Door;
  Session &Shown;
  std::unique_ptr<HttpServer> Http;

  std::variant<HttpAnswer, HttpWork> admit(const HttpHead &R);
  HttpAnswer describe(const HttpCall &C);
  HttpAnswer open(const HttpCall &C);
  HttpAnswer frame(const HttpCall &C);
  HttpAnswer pixel(const HttpCall &C);
};

std::variant<HttpAnswer, HttpWork> Server::Parts::admit(const HttpHead &R) {
  const auto Field = [&](const char *Name) {
    const auto Value = R[Name];
    return std::string(Value.data(), Value.size());
  };
  const std::string_view Path = Target(viewOf(R.target())).Path;
  const auto Page = std::ranges::find(pageFiles(), Path, &PageFile::Path);
  const bool IsPage =
      R.method() == http::verb::get && Page != pageFiles().end();
  if (const auto Why =
          Door.refuse({R.method() == http::verb::post, IsPage, Field("Host"),
                       Field("Origin"), Field(TokenHeader)}))
    return refusal(403, *Why);
  if (IsPage)
    return HttpAnswer{200, std::string(Page->Type), std::string(Page->Text)};

  struct Route {
    http::verb Method;
    std::string_view Path;
    uint64_t MostBody;
    HttpAnswer (Parts::*Answer)(const HttpCall &);
  };
  constexpr std::array Routes{
      Route{http::verb::get, "/scene", 0, &Parts::describe},
      Route{http::verb::post, "/scene", LargestScene, &Parts::open},
      Route{http::verb::post, "/frame", LargestViewRequest, &Parts::frame},
      Route{http::verb::post, "/pixel", LargestViewRequest, &Parts::pixel}};
  const auto *const Found =
      std::ranges::find_if(Routes, [&](const Route &Each) {
        return Each.Method == R.method() && Each.Path == Path;
      });
  if (Found == Routes.end())
    return refusal(404, "no resource with this name");
  return HttpWork{
      Field(PageHeader), Found->MostBody,
      [this, Do = Found->Answer](const HttpCall &C) { return (this->*Do)(C); }};
}

HttpAnswer Server::Parts::describe(const HttpCall & /*C*/) {
  return json(Shown.describe());
}

HttpAnswer Server::Parts::open(const HttpCall &C) {
  if (auto Done = Shown.replace(nameOfScene(C.Request), C.Request.body());
      !Done)
    return refusalOf(Done.error());
  return json(Shown.describe());
}

HttpAnswer Server::Parts::frame(const HttpCall &C) {
  const auto Asked = parseViewRequest(C.Request.body());
  if (!Asked)
    return refusalOf(Asked.error());
  const auto Page = C.Request[PageHeader];
  const auto Answer =
      Shown.frame(*Asked, {std::string(Page.data(), Page.size()), C.HasLeft});
  if (!Answer)
    return refusalOf(Answer.error());
  return {200, "application/octet-stream", packed(*Answer)};
}

HttpAnswer Server::Parts::pixel(const HttpCall &C) {
  const auto Asked = parseViewRequest(C.Request.body());
  if (!Asked)
    return refusalOf(Asked.error());
  return json(Shown.pixel(*Asked));
}

Server::Server(std::unique_ptr<Parts> P) : All(std::move(P)) {}
Server::~Server() = default;

Expected<std::unique_ptr<Server>> Server::listen(int Port, Session &Shown) {
  auto Door = Guard::make();
  if (!Door)
    return Door.error();
  auto P = std::make_unique<Parts>(std::move(*Door), Shown);
  HttpLimits Most;
  // One scene is sent at a time.
  Most.BodyBytes = LargestScene + Most.Requests * LargestViewRequest;
  auto Http = HttpServer::listen(
      Port, Always,
      [Own = P.get()](const HttpHead &R) { return Own->admit(R); }, refusal,
      Most);
  if (!Http)
    return Http.error();
  P->Http = std::move(*Http);
  P->Door.listensOn(P->Http->port());
  return std::unique_ptr<Server>(new Server(std::move(P)));
}

std::string Server::address() const {
  // Browsers keep what is behind the # to themselves.
  return fmt::format("http://127.0.0.1:{}/#{}", All->Http->port(),
                     All->Door.token());
}

void Server::serve(const std::function<void()> &Announce) {
  All->Http->serve(Announce, [this] { All->Shown.giveUp(); });
}

} // namespace vorion::splat
