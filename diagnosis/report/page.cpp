#include "diagnosis/report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/report/advice.hpp"
#include "diagnosis/report/checked.hpp"
#include "plotting/svg.hpp"

namespace muster::report {
namespace {

using plotting::escaped;

// Figures are drawn for white paper, and keep it in dark mode, slightly softer.
constexpr const char* style = R"(
:root { color-scheme: light dark; --paper: #fff; --ground: #f6f7f9; --ink: #1a1c1f; --soft: #5c6370; --line: #dfe3e8;
  --good: #00795a; --warn: #a34700; }
@media (prefers-color-scheme: dark) { :root { --paper: #1d2126; --ground: #14171b; --ink: #e7e9ec; --soft: #a0a8b3;
  --line: #343a42; --good: #4fc9a2; --warn: #f0a25e; } figure { filter: brightness(.9); } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink); font: 16px/1.55 Helvetica, Arial, 'Liberation Sans', sans-serif; }
main { max-width: 1080px; margin: 0 auto; padding: 40px 20px 64px; }
h1 { font-size: 28px; line-height: 1.25; margin: 0 0 8px; }
h2 { font-size: 20px; margin: 44px 0 12px; }
h3 { font-size: 17px; line-height: 1.4; margin: 0 0 12px; }
p { margin: 0 0 12px; max-width: 76ch; } .soft { color: var(--soft); } small { color: var(--soft); font-size: 13px; }
.card, figure { background: var(--paper); border: 1px solid var(--line); border-radius: 10px; padding: 20px; margin: 0 0 20px; }
figure { background: #fff; padding: 16px; text-align: center; } figure svg { max-width: 100%; height: auto; display: block; margin: 0 auto; }
.key { display: grid; grid-template-columns: repeat(auto-fit, minmax(190px, 1fr)); gap: 12px; margin: 24px 0; padding: 0; }
.key div { background: var(--paper); border: 1px solid var(--line); border-radius: 10px; padding: 14px 16px; }
.key b { display: block; font-size: 24px; font-weight: 600; line-height: 1.2; white-space: nowrap; } .key span { color: var(--soft); font-size: 13px; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; margin: 0 0 12px; }
table.values { width: auto; min-width: 420px; }
th { text-align: left; color: var(--soft); font-weight: normal; font-size: 13px; }
th, td { padding: 6px 16px 6px 0; border-bottom: 1px solid var(--line); vertical-align: top; }
tr:last-child td { border-bottom: 0; } td.n, th.n { text-align: right; white-space: nowrap; } .scroll { overflow-x: auto; }
.mark { display: inline-block; font-size: 12px; border: 1px solid; border-radius: 99px; padding: 1px 10px; margin-right: 8px; vertical-align: 2px; }
.named { color: var(--good); } .suspected { color: var(--warn); } code { font-size: 14px; overflow-wrap: anywhere; }
)";

std::string paragraph(const std::string& text, const char* kind = "") {
  return fmt::format("<p{}>{}</p>\n", *kind ? fmt::format(" class=\"{}\"", kind) : "", escaped(text));
}
std::string heading(const std::string& text) { return fmt::format("<h2>{}</h2>\n", escaped(text)); }

std::string capital(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

// A title that begins with a name is not capitalised.
std::string title_of(const CauseEstimate& c) { return c.title.rfind('{', 0) == 0 ? sentence(c) : capital(sentence(c)); }

struct TableCell {
  std::string text;
  bool number = false;
};
using Row = std::vector<TableCell>;

std::string table(const Row& head, const std::vector<Row>& rows, const char* kind = "") {
  const auto line = [](const Row& row, const char* tag) {
    std::string out = "<tr>";
    for (const TableCell& cell : row)
      out += fmt::format("<{0}{1}>{2}</{0}>", tag, cell.number ? " class=\"n\"" : "", escaped(cell.text));
    return out + "</tr>\n";
  };
  std::string out = fmt::format("<div class=\"scroll\"><table{}>\n", *kind ? fmt::format(" class=\"{}\"", kind) : "") +
                    (head.empty() ? "" : line(head, "th"));
  for (const Row& row : rows) out += line(row, "td");
  return out + "</table></div>\n";
}

std::string figure_named(const std::vector<Picture>& pictures, const std::string& name) {
  for (const Picture& p : pictures) {
    if (p.name != name) continue;
    const std::string svg = plotting::svg(p.figure);
    return "<figure>\n" + svg.substr(svg.find("<svg")) + "</figure>\n";  // without the XML declaration
  }
  return "";
}

std::string key_figure(const std::string& value, const std::string& what) {
  return fmt::format("<div><b>{}</b><span>{}</span></div>\n", escaped(value), escaped(what));
}

std::string key_figures(const Diagnosis& d) {
  std::string out = "<section class=\"key\">\n";
  if (d.held_out) {
    out += key_figure(db(d.held_out->rmse_before), "error of the fitted world on held-out " + what_is_held_out(d));
    if (d.stairs.size() > 1) out += key_figure(db(d.held_out->rmse_after), "with what was found");
    out += key_figure(db(noise_floor(d)), "noise alone, the floor");
    if (d.stairs.size() > 1)
      out += key_figure(fmt::format("{:.2f} dB²", d.held_out->gain),
                        fmt::format("gain: fall of the squared error, 95 %: {:.2f} to {:.2f}, over {} blocks",
                                    d.held_out->lower95, d.held_out->upper95, d.held_out->blocks));
    else
      out += key_figure(std::to_string(d.held_out->blocks), "blocks of space, each left out in turn");
  } else {
    out += key_figure(db(d.residual_sd), "left by the fitted world, a reading");
    out += key_figure("1 block", "of space: no places could be held out");
  }
  return out + "</section>\n";
}

std::string gain_text(const std::optional<inference::HeldOutGain>& h, const std::string& why_none) {
  return h ? gain_in_words(*h, "blocks") : why_none;
}

std::string cause_card(const CauseEstimate& c, std::size_t number, const std::vector<Picture>& pictures) {
  const Confidence confidence = confidence_of(c);
  const bool sure = confidence == Confidence::confirmed;
  std::string out = fmt::format("<article class=\"card\">\n<h3><span class=\"mark {}\">{}</span>{}</h3>\n",
                                sure ? "named" : "suspected", sure ? "named" : "suspected", escaped(title_of(c)));
  if (!c.doubt.empty())
    out += paragraph("Doubt: " + c.doubt + ".");
  else if (confidence == Confidence::unconfirmed)
    out += paragraph("Named, but not confirmed on held-out data: " + why_unconfirmed(c) + ".");
  std::vector<Row> values;
  for (const CauseValue& v : c.values) values.push_back({{v.name}, {quantity(v), true}, {interval(v), true}});
  out += table({{"parameter"}, {"value", true}, {"95 % interval", true}}, values, "values");
  std::vector<Row> facts{
      {{"cause"}, {names_of(c)}},
      {{"where"}, {c.label == "all" ? "everywhere" : c.label}},
      {{"evidence"},
       {fmt::format("{:.1f} nats; λ = {:.0f} (likelihood ratio, other causes fitted too)", c.evidence, c.lambda)}},
      {{"gain"}, {gain_text(c.held_out, why_no_gain(c))}}};
  if (c.one_station) facts.push_back({{"distance"}, {one_station_in_words(*c.one_station)}});
  if (c.inflation > 1)
    facts.push_back({{"inflation"},
                     {fmt::format("gains of its kind are {:.1f} times those of chance in these readings; "
                                  "it stands out from them all the same",
                                  c.inflation)}});
  for (const inference::Elsewhere& e : c.elsewhere)
    facts.push_back({{e.left_out + " not seen"}, {gain_in_words(e.held_out, e.left_out)}});
  facts.push_back({{"alternative"}, {rivals_in_words(c)}});
  out += table({}, facts);
  return out + "</article>\n" + figure_named(pictures, fmt::format("cause_{}", number));
}

std::string undecided(const Diagnosis& d) {
  const auto questions = open_questions(d);
  if (questions.empty()) return "";
  std::string out = heading("Undecided, and what to measure next");
  out += paragraph(
      "D is how far, in standard deviations of the noise, squared, one cause is from the best imitation by the "
      "other: below 12 they are not distinguishable, above 25 they are.",
      "soft");
  std::vector<Row> rows;
  for (const Question& q : questions) {
    for (const Measurement& m : q.plans)
      rows.push_back({{q.pair},
                      {d_in_words(q.separability), true},
                      {m.say + (m.advised ? " (advised.csv lists its readings)" : "")},
                      {fmt::format("{:.0f}", m.predicted), true}});
    rows.push_back({{q.pair}, {d_in_words(q.separability), true}, {q.tell_apart}, {"not worked out", true}});
  }
  return out + "<div class=\"card\">" + table({{"pair"}, {"D now", true}, {"measure"}, {"D predicted", true}}, rows) +
         "</div>\n";
}

std::string checked(const Diagnosis& d) {
  if (d.checks.empty()) return "";
  return heading("Tested, nothing found") +
         paragraph(
             "p: probability that noise alone gives as large a statistic anywhere along it, beside the causes found.",
             "soft");
}

std::string checked_table(const Diagnosis& d) {
  const auto [along, causes, doubtful] = sorted_checks(d);
  if (along.empty() && causes.empty() && doubtful.empty()) return "";
  const auto of = [](const char* what, const std::vector<const inference::Check*>& checks) {
    std::vector<Row> rows;
    rows.reserve(checks.size());
    for (const inference::Check* c : checks) rows.push_back({{name_of(*c)}, {chance_of(*c), true}});
    return rows.empty() ? "" : table({{what}, {"chance", true}}, rows);
  };
  std::string out = "<div class=\"card\">" + of("dependence on", along) + of("further cause", causes);
  if (const std::string alone = tested_separately(d); !alone.empty())
    out += paragraph("Also tested: " + alone + ".", "soft");
  if (!doubtful.empty()) out += of("doubtful", doubtful) + paragraph(why_doubtful, "soft");
  return out + "</div>\n";
}

std::string not_tested(const Diagnosis& d) {
  const auto reasons = reasons_not_tested(d);
  if (reasons.empty()) return "";
  std::string out = heading("Not tested") + "<div class=\"card\"><ul>\n";
  for (const std::string& reason : reasons) out += "<li>" + escaped(reason) + "</li>\n";
  return out + "</ul></div>\n";
}

std::string record(const Diagnosis& d) {
  if (d.receiver.checks.empty()) return "";
  std::vector<Row> rows;
  for (const diagnosis::ReceiverCheck& c : d.receiver.checks)
    rows.push_back(
        {{(c.fine ? "" : "! ") + c.what}, {c.found + (c.row ? fmt::format(", first in row {}", *c.row) : "")}});
  return heading("Checks of the readings") + "<div class=\"card\">" + table({{"check"}, {"found"}}, rows) + "</div>\n";
}

std::string world(const Diagnosis& d) {
  std::vector<Row> rows;
  for (const auto& v : d.world_values) {
    const double half = 1.96 * v.stderror;
    const std::string within = "± " + rounded(half, half) + (v.at_bound ? " (at its bound)" : "");
    rows.push_back({{v.path},
                    {v.identifiable ? quantity(v.value, half, v.unit) : "not identifiable", true},
                    {v.identifiable ? within : "", true}});
  }
  std::string out = heading("The world's own parameters, beside the causes") + "<div class=\"card\">";
  out += table({{"parameter"}, {"value", true}, {"95 %", true}}, rows, "values");
  out += paragraph(noise_in_words(d.noise, d.time_unit));
  for (const std::string& note : d.notes) out += paragraph("Note: " + note, "soft");
  return out + "</div>\n";
}

std::string loop(const Diagnosis& d) {
  if (!d.loop) return "";
  std::string out = heading("The extended world") + "<div class=\"card\">";
  out += paragraph(
      fmt::format("Simulated at the readings, it agrees with the diagnosis within {:.2g} dB. Diagnosed again, it {}.",
                  d.loop->mean_difference, rediagnosis_in_words(d.loop->rediagnosis)));
  if (const auto& s = d.loop->second)
    out += paragraph(fmt::format(
        "On {} ({} readings that were not used) its error is {} a reading; that of the given world, fitted to "
        "these readings, {}. Diagnosed on them, it {}.",
        s->data.string(), s->readings, db(s->rmse_extended), db(s->rmse_given), rediagnosis_in_words(s->rediagnosis)));
  return out + "</div>\n";
}

}  // namespace

std::string page_of(const Diagnosis& d, const Setting& setting, const std::vector<Picture>& pictures) {
  std::string body = fmt::format("<h1>{} {}</h1>\n", escaped(setting.world), escaped(verdict_in_words(d)));
  body += paragraph(
      fmt::format("{} readings of {}, {}. Verdict: {}.", d.readings, setting.data, rows_in_words(d), d.verdict()),
      "soft");
  body += key_figures(d);
  if (!d.held_out) body += paragraph(why_no_blocks(d));
  if (const std::string elsewhere = errors_elsewhere(d); !elsewhere.empty()) body += paragraph(elsewhere);
  body += figure_named(pictures, "residual_map");
  if (!d.causes.empty()) body += heading(d.causes.size() == 1 ? "The cause" : "The causes");
  for (std::size_t k = 0; k < d.causes.size(); ++k) body += cause_card(d.causes[k], k + 1, pictures);
  if (!d.unexplained.empty()) {
    body += heading("Not explained");
    for (const auto& u : d.unexplained) {
      std::string text = what_is_unexplained(u) + " Gain: " + gain_text(u.held_out, why_no_gain_of_rest(d)) + ".";
      for (const inference::Elsewhere& e : u.elsewhere)
        text += " Of " + e.left_out + " not seen: " + gain_in_words(e.held_out, e.left_out) + ".";
      body += "<div class=\"card\">" + paragraph(text) + "</div>\n";
    }
  }
  if (d.stairs.size() > 1)
    body += heading("Gain") + figure_named(pictures, "steps") + figure_named(pictures, "before_after");
  body += undecided(d) + checked(d) + figure_named(pictures, "covariates") + checked_table(d) + record(d) +
          not_tested(d) + world(d) + loop(d) + heading("Words") + paragraph(words_explained(), "soft");
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<title>Diagnosis of {}</title>\n<style>{}</style>\n"
      "</head>\n<body>\n<main>\n{}</main>\n</body>\n</html>\n",
      escaped(setting.world), style, body);
}

}  // namespace muster::report
