#include "cli/run_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <muster/tables.hpp>
#include <sstream>

#include "cli/pose_angles.hpp"
#include "diagnosis/radio/links/floor_plan.hpp"
#include "diagnosis/radio/links/run_tables.hpp"
#include "plotting/scale.hpp"
#include "text/error.hpp"
#include "text/number.hpp"

namespace muster {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream words(text);
  std::vector<std::string> result;
  for (std::string word; words >> word;) result.push_back(word);
  return result;
}

std::string attribute(const Instance& instance, const std::string& name) {
  for (const auto& given : instance.declared().attributes) {
    if (given.name == name) return given.value;
  }
  return "";
}

// The first column from `from` on whose name begins so; one for each link is there.
std::size_t next_column(const Columns& columns, const std::string& prefix, std::size_t from) {
  while (columns[from].name.compare(0, prefix.size(), prefix) != 0) ++from;
  return from;
}

// The colour as a background to itself.
plotting::Colour pale(plotting::Colour c) {
  const auto lighter = [](uint8_t v) { return static_cast<uint8_t>(v + (255 - v) * 7 / 10); };
  return {lighter(c.r), lighter(c.g), lighter(c.b)};
}

// To a tenth of a second, without a zero at the end.
std::string time_text(double time) { return print_real(std::round(time * 10) / 10) + " s"; }

}  // namespace

RunPictures::RunPictures(const Simulation& run) : world_(run.world().name), plan_(plan_of(run)) {
  constexpr std::size_t most_numbers = 4'000'000;  // some 100 MB of moments
  most_ = std::clamp(most_numbers / (names_of(run, "robot").size() + names_of(run, "radio").size() + 1),
                     std::size_t{64}, std::size_t{2048});
  find_links(run);
}

void RunPictures::find_links(const Simulation& run) {
  const auto radios = names_of(run, "radio");
  for (const auto& instance : run.instances()) {
    if (instance->declared().plugin != "observe.chain") continue;
    const auto names = words_of(attribute(*instance, "chain"));
    const std::string table = "instance/" + instance->name() + "/chain";
    const Columns& columns = run.table(table).table->columns();
    const int threshold = instance->find_param("threshold");
    std::size_t rssi = 0, smooth = 0;
    for (std::size_t i = 1; i < names.size(); ++i) {
      rssi = next_column(columns, "rssi_", rssi);
      smooth = next_column(columns, "smooth_", smooth);
      const auto row = [&](const std::string& name) {
        return static_cast<std::size_t>(std::find(radios.begin(), radios.end(), name) - radios.begin());
      };
      links_.push_back({row(names[i - 1]), row(names[i]), names[i], table, rssi++, smooth++,
                        threshold < 0 ? nothing : instance->params()[static_cast<std::size_t>(threshold)]});
    }
  }
}

void RunPictures::look(const Simulation& run) {
  if (seen_++ % every_ == 0) moments_.push_back(moment(run));
  if (moments_.size() < most_) return;
  std::size_t kept = 1;
  for (std::size_t i = 2; i < moments_.size(); i += 2) moments_[kept++] = std::move(moments_[i]);
  moments_.resize(kept);
  every_ *= 2;
}

RunPictures::Moment RunPictures::moment(const Simulation& run) const {
  Moment result;
  result.time = run.time();
  const auto names = names_of(run, "robot");
  const auto poses = rows_of<Pose>(run, "robot/*/pose");
  const Set* set = run.board().find_set("robot");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool here = set->alive[i];
    result.robots.push_back({{here ? poses[i].x : nothing, here ? poses[i].y : nothing},
                             yaw_of(poses[i]),
                             names[i],
                             plotting::series_colour(i)});
  }
  result.radios.resize(names_of(run, "radio").size(), {nothing, nothing});
  const auto ends = rows_of<Endpoint>(run, "endpoint/*/radio");
  const auto places = rows_of<Pose>(run, "endpoint/*/pose");
  for (std::size_t i = 0; i < ends.size(); ++i)
    result.radios.at(static_cast<std::size_t>(ends[i].radio)) = {places[i].x, places[i].y};
  for (const Link& link : links_) {
    const auto chain = run.find_table(link.table);  // none where its plugin is gone
    result.rssi.push_back(chain ? chain->at(0, link.rssi) : nothing);
    result.smooth.push_back(chain ? chain->at(0, link.smooth) : nothing);
  }
  if (moments_.empty()) return result;
  for (std::size_t i = 0; i < std::min(result.robots.size(), moments_.front().robots.size()); ++i) {
    const plotting::Point a = result.robots[i].at, b = moments_.front().robots[i].at;
    if (const double away = std::hypot(a.x - b.x, a.y - b.y); away > 0) result.away += away;  // NaN is not
  }
  return result;
}

