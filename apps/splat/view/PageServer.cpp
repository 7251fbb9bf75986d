#include "view/PageServer.h"

#include "view/Guard.h"
#include "view/Request.h"
#include "vorion/support/Json.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
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

HttpAnswer refusal(unsigned Status, const std::string &Why) {
  HttpAnswer A = jsonAnswer(jsonText(nlohmann::json{{"error", Why}}));
  A.Status = Status;
  return A;
}

/// What a request asks of its target.
struct Target {
  std::string_view Path, Query;
  explicit Target(boost::beast::string_view Of) {
    const std::string_view Text(Of.data(), Of.size());
    Path = Text.substr(0, Text.find('?'));
    Query = Text.substr(std::min(Text.size(), Path.size() + 1));
  }
};

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

std::string fieldOf(const HttpHead &R, const char *Name) {
  const auto Value = R[Name];
  return {Value.data(), Value.size()};
}

} // namespace

HttpAnswer jsonAnswer(std::string Text) {
  return {200, "application/json", std::move(Text)};
}

HttpAnswer refusalOf(const Error &E) {
  const bool IsAskers =
      E.Code == ExitCode::Usage || E.Code == ExitCode::InputFile;
  return refusal(isSuperseded(E) ? 409
                 : IsAskers      ? 400
                                 : 500,
                 E.Where.empty() ? escaped(E.What)
                                 : escaped(E.Where) + ": " + escaped(E.What));
}

HttpAnswer packedAnswer(const std::string &Facts, std::string_view Bytes) {
  const auto Size = static_cast<uint32_t>(Facts.size());
  std::string Body(sizeof(Size), '\0');
  std::memcpy(Body.data(), &Size, sizeof(Size));
  Body.reserve(Body.size() + Facts.size() + Bytes.size());
  Body += Facts;
  Body += Bytes;
  return {200, "application/octet-stream", std::move(Body)};
}

std::string pageOf(const HttpCall &C) { return fieldOf(C.Request, PageHeader); }

std::string nameInQuery(const HttpCall &C) {
  constexpr std::string_view Key = "name=";
  std::string_view Query = Target(C.Request.target()).Query;
  if (!Query.starts_with(Key))
    return "";
  Query.remove_prefix(Key.size());
  return printable(unescaped(Query.substr(0, Query.find('&'))));
}

struct PageServer::Parts {
  Guard Door;
  std::string_view Home;
  std::vector<Route> Routes;
  std::unique_ptr<HttpServer> Http;

  std::variant<HttpAnswer, HttpWork> admit(const HttpHead &R);
};

std::variant<HttpAnswer, HttpWork> PageServer::Parts::admit(const HttpHead &R) {
  const std::string_view Path = Target(R.target()).Path;
  const auto Page = std::ranges::find(pageFiles(), Path == "/" ? Home : Path,
                                      &PageFile::Path);
  const bool IsPage =
      R.method() == http::verb::get && Page != pageFiles().end();
  if (const auto Why = Door.refuse({R.method() == http::verb::post, IsPage,
                                    fieldOf(R, "Host"), fieldOf(R, "Origin"),
                                    fieldOf(R, TokenHeader)}))
    return refusal(403, *Why);
  if (IsPage)
    return HttpAnswer{200, std::string(Page->Type), std::string(Page->Text)};
  const auto Found = std::ranges::find_if(Routes, [&](const Route &Each) {
    return Each.Method == R.method() && Each.Path == Path;
  });
  if (Found == Routes.end())
    return refusal(404, "no resource with this name");
  return HttpWork{fieldOf(R, PageHeader), Found->MostBody, Found->Answer};
}

PageServer::PageServer(std::unique_ptr<Parts> P) : All(std::move(P)) {}
PageServer::~PageServer() = default;

Expected<std::unique_ptr<PageServer>>
PageServer::listen(int Port, std::string_view Home, std::vector<Route> Routes,
                   uint64_t MostBodies) {
  auto Door = Guard::make();
  if (!Door)
    return Door.error();
  auto P = std::make_unique<Parts>(
      Parts{std::move(*Door), Home, std::move(Routes), nullptr});
  HttpLimits Most;
  Most.BodyBytes = MostBodies;
  auto Http = HttpServer::listen(
      Port, Always,
      [Own = P.get()](const HttpHead &R) { return Own->admit(R); }, refusal,
      Most);
  if (!Http)
    return Http.error();
  P->Http = std::move(*Http);
  P->Door.listensOn(P->Http->port());
  return std::unique_ptr<PageServer>(new PageServer(std::move(P)));
}

std::string PageServer::address() const {
  // Browsers keep what is behind the # to themselves.
  return fmt::format("http://127.0.0.1:{}/#{}", All->Http->port(),
                     All->Door.token());
}

void PageServer::serve(const std::function<void()> &Announce,
                       const std::function<void()> &OnEnd) {
  All->Http->serve(Announce, OnEnd);
}

void PageServer::serveUntilStopped() { All->Http->serveUntilStopped(); }

void PageServer::stop() { All->Http->stop(); }

} // namespace vorion::splat
