#include "vigil/adapters/report/page.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "vigil/adapters/report/html.hpp"
#include "vigil/adapters/report/page_style.hpp"
#include "vigil/runtime/mission_description.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::report {
namespace {

struct VerdictWords {
  const char* css;
  const char* text;
};

VerdictWords words_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kHolds:
      return {"holds", "holds"};
    case Verdict::kDiffers:
      return {"differs", "does not hold"};
    case Verdict::kNotTested:
      break;
  }
  return {"nottested", "not tested"};
}

std::string finding_item(const Finding& finding) {
  const VerdictWords words = words_of(finding.verdict);
  return fmt::format("<li><span class=\"verdict {}\">{}</span>{}<p>{}</p></li>\n", words.css, words.text,
                     escaped(finding.claim), escaped(finding.measured));
}

std::string finding_list(const std::vector<Finding>& findings, Source source, const char* heading) {
  std::string items;
  for (const Finding& finding : findings)
    if (finding.source == source) items += finding_item(finding);
  if (items.empty()) return "";
  return fmt::format("<p class=\"note\">{}</p><ul class=\"findings\">\n{}</ul>", heading, items);
}

std::string figure_section(const PageFigure& figure) {
  return fmt::format(
      "<section id=\"{0}\"><h2>{1}</h2><div class=\"figure\"><div><div class=\"scroll\">{2}</div><p "
      "class=\"note\">{3}</p><p class=\"links\"><a "
      "href=\"figures/{0}.svg\">SVG</a> &middot; <a "
      "href=\"figures/{0}.png\">PNG</a></p></div><div>{4}{5}</div></div></section>\n",
      figure.file, escaped(figure.title), inline_svg(figure.svg, figure.file + "-", figure.title), escaped(figure.note),
      finding_list(figure.findings, Source::kPaper, "What the paper says, and this recording"),
      finding_list(figure.findings, Source::kMission, "What the mission asks for, and this recording"));
}

std::string ordinal(std::size_t number) {
  const bool is_teen = number % 100 / 10 == 1;
  const std::size_t digit = is_teen ? 0 : number % 10;
  return fmt::format("{}{}", number, digit == 1 ? "st" : digit == 2 ? "nd" : digit == 3 ? "rd" : "th");
}

std::string header(const FlightData& data) {
  const runtime::Mission& mission = data.mission;
  return fmt::format(
      "<header><h1>{}</h1><p>{}</p><p>{} drones &middot; {:g} &times; {:g} m &middot; {:.7g} s &middot; accounting "
      "<code>{}</code></p></header>\n",
      escaped(mission.name), escaped(mission.description), data.drones(), data.field.length_x, data.field.length_y,
      data.end_s() - data.time_s(0), escaped(runtime::name_of(mission.control.accounting)));
}

/// What a figure of so many drones, or so long a flight, leaves out.
std::string thinning(const FlightData& data) {
  std::string text;
  if (!data.draws_all()) {
    text += fmt::format("Maps draw {} of the {} drones, evenly chosen; all else is of all drones. ", data.drawn.size(),
                        data.drones());
  }
  if (data.flight.every > 1) {
    text += fmt::format(
        "Of the recorded ticks each {} and the last are looked at, to keep within memory; distances to the border, to "
        "no-fly areas and of the nearest pair, and fall-backs, are those of all of them.",
        ordinal(data.flight.every));
  }
  return text.empty() ? "" : fmt::format("<section class=\"note\">{}</section>\n", text);
}

std::string tally(const std::vector<Finding>& findings, Source source, const char* what) {
  std::size_t holds = 0;
  std::size_t tested = 0;
  for (const Finding& finding : findings) {
    if (finding.source != source || finding.verdict == Verdict::kNotTested) continue;
    holds += finding.verdict == Verdict::kHolds ? 1 : 0;
    ++tested;
  }
  return tested == 0 ? ""
                     : fmt::format("<div class=\"tile\"><b>{} of {}</b><span>{}</span></div>\n", holds, tested, what);
}

