#include "view/HttpServer.h"

#include <arpa/inet.h>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <gtest/gtest.h>
#include <memory>
#include <netinet/in.h>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

using namespace vorion;
using namespace vorion::splat;

namespace {

class Client {
public:
  explicit Client(int Port)
      : Socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in To{};
    To.sin_family = AF_INET;
    To.sin_port = htons(static_cast<uint16_t>(Port));
    To.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(Socket, reinterpret_cast<sockaddr *>(&To), sizeof(To)),
              0);
  }
  Client(Client &&From) noexcept : Socket(std::exchange(From.Socket, -1)) {}
  Client &operator=(Client &&) = delete;
  ~Client() { close(); }

  /// False if the server takes no more.
  bool send(const std::string &Text) const {
    return ::send(Socket, Text.data(), Text.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(Text.size());
  }
  /// All until the server ends the connection.
  std::string receive() const {
    std::string All;
    std::array<char, 4096> Part{};
    for (ssize_t Got = 0;
         (Got = ::recv(Socket, Part.data(), Part.size(), 0)) > 0;)
      All.append(Part.data(), static_cast<std::size_t>(Got));
    return All;
  }
  void close() {
    if (Socket >= 0)
      ::close(std::exchange(Socket, -1));
  }

private:
  int Socket;
};

/// The status of an answer; 0 without one.
int statusOf(const std::string &Answer) {
  return Answer.starts_with("HTTP/1.1 ") ? std::stoi(Answer.substr(9)) : 0;
}

/// /page is answered at once; /echo with the body; /wait by the client of the
/// field "client" when the test says so, or when the client has left.
class HttpServerTest : public testing::Test {
protected:
  static std::variant<HttpAnswer, HttpWork> admit(HttpServerTest &Test,
                                                  const HttpHead &R) {
    const auto Field = R["client"];
    HttpWork Work{std::string(Field.data(), Field.size()), 1000, {}};
    if (R.target() == "/echo")
      Work.Answer = [](const HttpCall &C) {
        return HttpAnswer{200, "text/plain", C.Request.body()};
      };
    else if (R.target() == "/wait")
      Work.Answer = [&Test](const HttpCall &C) {
        ++Test.Waiting;
        while (!C.HasLeft() && !Test.GoOn)
          std::this_thread::yield();
        --Test.Waiting;
        return HttpAnswer{200, "text/plain", "waited"};
      };
    else
      return HttpAnswer{R.target() == "/page" ? 200U : 404U, "text/plain",
                        "page"};
    return Work;
  }

  void listen(HttpLimits Most = {}) {
    auto Made = HttpServer::listen(
        0, {{"Always", "there"}},
        [this](const HttpHead &R) { return admit(*this, R); },
        [](unsigned Status, const std::string &Why) {
          return HttpAnswer{Status, "text/plain", Why};
        },
        Most);
    ASSERT_TRUE(Made);
    Server = std::move(*Made);
  }
  void start(HttpLimits Most = {}) {
    listen(Most);
    Serving = std::thread([this] { Server->serve([] {}, [] {}); });
  }
  void TearDown() override {
    GoOn = true;
    if (Server)
      Server->stop();
    if (Serving.joinable())
      Serving.join();
  }

  Client connect() const { return Client(Server->port()); }
  std::string ask(const std::string &Text) const {
    const Client C = connect();
    C.send(Text);
    return C.receive();
  }
  int page() const { return statusOf(ask("GET /page HTTP/1.1\r\n\r\n")); }
  void awaitWaiting(int Many) const {
    while (Waiting != Many)
      std::this_thread::yield();
  }

  std::atomic<bool> GoOn = false;
  std::atomic<int> Waiting = 0;
  std::unique_ptr<HttpServer> Server;
  std::thread Serving;
};

TEST_F(HttpServerTest, AnswersOneRequestAConnection) {
  start();
  const std::string Answer =
      ask("POST /echo HTTP/1.1\r\nContent-Length: 5\r\n\r\n"
          "wordsGET /page HTTP/1.1\r\n\r\n");
  EXPECT_EQ(statusOf(Answer), 200);
  EXPECT_NE(Answer.find("Always: there\r\n"), std::string::npos);
  EXPECT_TRUE(Answer.ends_with("\r\n\r\nwords")) << Answer;
  EXPECT_TRUE(ask("HEAD /page HTTP/1.1\r\n\r\n").ends_with("\r\n\r\n"));
}