std::vector<const RunPictures::Moment*> RunPictures::snapshots() const {
  constexpr int frames = 4;
  double farthest = 0;
  for (const Moment& m : moments_) farthest = std::max(farthest, m.away);
  std::vector<const Moment*> result;
  for (int frame = 1; frame < frames; ++frame) {
    const double away = farthest * frame / frames;
    result.push_back(
        &*std::find_if(moments_.begin(), moments_.end(), [away](const Moment& m) { return m.away >= away; }));
  }
  result.push_back(&moments_.back());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

plotting::Panel RunPictures::plan_at(const Moment& moment) const {
  plotting::Links links;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    links.links.push_back({moment.radios.at(links_[i].near), moment.radios.at(links_[i].far), moment.smooth[i]});
    if (!std::isnan(links_[i].threshold)) links.threshold = links_[i].threshold - 1;  // within 1 dB it holds
  }
  plotting::Panel panel{.title = time_text(moment.time), .frame = plotting::Frame::scale_bar};
  panel.layers.push_back(plan_);
  for (std::size_t i = 0; i < moment.robots.size(); ++i) {
    plotting::Path path{.colour = moment.robots[i].colour};
    for (const Moment& m : moments_) {
      if (&m > &moment) break;
      if (i >= m.robots.size()) continue;
      const plotting::Point at = m.robots[i].at;
      const bool moved =
          path.points.empty() || !(std::hypot(at.x - path.points.back().x, at.y - path.points.back().y) < 0.1);
      if (moved || &m == &moment) path.points.push_back(at);  // each tenth of a metre is enough to see
    }
    panel.layers.push_back(path);
  }
  panel.layers.push_back(links);
  panel.layers.push_back(plotting::Robots{moment.robots});
  return panel;
}

plotting::Figure RunPictures::plan_figure() const {
  plotting::Figure figure{
      .title = world_,
      .caption = links_.empty() ? "Ways so far." : "Ways so far, and the smoothed RSSI of each link.",
      .width = 900,
      .share_x = true,
      .share_y = true};
  for (const Moment* m : snapshots()) figure.panels.push_back(plan_at(*m));
  return figure;
}

plotting::Figure RunPictures::rssi_figure() const {
  double low = -80, high = -40;  // dBm, so that pictures of several runs can be compared; further where the data is
  for (const Moment& m : moments_) {
    for (const auto* levels : {&m.rssi, &m.smooth}) {
      for (const double level : *levels) {
        if (!plotting::drawable(level)) continue;
        low = std::min(low, 10 * std::floor(level / 10));
        high = std::max(high, 10 * std::ceil(level / 10));
      }
    }
  }
  plotting::Panel panel{.x = {.label = "time", .unit = "s"},
                        .y = {.label = "RSSI", .unit = "dBm", .from = low, .to = high}};
  const auto trace = [this](std::size_t i, std::vector<double> Moment::*what) {
    plotting::Line line{.colour = plotting::series_colour(i)};
    for (const Moment& m : moments_) {
      line.x.push_back(m.time);
      line.y.push_back((m.*what)[i]);
    }
    return line;
  };
  for (std::size_t i = 0; i < links_.size(); ++i) {
    panel.layers.push_back(trace(i, &Moment::rssi));
    auto& line = std::get<plotting::Line>(panel.layers.back());
    line.colour = pale(*line.colour);
    line.width = 0.8;
  }
  for (std::size_t i = 0; i < links_.size(); ++i) {
    panel.layers.push_back(trace(i, &Moment::smooth));
    std::get<plotting::Line>(panel.layers.back()).label = links_[i].name;
  }
  if (!std::isnan(links_[0].threshold))
    panel.layers.push_back(plotting::Rule{.at = links_[0].threshold, .label = "threshold"});
  return {.title = world_,
          .caption = "RSSI of each robot's link towards the base: as measured (pale) and smoothed.",
          .width = 900,
          .panels = {panel}};
}

std::vector<std::filesystem::path> RunPictures::write(const std::filesystem::path& folder) const {
  std::vector<std::filesystem::path> files;
  const auto save = [](const plotting::Figure& figure, const std::filesystem::path& file) {
    try {
      plotting::save(figure, file);
    } catch (const std::runtime_error& e) {
      throw Error(Exit::io, e.what());
    }
  };
  if (!moments_.empty() && !moments_.back().robots.empty()) {
    files.push_back(folder / "plan.svg");
    save(plan_figure(), files.back());
  }
  if (!links_.empty()) {
    files.push_back(folder / "rssi.svg");
    save(rssi_figure(), files.back());
  }
  return files;
}

}  // namespace muster
