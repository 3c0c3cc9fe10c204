// A run to be watched and driven as it goes: the page of a record with its pause, step and speed, and clients of
// Foxglove's protocol, served while the run is under way.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "live/foxglove.hpp"
#include "live/server.hpp"
#include "live/simulation_interfaces.hpp"
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
// Throws Error where a word cannot be the origin of a page.
void check(const ViewSettings& settings);

// It is the clock of the run's pace: while the run waits, requests are answered.
class LiveView : public WallClock, private live::RunControl {
 public:
  using Record = std::function<viewer::RecordFolder()>;  // up to now
  LiveView(const ViewSettings& settings, const std::vector<RecordDeclaration>& records, double speed);

  // Call before the first tick, and again where the run was made anew: wants_anew(). It is watched from now on.
  void watch(Simulation& run, Record record);
  // Returns when somebody watches, or the run is interrupted; at once where it begins paused.
  void wait_for_reader();
  // Call before each tick; returns when it is due to run: it waits while the run is paused. False: the run is to end
  // here, for it was interrupted, or somebody wants to quit, or wants it anew.
  bool is_due(Pacing& pacing);
  void after_tick();
  // Serves until everybody has the whole record; a run that a client drives, until it wants to quit or the run anew.
  void finish();
  bool wants_anew() const { return wants_anew_; }

  double now() override { return clock_.now(); }
  void sleep_until(double moment) override;

 private:
  Simulation& run() override { return *run_; }
  live::RunState state() const override;
  void set_state(live::RunState state, Done done) override;
  void step(std::uint64_t ticks, Done done) override;
  void reset(Done done) override;

  live::Foxglove::Run shown();
  void announce() const;
  void handle(const live::HttpRequest& request, const live::Reply& reply);
  void end_step(const std::string& fault);
  bool goes_on() const;
  std::optional<live::HttpResponse> refusal(const live::HttpRequest& request);
  live::HttpResponse answer(const live::HttpRequest& request);
  live::HttpResponse control(const live::HttpRequest& request);
  bool is_allowed(const live::HttpRequest& request);
  bool is_own(const live::HttpRequest& request, const std::string& header, const std::string& before) const;
  void note_origin(const std::string& origin);
  void write();
  void changed();
  std::string state_text() const;

  ViewSettings settings_;
  Simulation* run_ = nullptr;
  std::vector<RecordDeclaration> records_;
  Record record_;
  SteadyClock clock_;
  live::SimulationInterfaces interfaces_;
  live::Foxglove foxglove_;
  std::optional<run_log::RunMessages> messages_;
  live::Server server_;
  std::vector<std::string> refused_;  // origins that a note was printed for
  uint64_t steps_ = 0;
  Done step_done_, anew_done_;  // answers that are owed
  double speed_;
  bool is_paused_, is_changed_ = false, is_over_ = false, is_opened_ = false, has_all_ = false;
  bool is_begun_, is_stopped_ = false;  // by a client
  bool is_driven_ = false, wants_anew_ = false, wants_quit_ = false;
};

}  // namespace muster::cli
