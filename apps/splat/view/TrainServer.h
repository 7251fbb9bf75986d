/// The server of `splat train --view`: the page of a run in progress.
#pragma once

#include "train/run/Training.h"
#include "view/PageServer.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace vorion::splat {

/// The device belongs to the thread that trains. It renders what pages request
/// between two iterations.
class TrainServer {
public:
  /// Serves the run \p Name on \p Port of 127.0.0.1 in a new thread.
  /// Fails if the port is in use.
  static Expected<std::unique_ptr<TrainServer>>
  start(int Port, const std::string &Name, const TrainingSet &Pictures);
  /// Stops it.
  ~TrainServer();

  /// The URL of the page, including the token.
  std::string address() const { return Http->address(); }

  /// Publishes the state of the run, renders the requested pictures, and waits
  /// while the run is paused. Whether the run goes on.
  bool between(const TrainMoment &Now);

  /// Publishes the end. If a page is open, waits until it has fetched that, at
  /// most two seconds.
  void end(const TrainOutcome &Out);

private:
  /// A picture that a page waits for.
  struct Order {
    Camera View;
    bool IsDone = false;
    Photo Picture; ///< empty if the run has ended
    unsigned Iteration = 0;
  };

  explicit TrainServer(const std::string &Name, const TrainingSet &Pictures);
  HttpAnswer describe() const;
  HttpAnswer state(const HttpCall &C);
  HttpAnswer picture(const HttpCall &C);
  HttpAnswer control(const HttpCall &C);
  /// Requires the lock.
  void publish(const TrainOutcome &Out, const std::vector<float> &Losses);

  const std::string Name;
  std::vector<Camera> Cameras; ///< held-out views, then training views
  std::size_t HeldOut;         ///< number of held-out views
  std::unique_ptr<PageServer> Http;
  std::thread Serving;

  mutable std::mutex Lock;
  std::condition_variable Changed;
  /// \name Protected by Lock
  /// @{
  std::deque<std::shared_ptr<Order>> Orders;
  bool IsPaused = false, IsStopped = false, HasEnded = false,
       EndIsKnown = false;
  std::chrono::steady_clock::time_point LastAsked;
  std::vector<float> Losses;
  std::vector<std::pair<unsigned, uint32_t>> Counts;
  std::vector<std::pair<unsigned, double>> Scores, MachineMs;
  nlohmann::ordered_json Progress = nlohmann::ordered_json::object();
  /// @}
};

} // namespace vorion::splat
