#include "live_view.hpp"

#include <fmt/core.h>

#include "installation.hpp"
#include "text/error.hpp"
#include "text/json.hpp"
#include "text/number.hpp"
#include "verbs.hpp"
#include "viewer/page.hpp"
#include "viewer/payload.hpp"

namespace muster::cli {
namespace {

constexpr double patience = 0.2;                 // [s] between looks for an interrupt
constexpr std::uint64_t most_numbers = 200'000;  // in a record that is sent again and again
constexpr double slowest = 1e-3, fastest = 1e3;

viewer::HttpResponse plain(int status, const std::string& words) {
  return {status, "text/plain; charset=utf-8", words + '\n'};
}

}  // namespace

LiveView::LiveView(const ViewSettings& settings, Record record, uint64_t ticks, double speed)
    : settings_(settings),
      record_(std::move(record)),
      clock_(interrupted),
      server_(settings.address, static_cast<uint16_t>(settings.port), [this](const auto& r) { return answer(r); }),
      ticks_(ticks),
      speed_(speed) {
  if (const std::string why = viewer::why_no_page(installation().parts); !why.empty()) throw Error(Exit::io, why);
  if (settings.address.rfind("127.", 0) != 0 && settings.token.empty())
    throw Error(Exit::invalid_input, "--address: " + settings.address +
                                         " can be reached from other computers; expected --token WORD beside it");
}

void LiveView::sleep_until(double moment) {
  for (double left = moment - now(); left > 0 && !interrupted() && !is_changed_; left = moment - now())
    server_.serve(std::min(left, patience));
}

void LiveView::wait_for_reader() {
  const std::string token = settings_.token.empty() ? "" : "?token=" + settings_.token;
  fmt::print(stderr, "muster: open http://{}:{}/{}  The run begins when the page is there.\n", settings_.address,
             server_.port(), token);
  while (!is_opened_ && !interrupted()) server_.serve(patience);
}

bool LiveView::is_due(Pacing& pacing, double time) {
  server_.serve(0);
  const bool was_paused = is_paused_;
  while (is_paused_ && steps_ == 0 && !interrupted()) server_.serve(patience);
  if (steps_ > 0) --steps_;
  if (was_paused || is_changed_) pacing.restart(speed_, time);
  is_changed_ = false;
  return !interrupted();
}

void LiveView::finish(uint64_t tick) {
  tick_ = tick;
  is_over_ = true;
  while (!has_all_ && !interrupted()) server_.serve(patience);
  server_.serve(patience);  // the last answer goes out
}

std::string LiveView::state() const {
  return Json{{"tick", tick_}, {"ticks", ticks_}, {"paused", is_paused_}, {"speed", speed_}, {"over", is_over_}}.dump();
}

// A page of another origin may send requests here, but no header of its own, and not this host's name.
bool LiveView::is_allowed(const viewer::HttpRequest& request) const {
  if (!settings_.token.empty()) {
    const auto given = request.query.find("token");
    return given != request.query.end() && given->second == settings_.token;
  }
  const std::string port = ':' + std::to_string(server_.port());
  const auto host = request.headers.find("host");
  return host != request.headers.end() &&
         (host->second == settings_.address + port || host->second == "localhost" + port);
}

viewer::HttpResponse LiveView::control(const viewer::HttpRequest& request) {
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
    is_changed_ = true;
  }
  return {200, "application/json", state()};
}

viewer::HttpResponse LiveView::answer(const viewer::HttpRequest& request) {
  if (!is_allowed(request))
    return plain(403, "this run is shown to its own page alone; expected the address that muster printed");
  if (request.path == "/control") return control(request);
  if (request.method != "GET") return plain(405, "expected GET");
  if (request.path == "/state") return {200, "application/json", state()};
  if (request.path == "/record") {
    has_all_ = is_over_;
    return {200, "text/plain", viewer::base64(viewer::gzipped(viewer::payload_of(record_(), most_numbers).container))};
  }
  if (request.path != "/") return plain(404, "there is no such page");
  is_opened_ = true;
  return {200, "text/html; charset=utf-8", viewer::live_page(record_(), installation().parts, most_numbers)};
}

}  // namespace muster::cli
