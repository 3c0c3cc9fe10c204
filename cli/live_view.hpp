// A run to be watched as it goes: the page of a record, served while the run is under way, with its pause, step and
// speed.
#pragma once

#include <functional>
#include <string>

#include "pacing.hpp"
#include "viewer/http_server.hpp"
#include "viewer/record_folder.hpp"

namespace muster::cli {

struct ViewSettings {
  std::string address = "127.0.0.1", token;
  int port = 0;
};

// It is the clock of the run's pace: while the run waits, the page is answered.
class LiveView : public WallClock {
 public:
  using Record = std::function<viewer::RecordFolder()>;  // up to now
  LiveView(const ViewSettings& settings, Record record, uint64_t ticks, double speed);

  // Returns when somebody has opened the page, or the run is interrupted.
  void wait_for_reader();
  // Call before each tick; returns when it is due to run: it waits while the page has paused the run. False: the run
  // was interrupted in a pause.
  bool is_due(Pacing& pacing, double time);
  void after_tick(uint64_t tick) { tick_ = tick; }
  // Serves until the page has the whole record.
  void finish(uint64_t tick);

  double now() override { return clock_.now(); }
  void sleep_until(double moment) override;

 private:
  viewer::HttpResponse answer(const viewer::HttpRequest& request);
  viewer::HttpResponse control(const viewer::HttpRequest& request);
  bool is_allowed(const viewer::HttpRequest& request) const;
  std::string state() const;

  ViewSettings settings_;
  Record record_;
  SteadyClock clock_;
  viewer::HttpServer server_;
  uint64_t ticks_, tick_ = 0, steps_ = 0;
  double speed_;
  bool is_paused_ = false, is_changed_ = false, is_over_ = false, is_opened_ = false, has_all_ = false;
};

}  // namespace muster::cli
