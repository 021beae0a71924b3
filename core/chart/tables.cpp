// SPDX-License-Identifier: MIT
#include "core/chart/tables.hpp"

#include "core/chart/write.hpp"

#include <fmt/format.h>

namespace mote::chart {
namespace {

std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\n") == std::string::npos) return field;
  std::string out = "\"";
  for (const char c : field) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

template <class Row> void each_point(const Panel& panel, const Row& row) {
  for (const Series& series : panel.series)
    for (const Point& point : series.points) row(series, point);
}

std::string html_table(const Panel& panel) {
  std::string out = fmt::format("<table>\n<caption>{}</caption>\n<tr><th>method</th><th>parameter</th><th>{}</th><th>{}</th><th></th></tr>\n",
                                escaped(panel.title), escaped(label(panel.x)), escaped(label(panel.y)));
  each_point(panel, [&](const Series& s, const Point& p) {
    out += fmt::format("<tr><td>{}</td><td>{}</td><td>{:.4g}</td><td>{:.4g}</td><td>{}</td></tr>\n", escaped(s.method), escaped(p.parameter), p.x, p.y,
                       p.front ? "Pareto front" : s.baseline ? "baseline" : "");
  });
  return out + "</table>\n";
}

} // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') out += "&amp;";
    else if (c == '<') out += "&lt;";
    else if (c == '>') out += "&gt;";
    else if (c == '"') out += "&quot;";
    else out += c;
  }
  return out;
}

std::string number(double value) { return fmt::format("{}", value); }

std::string to_csv(const Chart& chart) {
  std::string out = "panel,method,parameter,x_quantity,x_unit,x,y_quantity,y_unit,y,baseline,front,machine,device,driver,date\n";
  const Origin& o = chart.origin;
  for (const Panel& panel : chart.panels)
    each_point(panel, [&](const Series& s, const Point& p) {
      out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", quoted(panel.title), quoted(s.method), quoted(p.parameter), quoted(panel.x.quantity),
                         quoted(panel.x.unit), number(p.x), quoted(panel.y.quantity), quoted(panel.y.unit), number(p.y), s.baseline ? 1 : 0, p.front ? 1 : 0,
                         quoted(o.machine), quoted(o.device), quoted(o.driver), quoted(o.date));
    });
  return out;
}

std::string to_text(const Chart& chart) {
  std::string out = chart.title + "\n";
  for (const Panel& panel : chart.panels) {
    out += fmt::format("\n{}\n{:<44}{:<16}{:>14}{:>14}\n", panel.title, "", "", panel.x.unit.empty() ? "x" : panel.x.unit, panel.y.unit.empty() ? "y" : panel.y.unit);
    each_point(panel, [&](const Series& s, const Point& p) {
      out += fmt::format("{:<44}{:<16}{:>14.4g}{:>14.4g}{}\n", s.method + (s.baseline ? " (baseline)" : ""), p.parameter, p.x, p.y, p.front ? "  front" : "");
    });
    out += fmt::format("x: {}; y: {}\n", label(panel.x), label(panel.y));
  }
  for (const std::string& note : chart.notes) out += "\n" + note;
  return out + fmt::format("\n{}; {}; {}; {}\n", chart.origin.date, chart.origin.machine, chart.origin.device, chart.origin.driver);
}

std::string to_html(const Chart& chart) {
  std::string out = fmt::format("<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>{0}</title>\n<style>body{{font-family:sans-serif}}"
                                "td,th{{padding:0 .8em;text-align:right}}caption{{font-weight:bold;text-align:left}}table{{margin:1em 0}}</style>\n{1}",
                                escaped(chart.title), to_svg(chart));
  for (const Panel& panel : chart.panels) out += html_table(panel);
  return out + "</html>\n";
}

} // namespace mote::chart
