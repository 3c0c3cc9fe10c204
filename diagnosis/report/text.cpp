#include "diagnosis/report/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "diagnosis/inference/thresholds.hpp"
#include "diagnosis/report/advice.hpp"
#include "diagnosis/report/checked.hpp"

namespace muster::report {
namespace {

constexpr std::size_t columns = 100;

// Counts letters, not bytes: names of radios may be UTF-8.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string heading(const std::string& text) { return "\n" + text + "\n"; }

// A note that asks whether the data are what they are taken for comes before all that is found in them.
bool asks(const std::string& note) { return note.find('?') != note.npos; }

std::string introduction(const Diagnosis& d, const Setting& setting) {
  std::string text;
  for (const std::string& note : d.notes)
    if (asks(note)) text += wrapped("note: " + note);
  text += wrapped(setting.world + " " + verdict_in_words(d) + ".");
  text += wrapped(fmt::format("{} readings of {}, {}. The world's own parameters are fitted.", d.readings, setting.data,
                              rows_in_words(d)));
  return text;
}

std::string errors(const Diagnosis& d) {
  const bool improved = d.named() || !d.unexplained.empty();
  if (!d.held_out)
    return wrapped(fmt::format("Error of the fitted world: {} a reading. ", db(d.residual_sd)) + why_no_blocks(d) +
                       ' ' + errors_elsewhere(d),
                   2, 2);
  const auto& h = *d.held_out;
  std::string text =
      fmt::format("Error on held-out {}: {} with the world as fitted", what_is_held_out(d), db(h.rmse_before));
  if (!d.stairs.empty()) text += fmt::format(" (95 %: {:.2f} to {:.2f})", d.stairs[0].lower95, d.stairs[0].upper95);
  if (improved) text += fmt::format(", {} with {}", db(h.rmse_after), what_was_found(d));
  text += std::isfinite(noise_floor(d)) ? ". The noise alone is " + db(noise_floor(d)) + "." : ".";
  if (improved && h.gain < 0)
    text += fmt::format(" The squared error rises by {:.2f} dB2 (95 %: {:.2f} to {:.2f}, over {} blocks).", -h.gain,
                        -h.upper95, -h.lower95, h.blocks);
  else if (improved)
    text += fmt::format(" The squared error falls by {:.2f} dB2 (95 %: {:.2f} to {:.2f}, over {} blocks).", h.gain,
                        h.lower95, h.upper95, h.blocks);
  return wrapped(text + ' ' + errors_elsewhere(d), 2, 2);
}

// " word text", wrapped in the text's column.
std::string entry(const std::string& word, const std::string& text) {
  std::string padded = "      " + word;
  padded.resize(std::max<std::size_t>(18, padded.size() + 1), ' ');
  return padded + wrapped(text, 18, 18).substr(18);
}

// A line for each gain, and one for all that are none.
std::string gains(const std::optional<inference::HeldOutGain>& of_blocks, const std::string& why_none,
                  const std::vector<inference::Elsewhere>& elsewhere) {
  std::vector<inference::Elsewhere> all;
  if (of_blocks) all.push_back({"blocks", *of_blocks});
  all.insert(all.end(), elsewhere.begin(), elsewhere.end());
  std::vector<std::string> lines;
  if (!of_blocks) lines.push_back(why_none);
  std::string none, against;
  for (const inference::Elsewhere& e : all) {
    std::string& lost = is_refuted(e.held_out) ? against : none;
    if (e.held_out.gain >= 0)
      lines.push_back(gain_in_words(e.held_out, e.left_out));
    else
      lost += (lost.empty() ? "" : ", ") + held_out_in_words(e.held_out, e.left_out);
  }
  if (!none.empty()) lines.push_back(no_gain_in_words(none));
  if (!against.empty()) lines.push_back(loss_in_words(against));
  std::string text;
  for (const std::string& line : lines) text += entry(text.empty() ? "gain" : "", line);
  return text;
}

std::string cause_text(const CauseEstimate& c, int number) {
  const Confidence confidence = confidence_of(c);
  const std::string opening = confidence == Confidence::confirmed ? "it is " : "suspected: ";
  std::string text = wrapped(fmt::format("({}) {}{}: {}", number, opening, names_of(c), sentence(c)), 2, 6);
  text += entry("where", c.label == "all" ? "everywhere" : c.label);
  for (const CauseValue& v : c.values) text += entry(v.name, fmt::format("{:<12} 95 %: {}", quantity(v), interval(v)));
  if (c.one_station) text += entry("distance", one_station_in_words(*c.one_station));
  text += entry("evidence", fmt::format("{:.1f} nats; lambda {:.0f} (likelihood ratio, other causes fitted too)",
                                        c.evidence, c.lambda));
  if (c.inflation > 1)
    text += entry("", fmt::format("Gains of its kind are {:.1f} times those of chance in these readings; it stands out "
                                  "from them all the same.",
                                  c.inflation));
  text += gains(c.held_out, why_no_gain(c), c.elsewhere);
  if (!c.doubt.empty())
    text += entry("doubt", c.doubt);
  else if (confidence == Confidence::unconfirmed && c.held_out)
    text += entry("", "Not confirmed on held-out data: " + why_unconfirmed(c) + ".");
  if (confidence != Confidence::set_aside) text += entry("alternative", rivals_in_words(c));
  return text;
}

std::string causes(const Diagnosis& d) {
  if (d.causes.empty()) return "";
  std::string text = heading(d.causes.size() == 1 ? "Cause" : "Causes");
  int number = 0;
  for (const CauseEstimate& c : d.causes) text += (number ? "\n" : "") + cause_text(c, number + 1), ++number;
  return text;
}

std::string unexplained(const Diagnosis& d) {
  if (d.unexplained.empty()) return "";
  std::string text = heading("Not explained");
  for (const auto& u : d.unexplained) {
    text += wrapped(what_is_unexplained(u), 2, 2);
    text += gains(u.held_out, why_no_gain_of_rest(d), u.elsewhere);
  }
  return text;
}

std::string stairs(const Diagnosis& d) {
  if (d.stairs.size() < 3) return "";  // a single step repeats the cause's own line
  std::string text = heading("Error on held-out " + what_is_held_out(d) + ", cause by cause");
  for (std::size_t k = 0; k < d.stairs.size(); ++k)
    text += fmt::format("  {:<40} {:6.2f} dB   95 %: {:.2f} to {:.2f}\n", name_of_step(d, k), d.stairs[k].rmse,
                        d.stairs[k].lower95, d.stairs[k].upper95);
  return text + fmt::format("  {:<40} {:6.2f} dB\n", "noise alone", noise_floor(d));
}

std::string undecided(const Diagnosis& d) {
  const auto questions = open_questions(d);
  if (questions.empty()) return "";
  std::string text = heading("Undecided, and what to measure next");
  std::set<std::string> already;  // of one cause, beside several alternatives
  for (const Question& q : questions) {
    text += wrapped(fmt::format("{}: D {}{}.", q.pair, d_in_words(q.separability),
                                std::isnan(q.separability) ? "" : ", " + judged(q.separability)),
                    2, 2);
    if (already.insert(q.tell_apart).second) text += wrapped("- " + q.tell_apart, 4, 6);
    for (const Measurement& m : q.plans)
      text += wrapped(fmt::format("- {}: predicted D {:.0f}{}{}", m.say, m.predicted,
                                  m.predicted >= inference::thresholds::decided      ? ", decides"
                                  : m.predicted < inference::thresholds::inseparable ? ", too little"
                                                                                     : "",
                                  m.advised ? "; advised.csv lists its readings" : ""),
                      4, 6);
  }
  return text;
}

// "distance (p = 0.4), the link (p = 0.8)"
std::string with_chances(const std::vector<const inference::Check*>& checks) {
  std::string result;
  for (const inference::Check* c : checks)
    result += (result.empty() ? "" : ", ") + name_of(*c) + " (" + chance_of(*c) + ")";
  return result;
}

std::string checked(const Diagnosis& d) {
  const auto [along, causes, doubtful] = sorted_checks(d);
  if (along.empty() && causes.empty() && doubtful.empty()) return "";
  std::string text = heading("Tested, nothing found");
  if (!along.empty()) text += wrapped("No dependence left on: " + with_chances(along) + ".", 2, 4);
  if (!causes.empty()) text += wrapped("No further cause: " + with_chances(causes) + ".", 2, 4);
  if (const std::string alone = tested_separately(d); !alone.empty())
    text += wrapped("Also tested: " + alone + ".", 2, 4);
  if (!doubtful.empty()) text += wrapped("Doubtful: " + with_chances(doubtful) + ". " + why_doubtful, 2, 4);
  return text + wrapped(
                    "p: probability that noise alone gives as large a statistic anywhere along it; correlated "
                    "neighbours are allowed for.",
                    2, 4);
}

std::string record(const Diagnosis& d) {
  std::string text = heading("Checks of the readings");
  for (const diagnosis::ReceiverCheck& c : d.receiver.checks)
    text += wrapped(
        (c.fine ? "" : "! ") + c.what + ": " + c.found + (c.row ? fmt::format(", first in row {}", *c.row) : ""), 2, 4);
  return text;
}

std::string not_tested(const Diagnosis& d) {
  const auto reasons = reasons_not_tested(d);
  if (reasons.empty()) return "";
  std::string text = heading("Not tested");
  for (const std::string& reason : reasons) text += wrapped(reason, 2, 4);
  return text;
}

std::string world(const Diagnosis& d) {
  std::string text = heading("Parameters of the world, beside the causes (+-: 95 %)");
  for (const auto& v : d.world_values) {
    const double half = 1.96 * v.stderror;
    const std::string value =
        quantity(v.value, half, v.unit) + " +- " + rounded(half, half) + (v.at_bound ? "  (at its bound)" : "");
    text += wrapped(fmt::format("{:<28} {}", v.path, v.identifiable ? value : "not identifiable"), 2, 4);
  }
  text += wrapped(noise_in_words(d.noise, d.time_unit), 2, 4);
  for (const std::string& note : d.notes)
    if (!asks(note)) text += wrapped("note: " + note, 2, 4);
  return text;
}

std::string loop(const Diagnosis& d) {
  if (!d.loop) return "";
  std::string text = heading("The extended world: " + d.loop->world.string());
  text += wrapped(fmt::format("Simulated at the readings, it agrees with the diagnosis within {:.2g} dB. Diagnosed "
                              "again, it {}.",
                              d.loop->mean_difference, rediagnosis_in_words(d.loop->rediagnosis)),
                  2, 2);
  if (const auto& s = d.loop->second)
    text += wrapped(fmt::format("On {} ({} readings that were not used) its error is {} a reading; that of the given "
                                "world, fitted to these readings, {}. Diagnosed on them, it {}.",
                                s->data.string(), s->readings, db(s->rmse_extended), db(s->rmse_given),
                                rediagnosis_in_words(s->rediagnosis)),
                    2, 2);
  return text;
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t first_indent, std::size_t indent) {
  std::string out, line(first_indent, ' ');
  bool empty = true;
  std::size_t from = 0;
  while (from < text.size()) {
    // Blanks inside a line are kept, so that columns line up.
    std::size_t word = from;
    while (word < text.size() && text[word] == ' ') ++word;
    const std::size_t end = std::min(text.find(' ', word), text.size());
    const std::string piece = text.substr(empty ? word : from, end - (empty ? word : from));
    if (!empty && width_of(line) + width_of(piece) > columns) {
      out += line + '\n';
      line = std::string(indent, ' ') + text.substr(word, end - word);
    } else {
      line += piece;
    }
    empty = false;
    from = end;
  }
  return out + line + '\n';
}

std::vector<std::string> reasons_not_tested(const Diagnosis& d) {
  std::vector<std::string> order;
  std::map<std::string, std::string> who;
  for (const std::string& line : d.not_tested) {
    const auto colon = line.find(": ");
    const std::string reason = colon == line.npos ? line : line.substr(colon + 2);
    if (!who.count(reason)) order.push_back(reason);
    if (colon != line.npos) who[reason] += (who[reason].empty() ? "" : ", ") + short_name(line.substr(0, colon));
  }
  for (std::string& reason : order) {
    if (!who[reason].empty()) reason.insert(0, who[reason] + ": ");
  }
  return order;
}

std::string text_of(const Diagnosis& d, const Setting& setting) {
  std::string text = introduction(d, setting);
  text += heading("How far the world is off") + errors(d);
  text += causes(d) + unexplained(d) + stairs(d) + undecided(d) + checked(d) + record(d) + not_tested(d) + world(d) +
          loop(d);
  text += heading("Words") + wrapped(words_explained(), 2, 2);
  if (!setting.files.empty()) {
    text += heading("Written");
    for (const std::string& file : setting.files) text += "  " + file + "\n";
  }
  return text;
}

}  // namespace muster::report
