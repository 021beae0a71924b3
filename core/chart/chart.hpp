// SPDX-License-Identifier: MIT
// A chart as a value: panels of series of points, error over time or over a parameter, with what a reader must know to
// trust it (machine, device, date, command). Topics (app/charts) measure and fill it; write.hpp makes files of it. Pure:
// nothing here measures or draws.
//
// In a panel whose x is a cost ("trade_off") the points that no other point beats in both are marked: the Pareto front.
// Dominated methods that a topic shows to be compared with are baselines: drawn hollow, never recommended.
#pragma once

#include <string>
#include <vector>

namespace mote::chart {

struct Axis {
  std::string quantity{}; // "normal error, p99"
  std::string unit{};     // "rad"; empty: a plain number
  bool logarithmic{true};
};

struct Point {
  std::string parameter{}; // "n = 16", "κ = 1000"; with the method it names the point
  double x{}, y{};         // not finite: the method failed there; drawn at the upper edge
  bool front{};            // set by mark_front()
};

struct Series {
  std::string method{};
  bool baseline{};
  std::vector<Point> points{};
};

struct Panel {
  std::string title{};
  Axis x{}, y{};
  bool trade_off{}; // x is a cost (time, bytes) and y an error: less is better in both
  std::vector<Series> series{};
};

struct Origin {
  std::string machine{}, device{}, driver{}, date{}, command{};
};

struct Chart {
  std::string topic{}, title{};
  std::vector<Panel> panels{};
  std::vector<std::string> notes{}; // what could not be measured and why; sizes and scenes
  Origin origin{};
};

// Marks the points of trade_off panels that no other point of the panel beats: none has less or equal of both and less of
// one. Equal points are all marked; points that are not finite never. Other panels keep no mark.
void mark_front(Chart& chart);

// Value below which a share of the values lies (nearest rank); 0 of none.
double percentile(std::vector<double> values, double share);

// "quantity [unit]", or the quantity alone.
std::string label(const Axis& axis);

} // namespace mote::chart