TEST_F(HttpServerTest, SlowConnectionsKeepNobodyWaiting) {
  HttpLimits Most;
  Most.Strangers = 20;
  start(Most);
  std::vector<Client> Slow;
  for (int I = 0; I != 100; ++I) {
    Slow.push_back(connect());
    Slow.back().send("GET / HT");
  }
  EXPECT_EQ(page(), 200);
  // The oldest ones had to go.
  EXPECT_EQ(Slow.front().receive(), "");
}

TEST_F(HttpServerTest, ManyConnectionsAtOnceAreAllAnswered) {
  start();
  std::vector<Client> All;
  for (int I = 0; I != 200; ++I)
    All.push_back(connect());
  for (const Client &C : All)
    C.send("GET /page HTTP/1.1\r\n\r\n");
  for (const Client &C : All)
    EXPECT_EQ(statusOf(C.receive()), 200);
}

TEST_F(HttpServerTest, AHeadAndABodyHaveTheirTimes) {
  HttpLimits Most;
  Most.Head = Most.Body = std::chrono::milliseconds(50);
  start(Most);
  const Client Head = connect(), Silent = connect(), Body = connect();
  Head.send("GET / HT");
  Body.send("POST /echo HTTP/1.1\r\nContent-Length: 5\r\n\r\nwor");
  EXPECT_EQ(Head.receive() + Silent.receive() + Body.receive(), "");
  EXPECT_EQ(page(), 200);
}

TEST_F(HttpServerTest, AByteNowAndThenGainsNoTime) {
  HttpLimits Most;
  Most.Head = std::chrono::milliseconds(100);
  start(Most);
  const Client Slow = connect();
  Slow.send("GET / HTTP/1.1\r\nX: ");
  while (Slow.send("x"))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(page(), 200);
}

TEST_F(HttpServerTest, ARefusedClientThatNeverPausesIsDropped) {
  HttpLimits Most;
  Most.Linger = std::chrono::milliseconds(20);
  start(Most);
  const Client C = connect();
  C.send("GET /none HTTP/1.1\r\n\r\n");
  const std::string Piece(1 << 16, 'a');
  std::size_t Sent = 0;
  while (C.send(Piece))
    ASSERT_LT(Sent += Piece.size(), std::size_t{1} << 32);
}

TEST_F(HttpServerTest, AHeadHasItsSize) {
  HttpLimits Most;
  Most.Linger = std::chrono::milliseconds(20);
  start(Most);
  const Client Lines = connect(), Line = connect();
  Lines.send("GET /page HTTP/1.1\r\n");
  while (Lines.send("X-Line: " + std::string(100, 'a') + "\r\n"))
    ;
  Line.send("GET /");
  while (Line.send(std::string(100, 'a')))
    ;
  EXPECT_EQ(page(), 200);
  const std::string Long = "GET /page HTTP/1.1\r\nX-Line: " +
                           std::string(HttpLimits().HeadBytes, 'a') +
                           "\r\n\r\n";
  EXPECT_EQ(statusOf(ask(Long)), 431);
}

TEST_F(HttpServerTest, ABodyHasItsSize) {
  HttpLimits Most;
  Most.Linger = std::chrono::milliseconds(20);
  start(Most);
  const std::string Post = "POST /echo HTTP/1.1\r\n";
  EXPECT_EQ(statusOf(ask(Post + "Content-Length: 1001\r\n\r\n")), 413);
  EXPECT_EQ(
      statusOf(ask(Post + "Content-Length: 18446744073709551615\r\n\r\n")),
      413);
  const std::string Chunked = Post + "Transfer-Encoding: chunked\r\n\r\n";
  std::string Chunks;
  for (int I = 0; I != 11; ++I)
    Chunks += "64\r\n" + std::string(100, 'x') + "\r\n";
  EXPECT_EQ(statusOf(ask(Chunked + Chunks)), 413);
  EXPECT_EQ(statusOf(ask(Chunked + "FFFFFFFFFFFFFFFF\r\n")), 413);
  EXPECT_TRUE(ask(Chunked + "3\r\nabc\r\n2\r\nde\r\n0\r\n\r\n")
                  .ends_with("\r\n\r\nabcde"));
  // Nor do a chunk's own lines grow without end.
  const Client Endless = connect();
  Endless.send(Chunked + "1;");
  while (Endless.send(std::string(1000, 'a')))
    ;
  EXPECT_EQ(page(), 200);
}

