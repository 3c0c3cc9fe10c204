#include "live_view.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "installation.hpp"
#include "run_log/table_log.hpp"
#include "text/error.hpp"
#include "text/json.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "verbs.hpp"
#include "viewer/page.hpp"
#include "viewer/payload.hpp"

namespace muster::cli {
namespace {

constexpr double patience = 0.2;                 // [s] between looks for an interrupt
constexpr double parting = 2;                    // [s] without a byte read, after which a client is left behind
constexpr std::uint64_t most_numbers = 200'000;  // in a record that is sent again and again
constexpr double slowest = 1e-3, fastest = 1e3;

live::HttpResponse plain(int status, const std::string& words) {
  return {status, "text/plain; charset=utf-8", words + '\n'};
}

}  // namespace

// Browsers say an origin as scheme, host and port, without a path.
void check(const ViewSettings& settings) {
  for (const std::string& origin : settings.origins) {
    const auto scheme = origin.find("://"), host = scheme == origin.npos ? 0 : scheme + 3,
               path = origin.find('/', host);
    if (scheme != origin.npos && path == origin.npos && host < origin.size()) continue;
    throw Error(Exit::invalid_input, "--origin: " + quote(origin) + " is no origin of a page; expected " +
                                         (scheme == origin.npos ? "https://" : "") + origin.substr(0, path));
  }
}

LiveView::LiveView(const ViewSettings& settings, const std::vector<RecordDeclaration>& records, double speed)
    : settings_(settings),
      records_(records),
      clock_(interrupted),
      interfaces_(*this),
      foxglove_(shown()),
      server_(
          settings.address, static_cast<uint16_t>(settings.port),
          {[this](const auto& request) { return refusal(request); },
           [this](const auto& request, const auto& reply) { handle(request, reply); }, live::Foxglove::subprotocols()},
          foxglove_),
      speed_(speed),
      is_paused_(settings.is_paused),
      is_begun_(settings.is_paused) {
  if (settings.address.rfind("127.", 0) != 0 && settings.token.empty())
    throw Error(Exit::invalid_input, "--address: " + settings.address +
                                         " can be reached from other computers; expected --token WORD beside it");
}

// Once the world is known to be sound.
void LiveView::announce() const {
  const std::string at = fmt::format("{}:{}/{}", settings_.address, server_.port(),
                                     settings_.token.empty() ? "" : "?token=" + settings_.token);
  if (const std::string why = viewer::why_no_page(installation().parts); why.empty())
    fmt::print(stderr, "muster: open http://{} in a browser, or", at);
  else
    fmt::print(stderr, "muster: note: there is no page for browsers: {}\nmuster: open", why);
  fmt::print(stderr, " ws://{} in Foxglove. {}\n", at,
             is_paused_ ? "The run is paused." : "The run begins when somebody watches.");
}

live::Foxglove::Run LiveView::shown() {
  const auto parameters = [this] {
    std::vector<live::Foxglove::Parameter> result;
    for (const auto& one : run_->parameters()) result.push_back({one.path, one.value});
    return result;
  };
  const auto set_parameter = [this](const std::string& path, double value) {
    run_->set_parameter(path, value);
    run_->note("parameter " + quote(path) + " is set to " + print_real(value));
  };
  const auto metadata = [this] {
    return std::map<std::string, std::string>{{"world", run_->world().name},
                                              {"seed", std::to_string(run_->world().seed)},
                                              {"dt", print_real(run_->world().dt)},
                                              {"version", MUSTER_VERSION}};
  };
  return {"muster", metadata, parameters, set_parameter, &interfaces_};
}

void LiveView::watch(Simulation& run, Record record) {
  if (!run_) announce();
  run_ = &run;
  record_ = std::move(record);
  steps_ = 0;
  end_step("the run was reset meanwhile");
  wants_anew_ = is_over_ = has_all_ = false;
  interfaces_.forget_spawned();
  foxglove_.restart();
  messages_.emplace(run, records_, foxglove_);
  write();
  foxglove_.settle();
  if (anew_done_) std::exchange(anew_done_, {})("");
}

void LiveView::write() {
  foxglove_.begin(run_log::log_time(run_->time()));
  messages_->write(*run_);
}

// Steps of a run that is paused are not paced.
void LiveView::sleep_until(double moment) {
  for (double left = moment - now(); left > 0 && goes_on() && !is_changed_ && !is_paused_; left = moment - now())
    server_.serve(std::min(left, patience));
}

bool LiveView::goes_on() const { return !wants_anew_ && !wants_quit_ && !interrupted(); }

void LiveView::wait_for_reader() {
  while (!is_begun_ && goes_on()) {
    server_.serve(patience);
    if (foxglove_.is_watched() && !is_stopped_) is_begun_ = true;
  }
}

bool LiveView::is_due(Pacing& pacing) {
  server_.serve(0);
  const bool was_paused = is_paused_;
  while (is_paused_ && steps_ == 0 && goes_on()) server_.serve(patience);
  if (steps_ > 0) --steps_;
  if (was_paused || is_changed_) pacing.restart(speed_, run_->time());
  is_changed_ = false;
  return goes_on();
}

void LiveView::after_tick() {
  write();
  if (steps_ == 0) end_step("");
}

void LiveView::end_step(const std::string& fault) {
  if (step_done_) std::exchange(step_done_, {})(fault);
}

void LiveView::finish() {
  is_over_ = true;
  steps_ = 0;
  end_step(wants_anew_ ? "the run was reset meanwhile" : "the run has ended");
  if (is_driven_ && goes_on()) {
    fmt::print(stderr, "muster: note: the run is at its end and waits for ResetSimulation, or STATE_QUITTING\n");
    while (goes_on()) server_.serve(patience);
  }
  while (is_opened_ && !has_all_ && goes_on()) server_.serve(patience);
  if (wants_anew_) return;
  server_.close(parting);
  if (is_opened_ || is_driven_) server_.serve(patience);  // the last answer goes out
}

// ---- What clients want ----

live::RunState LiveView::state() const {
  if (wants_quit_) return live::RunState::quitting;
  if (!is_begun_) return live::RunState::stopped;
  return is_paused_ || is_over_ ? live::RunState::paused : live::RunState::playing;
}

void LiveView::set_state(live::RunState state, Done done) {
  is_driven_ = true;
  if (state == live::RunState::stopped) {
    is_begun_ = is_paused_ = false;
    is_stopped_ = wants_anew_ = true;
    if (anew_done_) std::exchange(anew_done_, {})("the run was stopped meanwhile");
    anew_done_ = std::move(done);
    return changed();
  }
  if (state == live::RunState::quitting) {
    wants_quit_ = true;
  } else {
    is_begun_ = true;
    is_paused_ = state == live::RunState::paused;
  }
  changed();
  done("");
}

void LiveView::step(std::uint64_t ticks, Done done) {
  if (step_done_) return done("other steps are under way");
  is_driven_ = true;
  if (ticks == 0) return done("");
  steps_ = ticks;
  step_done_ = std::move(done);
  changed();
}

void LiveView::reset(Done done) {
  if (anew_done_) return done("another reset is under way");
  is_driven_ = wants_anew_ = true;
  anew_done_ = std::move(done);
  changed();
}

void LiveView::changed() {
  is_changed_ = true;
  server_.wake();
}

std::string LiveView::state_text() const {
  return Json{{"tick", run_->tick()},
              {"ticks", run_->world().ticks},
              {"paused", is_paused_},
              {"speed", speed_},
              {"over", is_over_}}
      .dump();
}

bool LiveView::is_own(const live::HttpRequest& request, const std::string& header, const std::string& before) const {
  const std::string port = ':' + std::to_string(server_.port());
  const auto found = request.headers.find(header);
  return found != request.headers.end() &&
         (found->second == before + settings_.address + port || found->second == before + "localhost" + port);
}

// A page of another origin may send requests here, and open a websocket, but not with this host's name, and not without
// saying whose page it is. A program says no origin. Who knows the token was given it.
bool LiveView::is_allowed(const live::HttpRequest& request) {
  if (!settings_.token.empty()) {
    const auto given = request.query.find("token");
    return given != request.query.end() && given->second == settings_.token;
  }
  if (!is_own(request, "host", "")) return false;
  const auto origin = request.headers.find("origin");
  if (origin == request.headers.end() || is_own(request, "origin", "http://")) return true;
  if (std::find(settings_.origins.begin(), settings_.origins.end(), origin->second) != settings_.origins.end())
    return true;
  note_origin(origin->second);
  return false;
}

void LiveView::note_origin(const std::string& origin) {
  if (std::find(refused_.begin(), refused_.end(), origin) != refused_.end() || refused_.size() >= 8) return;
  refused_.push_back(origin);
  fmt::print(stderr,
             "muster: note: a page of {} was refused; --origin with this word allows it, or --token WORD and its "
             "address with ?token=WORD\n",
             quote(origin));
}

std::optional<live::HttpResponse> LiveView::refusal(const live::HttpRequest& request) {
  if (is_allowed(request)) return {};
  return plain(403, "this run is shown to its own page alone; expected the address that muster printed");
}

live::HttpResponse LiveView::control(const live::HttpRequest& request) {
  if (request.method != "POST" || !request.headers.count("x-muster"))
    return plain(405, "expected POST with a header X-Muster");
  for (const auto& [name, value] : request.query) {
    if (name == "paused" && (value == "true" || value == "false")) {
      is_paused_ = value == "true";
    } else if (name == "step" && value == "1") {
      is_paused_ = true;
      ++steps_;
    } else if (name == "speed") {
      const auto speed = parse_real(value);
      if (!speed || !(*speed >= slowest && *speed <= fastest)) return plain(400, "speed: expected 0.001 to 1000");
      speed_ = *speed;
    } else if (name != "token") {
      return plain(400, name + ": expected paused=true or false, step=1, or speed=NUMBER");
    }
    if (name == "paused" || name == "step") is_begun_ = true;
    changed();
  }
  return {200, "application/json", state_text()};
}

void LiveView::handle(const live::HttpRequest& request, const live::Reply& reply) {
  static const std::string services = "/simulation_interfaces/";
  if (!request.path.starts_with(services)) return reply(answer(request));
  if (request.method != "POST") return reply(plain(405, "expected POST, with the request as JSON"));
  interfaces_.call(request.path.substr(services.size()), request.body, [reply](const live::ServiceAnswer& given) {
    if (given.fault.empty()) return reply({200, "application/json", given.payload + '\n'});
    reply({400, "application/json", Json{{"error", given.fault}}.dump() + '\n'});
  });
}

live::HttpResponse LiveView::answer(const live::HttpRequest& request) {
  if (request.path == "/control") return control(request);
  if (request.method != "GET") return plain(405, "expected GET");
  if (request.path == "/state") return {200, "application/json", state_text()};
  if (request.path == "/record") {
    has_all_ = is_over_;
    return {200, "text/plain", viewer::base64(viewer::gzipped(viewer::payload_of(record_(), most_numbers).container))};
  }
  if (request.path != "/") return plain(404, "there is no such page");
  if (const std::string why = viewer::why_no_page(installation().parts); !why.empty()) return plain(404, why);
  is_opened_ = true;
  is_begun_ |= !is_stopped_;
  server_.wake();
  return {200, "text/html; charset=utf-8", viewer::live_page(record_(), installation().parts, most_numbers)};
}

}  // namespace muster::cli
