#include "observe/gdb/GdbServer.h"

#include "observe/Tool.h"
#include "observe/gdb/Session.h"

#include <charconv>
#include <fmt/format.h>

namespace vorion::isasim {

std::unique_ptr<Observer> serveGdb(int Socket) {
  return std::make_unique<gdb::Session>(Socket);
}

Expected<std::unique_ptr<Observer>>
startGdbServer(unsigned Port,
               const std::function<void(std::string_view)> &Say) {
  auto Server = std::make_unique<gdb::Session>();
  const Expected<unsigned> Got = Server->listen(Port);
  if (!Got)
    return Got.error();
  Say(fmt::format("gdb: waiting on port {0}; connect with: gdb-multiarch "
                  "PROGRAM -ex 'target remote 127.0.0.1:{0}'",
                  *Got));
  return std::unique_ptr<Observer>(std::move(Server));
}

namespace {

class GdbTool : public Tool {
public:
  explicit GdbTool(std::unique_ptr<Observer> ServerIn)
      : Server(std::move(ServerIn)) {}
  std::vector<Observer *> observers() override { return {Server.get()}; }
  bool changesRuns() const override { return true; }

private:
  std::unique_ptr<Observer> Server;
};

Expected<std::unique_ptr<Tool>> make(const std::string &Text,
                                     const ToolOutput &To) {
  unsigned Port = 0;
  const char *End = Text.data() + Text.size();
  const auto Read = std::from_chars(Text.data(), End, Port);
  if (Read.ec != std::errc() || Read.ptr != End || Port > 65535)
    return Error{"", fmt::format("gdb port '{}', expected 0 to 65535", Text),
                 ExitCode::Usage};
  auto Server = startGdbServer(Port, To.Report);
  if (!Server)
    return Server.error();
  return std::unique_ptr<Tool>(std::make_unique<GdbTool>(std::move(*Server)));
}

} // namespace

const ToolKind tools::Gdb{.Make = make};

} // namespace vorion::isasim
