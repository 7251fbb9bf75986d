#include "view/TrainServer.h"

#include "cameras/Motion.h"
#include "view/Request.h"
#include "vorion/support/Json.h"

#include <fmt/format.h>

namespace vorion::splat {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;
namespace http = boost::beast::http;

namespace {

/// The largest request, bytes.
constexpr uint64_t MostRequest = 4096;
/// How often a waiting thread looks at what it is not notified of.
constexpr std::chrono::milliseconds Look{20};

/// The request's body, an object.
Expected<Json> bodyOf(const HttpCall &C) {
  const JsonLimits Limits{
      .Depth = 4, .Bytes = MostRequest, .Values = 64, .Keys = 16};
  auto Read =
      parseJson<Json>(C.Request.body(), "", "a request of the page", Limits);
  if (!Read)
    return Error{"", Read.error().What, ExitCode::Usage};
  if (!Read->is_object())
    return Error{"", "the request is invalid, expected an object",
                 ExitCode::Usage};
  return Read;
}

/// The whole number \p Key of \p Of, below \p End.
Expected<std::size_t> numberOf(const Json &Of, const char *Key,
                               std::size_t End) {
  const auto At = Of.find(Key);
  if (At == Of.end() || !At->is_number_unsigned() || *At >= End)
    return Error{"",
                 fmt::format("the request's key {} is missing or invalid, "
                             "expected a number below {}",
                             Key, End),
                 ExitCode::Usage};
  return At->get<std::size_t>();
}

HttpAnswer ended() {
  constexpr unsigned Gone = 410;
  HttpAnswer A = refusalOf({"", "the run has ended", ExitCode::LimitReached});
  A.Status = Gone;
  return A;
}

} // namespace

TrainServer::TrainServer(const std::string &Name, const TrainingSet &Pictures)
    : Name(Name), HeldOut(Pictures.HeldOut.size()) {
  for (const auto *Views : {&Pictures.HeldOut, &Pictures.Training})
    for (const TrainView &V : *Views)
      Cameras.push_back(V.Pose);
}

Expected<std::unique_ptr<TrainServer>>
TrainServer::start(int Port, const std::string &Name,
                   const TrainingSet &Pictures) {
  std::unique_ptr<TrainServer> S(new TrainServer(Name, Pictures));
  const auto Calling = [Own = S.get()](auto Do) {
    return [Own, Do](const HttpCall &C) { return (Own->*Do)(C); };
  };
  constexpr auto Get = http::verb::get, Post = http::verb::post;
  auto Http = PageServer::listen(
      Port, "/train.html",
      {{Get, "/training", 0,
        [Own = S.get()](const HttpCall &) { return Own->describe(); }},
       {Post, "/state", MostRequest, Calling(&TrainServer::state)},
       {Post, "/picture", MostRequest, Calling(&TrainServer::picture)},
       {Post, "/control", MostRequest, Calling(&TrainServer::control)}},
      HttpLimits().Requests * MostRequest);
  if (!Http)
    return Http.error();
  S->Http = std::move(*Http);
  S->Serving = std::thread([Own = S.get()] { Own->Http->serveUntilStopped(); });
  return S;
}

TrainServer::~TrainServer() {
  if (!Serving.joinable())
    return;
  {
    const std::lock_guard Held(Lock);
    HasEnded = true;
  }
  Changed.notify_all();
  Http->stop();
  Serving.join();
}

HttpAnswer TrainServer::describe() const {
  Json Views = Json::array();
  for (std::size_t I = 0; I != Cameras.size(); ++I) {
    Views.push_back(cameraJson(Cameras[I]));
    Views.back()["held_out"] = I < HeldOut;
  }
  const auto Centre = lookedAt(Cameras);
  return jsonAnswer(
      jsonText(Json{{"name", Name},
                    {"cameras", Views},
                    {"up", upOf(Cameras).value_or(Vector{0, -1, 0})},
                    {"looked_at", Centre ? Json(*Centre) : Json()}}));
}

HttpAnswer TrainServer::state(const HttpCall &C) {
  const auto Asked = bodyOf(C);
  if (!Asked)
    return refusalOf(Asked.error());
  const auto Since = numberOf(*Asked, "since", 1U << 31);
  if (!Since)
    return refusalOf(Since.error());
  const std::lock_guard Held(Lock);
  LastAsked = Clock::now();
  Json State = Progress;
  const std::size_t First = std::min(*Since, Losses.size());
  State.update(
      {{"paused", IsPaused},
       {"stopped", IsStopped},
       {"ended", HasEnded},
       {"since", First},
       {"losses",
        std::vector<float>(Losses.begin() + static_cast<std::ptrdiff_t>(First),
                           Losses.end())},
       {"gaussian_counts", Counts},
       {"scores", Scores},
       {"machine_ms", MachineMs}});
  EndIsKnown = HasEnded;
  return jsonAnswer(jsonText(State));
}

HttpAnswer TrainServer::picture(const HttpCall &C) {
  const auto Asked = bodyOf(C);
  if (!Asked)
    return refusalOf(Asked.error());
  const auto View = numberOf(*Asked, "view", Cameras.size());
  if (!View)
    return refusalOf(View.error());
  // Programs were made for the run's own lenses and sizes.
  auto Moved = movedCamera(Cameras[*View], nlohmann::json(*Asked));
  if (!Moved)
    return refusalOf(Moved.error());
  const auto Own = std::make_shared<Order>();
  Own->View = std::move(*Moved);
  std::unique_lock Held(Lock);
  Orders.push_back(Own);
  Changed.notify_all();
  while (!Own->IsDone && !HasEnded && !C.HasLeft())
    Changed.wait_for(Held, Look);
  if (!Own->IsDone) {
    std::erase(Orders, Own);
    return ended();
  }
  Held.unlock();
  const Photo &P = Own->Picture;
  std::string Rgba;
  Rgba.reserve(4 * P.pixels());
  for (std::size_t At = 0; At < P.Rgb.size(); ++At) {
    Rgba += static_cast<char>(P.Rgb[At]);
    if (At % 3 == 2)
      Rgba += static_cast<char>(0xff);
  }
  return packedAnswer(jsonText(Json{{"width", P.Width},
                                    {"height", P.Height},
                                    {"iteration", Own->Iteration}}),
                      Rgba);
}

HttpAnswer TrainServer::control(const HttpCall &C) {
  const auto Asked = bodyOf(C);
  if (!Asked)
    return refusalOf(Asked.error());
  const Json Do = Asked->value("do", Json());
  if (Do != "pause" && Do != "continue" && Do != "stop")
    return refusalOf({"",
                      "the request's key do is missing or invalid, expected "
                      "pause, continue or stop",
                      ExitCode::Usage});
  {
    const std::lock_guard Held(Lock);
    IsPaused = Do == "pause";
    IsStopped = IsStopped || Do == "stop";
  }
  Changed.notify_all();
  return jsonAnswer("{}");
}

void TrainServer::publish(const TrainOutcome &Out,
                          const std::vector<float> &Known) {
  Losses = Known;
  Counts = Out.Counts;
  Scores = Out.Scores;
  MachineMs = Out.Timed.milliseconds();
}

bool TrainServer::between(const TrainMoment &Now) {
  std::unique_lock Held(Lock);
  publish(Now.SoFar, Now.Losses);
  const TrainProgress &P = Now.Progress;
  Progress = {{"iteration", P.Step.Iteration},
              {"first", P.First},
              {"last", P.Last},
              {"gaussians", P.Step.Gaussians},
              {"seconds", P.Seconds}};
  for (;;) {
    while (!Orders.empty()) {
      const auto Next = Orders.front();
      Orders.pop_front();
      Held.unlock();
      Photo Drawn = Now.Render(Next->View);
      Held.lock();
      Next->Picture = std::move(Drawn);
      Next->Iteration = P.Step.Iteration;
      Next->IsDone = true;
      Changed.notify_all();
    }
    if (IsStopped || Now.IsInterrupted())
      return !IsStopped;
    if (!IsPaused)
      return true;
    Changed.wait_for(Held, Look);
  }
}

void TrainServer::end(const TrainOutcome &Out) {
  std::unique_lock Held(Lock);
  publish(Out, Out.Losses);
  if (!Out.HeldOut.empty())
    Progress["psnr8_db"] = Out.meanDb();
  HasEnded = true;
  Changed.notify_all();
  const auto Now = Clock::now();
  if (Now - LastAsked > std::chrono::seconds(2))
    return;
  while (!EndIsKnown && Clock::now() < Now + std::chrono::seconds(2))
    Changed.wait_for(Held, Look);
  // Its answer is on its way.
  Changed.wait_for(Held, 5 * Look);
}

} // namespace vorion::splat