TEST_F(HttpServerTest, RefusesWhatIsNotHttp) {
  start();
  for (const std::string Text :
       {"\r\n\r\n\r\n\r\n", "GET\r\n\r\n", "GET /page HTTP/2.0\r\n\r\n",
        "GET /page HTTP/1.1\r\n: x\r\n\r\n",
        "POST /echo HTTP/1.1\r\nContent-Length: x\r\n\r\n",
        "POST /echo HTTP/1.1\r\nContent-Length: 1\r\nContent-Length: "
        "2\r\n\r\nab",
        "POST /echo HTTP/1.1\r\nContent-Length: 1\r\n"
        "Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n"})
    EXPECT_EQ(statusOf(ask(Text)), 400) << Text;
}

TEST_F(HttpServerTest, AClientHasItsShareOfRequests) {
  HttpLimits Most;
  Most.RequestsOfClient = 2;
  Most.Requests = 3;
  start(Most);
  const auto Wait = [&](const std::string &Who) {
    Client C = connect();
    C.send("GET /wait HTTP/1.1\r\nclient: " + Who + "\r\n\r\n");
    return C;
  };
  const Client First = Wait("a"), Second = Wait("a");
  awaitWaiting(2);
  EXPECT_EQ(statusOf(Wait("a").receive()), 429);
  const Client Other = Wait("b");
  awaitWaiting(3);
  EXPECT_EQ(statusOf(Wait("c").receive()), 503);
  EXPECT_EQ(page(), 200);
  GoOn = true;
  for (const Client *C : {&First, &Second, &Other})
    EXPECT_EQ(statusOf(C->receive()), 200);
  EXPECT_EQ(statusOf(Wait("a").receive()), 200);
}

TEST_F(HttpServerTest, BodiesShareWhatTheyMayTake) {
  HttpLimits Most;
  Most.BodyBytes = 1500;
  start(Most);
  const std::string Post =
      "POST /echo HTTP/1.1\r\nContent-Length: 1000\r\n\r\n";
  const Client First = connect();
  First.send(Post);
  // Which of two requests is read first is nobody's to say.
  while (statusOf(ask(Post + std::string(1000, 'x'))) != 503)
    ;
  First.send(std::string(1000, 'x'));
  EXPECT_EQ(statusOf(First.receive()), 200);
  EXPECT_EQ(statusOf(ask(Post + std::string(1000, 'x'))), 200);
}

TEST_F(HttpServerTest, NotesThatAClientHasLeft) {
  start();
  Client C = connect();
  C.send("GET /wait HTTP/1.1\r\n\r\n");
  awaitWaiting(1);
  C.close();
  awaitWaiting(0);
  EXPECT_EQ(page(), 200);
}

TEST_F(HttpServerTest, StartedProcessesGetNoConnection) {
  start();
  const Client C = connect();
  C.send("GET /wait HTTP/1.1\r\n\r\n");
  awaitWaiting(1);
  EXPECT_NE(std::system("ls -l /proc/self/fd | grep -q socket:"), 0);
}

TEST_F(HttpServerTest, SignalsEndIt) {
  for (const int Number : {SIGHUP, SIGINT, SIGTERM})
    EXPECT_EXIT(
        {
          signal(Number, SIG_DFL);
          listen();
          bool Ended = false;
          Server->serve([&] { raise(Number); }, [&] { Ended = true; });
          _exit(Ended ? 0 : 1);
        },
        testing::ExitedWithCode(0), "");
}

TEST_F(HttpServerTest, APortIsForOneServer) {
  start();
  const auto Other = HttpServer::listen(Server->port(), {}, {}, {});
  ASSERT_FALSE(Other);
  EXPECT_EQ(Other.error().Code, ExitCode::Usage);
}

} // namespace