std::string tiles(const SummaryFacts& facts, const std::vector<PageFigure>& figures) {
  std::vector<Finding> findings = facts.deadlines;
  for (const PageFigure& figure : figures)
    findings.insert(findings.end(), figure.findings.begin(), figure.findings.end());
  std::string text = "<div class=\"tiles\">\n" + tally(findings, Source::kPaper, "claims of the paper that hold here") +
                     tally(findings, Source::kMission, "demands of the mission that hold here");
  for (const SummaryFacts::Tile& tile : facts.tiles) {
    text +=
        fmt::format("<div class=\"tile\"><b>{}</b><span>{}</span></div>\n", escaped(tile.value), escaped(tile.what));
  }
  return text + "</div>\n";
}

std::string accounting_section(const FlightData& data, const CoverageMap& map) {
  std::string text = "<section id=\"accounting\"><h2>How coverage was counted</h2>\n";
  for (const std::string& note : accounting_notes(data, map))
    text += fmt::format("<p>{}</p>\n", escaped_with_code(note));
  if (const auto memory_s = runtime::memory_s(data.mission)) {
    text += fmt::format("<p>The past fades with a time constant of {:g} s.</p>\n", *memory_s);
  }
  return text + "</section>\n";
}

std::string attention_section(const CoverageMap& map) {
  if (!map.has_targets()) return "";
  std::vector<std::vector<std::string>> rows{{"target", "asked", "achieved", "share of the field"}};
  for (const AttentionShare& share : map.shares) {
    const auto percent = [](double value) { return fmt::format("{:.1f} %", 100.0 * value); };
    rows.push_back({share.name, percent(share.asked), percent(share.achieved), percent(share.area)});
  }
  return "<section id=\"attention\"><h2>Attention</h2>" + table(rows) +
         "<p class=\"note\">Share of the active drones' time in each target's region; 'elsewhere' is all that is far "
         "from every "
         "target, such as the ways between them.</p></section>\n";
}

std::string events_section(const FlightData& data) {
  constexpr std::size_t kMostEvents = 300;
  std::vector<std::vector<std::string>> rows{{"time", "from", "what", "drone", ""}};
  const auto& events = data.flight.events;
  for (std::size_t i = 0; i < std::min(events.size(), kMostEvents); ++i) {
    rows.push_back({fmt::format("{:.2f} s", events[i].time_s), events[i].source, events[i].what, events[i].drone,
                    events[i].detail});
  }
  std::string text =
      "<section id=\"events\"><h2>Events</h2>" + (events.empty() ? "<p class=\"note\">None.</p>" : table(rows));
  if (events.size() > kMostEvents) {
    text += fmt::format("<p class=\"note\">The first {} of {}; `vigil export` writes all of them.</p>", kMostEvents,
                        events.size());
  }
  return text + "</section>\n";
}

std::string table_section(const char* id, const char* title, const std::vector<std::vector<std::string>>& rows) {
  return fmt::format("<section id=\"{}\"><h2>{}</h2>{}</section>\n", id, title, table(rows));
}

std::string deadline_section(const SummaryFacts& facts) {
  if (facts.deadlines.empty()) return "";
  return "<section id=\"deadlines\"><h2>Deadlines</h2>" +
         finding_list(facts.deadlines, Source::kMission, "How long the mission lets a part of a target go unseen") +
         "</section>\n";
}

std::string warnings(const SummaryFacts& facts) {
  std::string text;
  for (const std::string& warning : facts.warnings)
    text += fmt::format("<section class=\"warning\">{}</section>\n", escaped(warning));
  return text;
}

}  // namespace

std::string page(const FlightData& data, const CoverageMap& map, const SummaryFacts& facts,
                 const std::vector<PageFigure>& figures) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, "
      "initial-scale=1\"><title>{} - flight report</title><style>{}</style></head>\n<body><main>\n",
      escaped(data.mission.name), kPageStyle);
  text += header(data) + warnings(facts) + thinning(data) + tiles(facts, figures);
  for (const PageFigure& figure : figures) text += figure_section(figure);
  text += accounting_section(data, map);
  text += "<div class=\"columns\">\n" + attention_section(map) + deadline_section(facts) +
          table_section("safety", "Safety", facts.safety) + table_section("coverage", "Coverage", facts.coverage) +
          (facts.faults.empty() ? "" : table_section("faults", "Faults", facts.faults)) +
          table_section("timing", "Timing", facts.timing) + "</div>\n";
  text += events_section(data);
  text +=
      "<footer>Maps are in the field's own frame: metres from its corner. What the paper says stands here in other "
      "words; each claim and each demand is held against this recording alone.</footer>\n</main></body></html>\n";
  return text;
}

}  // namespace vigil::report
