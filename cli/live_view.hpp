// A run to be watched and driven as it goes: the page of a record with its pause, step and speed, and clients of
// Foxglove's protocol, served while the run is under way.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "live/foxglove.hpp"
#include "live/server.hpp"
#include "pacing.hpp"
#include "run_log/run_messages.hpp"
#include "viewer/record_folder.hpp"

namespace muster::cli {

struct ViewSettings {
  std::string address = "127.0.0.1", token;
  std::vector<std::string> origins;  // of pages of others that may connect
  int port = 0;
  bool is_paused = false;  // at the start
};

// It is the clock of the run's pace: while the run waits, requests are answered.
class LiveView : public WallClock {
 public:
  using Record = std::function<viewer::RecordFolder()>;  // up to now
  LiveView(const ViewSettings& settings, Simulation& run, const std::vector<RecordDeclaration>& records, Record record,
           double speed);

  // Returns when somebody watches, or the run is interrupted; at once where it begins paused.
  void wait_for_reader();
  // Call before each tick; returns when it is due to run: it waits while the run is paused. False: the run was
  // interrupted in a pause.
  bool is_due(Pacing& pacing);
  void after_tick();
  // Serves until everybody has the whole record.
  void finish();

  double now() override { return clock_.now(); }
  void sleep_until(double moment) override;

 private:
  std::optional<live::HttpResponse> refusal(const live::HttpRequest& request);
  live::HttpResponse answer(const live::HttpRequest& request);
  live::HttpResponse control(const live::HttpRequest& request);
  bool is_allowed(const live::HttpRequest& request);
  bool is_own(const live::HttpRequest& request, const std::string& header, const std::string& before) const;
  void note_origin(const std::string& origin);
  void write();
  void changed();
  std::string state() const;

  ViewSettings settings_;
  Simulation& run_;
  std::vector<RecordDeclaration> records_;
  Record record_;
  SteadyClock clock_;
  live::Foxglove foxglove_;
  run_log::RunMessages messages_;
  live::Server server_;
  std::vector<std::string> refused_;  // origins that a note was printed for
  uint64_t steps_ = 0;
  double speed_;
  bool is_paused_, is_changed_ = false, is_over_ = false, is_opened_ = false, has_all_ = false;
};

}  // namespace muster::cli
