#include "live_view.hpp"

#include <fmt/core.h>

#include <algorithm>

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

live::Foxglove::Run shown(Simulation& run) {
  const auto parameters = [&run] {
    std::vector<live::Foxglove::Parameter> result;
    for (const auto& one : run.parameters()) result.push_back({one.path, one.value});
    return result;
  };
  const auto set_parameter = [&run](const std::string& path, double value) {
    run.set_parameter(path, value);
    run.note("parameter " + quote(path) + " set to " + print_real(value));
  };
  return {"muster: " + run.world().name,
          {{"world", run.world().name},
           {"seed", std::to_string(run.world().seed)},
           {"dt", print_real(run.world().dt)},
           {"version", MUSTER_VERSION}},
          parameters,
          set_parameter};
}

}  // namespace

LiveView::LiveView(const ViewSettings& settings, Simulation& run, const std::vector<RecordDeclaration>& records,
                   Record record, double speed)
    : settings_(settings),
      run_(run),
      records_(records),
      record_(std::move(record)),
      clock_(interrupted),
      foxglove_(shown(run)),
      messages_(run, records_, foxglove_),
      server_(
          settings.address, static_cast<uint16_t>(settings.port),
          {[this](const auto& request) { return refusal(request); },
           [this](const auto& request, const auto& reply) { reply(answer(request)); }, live::Foxglove::subprotocols()},
          foxglove_),
      speed_(speed),
      is_paused_(settings.is_paused) {
  if (settings.address.rfind("127.", 0) != 0 && settings.token.empty())
    throw Error(Exit::invalid_input, "--address: " + settings.address +
                                         " can be reached from other computers; expected --token WORD beside it");
  write();
}

void LiveView::write() {
  foxglove_.begin(run_log::log_time(run_.time()));
  messages_.write(run_);
}

void LiveView::sleep_until(double moment) {
  for (double left = moment - now(); left > 0 && !interrupted() && !is_changed_; left = moment - now())
    server_.serve(std::min(left, patience));
}

void LiveView::wait_for_reader() {
  const std::string at = fmt::format("{}:{}/{}", settings_.address, server_.port(),
                                     settings_.token.empty() ? "" : "?token=" + settings_.token);
  if (const std::string why = viewer::why_no_page(installation().parts); why.empty())
    fmt::print(stderr, "muster: open http://{} in a browser, or", at);
  else
    fmt::print(stderr, "muster: note: there is no page for browsers: {}\nmuster: open", why);
  fmt::print(stderr, " ws://{} in Foxglove. {}\n", at,
             is_paused_ ? "The run is paused." : "The run begins when somebody watches.");
  while (!is_paused_ && !is_opened_ && !foxglove_.is_watched() && !interrupted()) server_.serve(patience);
}

bool LiveView::is_due(Pacing& pacing) {
  server_.serve(0);
  const bool was_paused = is_paused_;
  while (is_paused_ && steps_ == 0 && !interrupted()) server_.serve(patience);
  if (steps_ > 0) --steps_;
  if (was_paused || is_changed_) pacing.restart(speed_, run_.time());
  is_changed_ = false;
  return !interrupted();
}

void LiveView::after_tick() { write(); }

void LiveView::finish() {
  is_over_ = true;
  while (is_opened_ && !has_all_ && !interrupted()) server_.serve(patience);
  server_.close(parting);
  if (is_opened_) server_.serve(patience);  // the last answer goes out
}

void LiveView::changed() {
  is_changed_ = true;
  server_.wake();
}

std::string LiveView::state() const {
  return Json{{"tick", run_.tick()},
              {"ticks", run_.world().ticks},
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
    changed();
  }
  return {200, "application/json", state()};
}

live::HttpResponse LiveView::answer(const live::HttpRequest& request) {
  if (request.path == "/control") return control(request);
  if (request.method != "GET") return plain(405, "expected GET");
  if (request.path == "/state") return {200, "application/json", state()};
  if (request.path == "/record") {
    has_all_ = is_over_;
    return {200, "text/plain", viewer::base64(viewer::gzipped(viewer::payload_of(record_(), most_numbers).container))};
  }
  if (request.path != "/") return plain(404, "there is no such page");
  if (const std::string why = viewer::why_no_page(installation().parts); !why.empty()) return plain(404, why);
  is_opened_ = true;
  server_.wake();
  return {200, "text/html; charset=utf-8", viewer::live_page(record_(), installation().parts, most_numbers)};
}

}  // namespace muster::cli
