// SPDX-License-Identifier: Zlib
#include "command/accuracy/StudyReport.h"

#include "command/accuracy/Advice.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace accuracy {
namespace {

std::string referenceText(const Measure& measure) {
  if (measure.referenceError == 0) return measure.reference;
  return measure.reference + ", itself wrong by " + errorText(measure.referenceError) + " (Richardson)";
}

std::string orderText(const Order& order) {
  char text[160];
  const bool falls = order.value > order.halfWidth;
  std::snprintf(text, sizeof text, "%s: %s %.2f +- %.2f (95 %%, %d points)", order.method.c_str(),
                falls ? "order" : "no order, the slope is", order.value, order.halfWidth, order.points);
  return text;
}

nlohmann::ordered_json jsonOf(const Point& point) {
  nlohmann::ordered_json json;
  json["setting"] = point.name();
  json["method"] = point.method;
  json["label"] = point.label;
  json["knob"] = point.knob;
  if (std::isfinite(point.error)) {
    json["error"] = point.error;
  } else {
    json["error"] = nullptr;
    json["blows_up"] = true;
  }
  json["ns_per_node_step"] = point.nanosecondsPerNodeStep;
  json["us_per_node_second"] = point.microsecondsPerNodeSecond;
  if (point.substep) json["substep_s"] = *point.substep;
  if (point.iterations) json["iterations"] = *point.iterations;
  json["compared"] = point.isCompared;
  json["on_front"] = point.isOnFront;
  return json;
}

/// Headings of the two times of a point: of a query there is one.
struct TimeHeadings {
  const char* step;
  const char* second;
};

TimeHeadings headingsOf(const Study& study) {
  if (study.work == Work::queries) return {"ns per query", "us per query"};
  return {"ns per node and step", "us per node and simulated second"};
}

/// From the fastest to the most accurate.
std::vector<Point> frontOf(const Study& study) {
  std::vector<Point> front;
  for (const Point& point : study.points) {
    if (point.isOnFront) front.push_back(point);
  }
  std::sort(front.begin(), front.end(),
            [](const Point& a, const Point& b) { return a.microsecondsPerNodeSecond < b.microsecondsPerNodeSecond; });
  return front;
}

}  // namespace

nlohmann::ordered_json jsonOf(const Study& study) {
  nlohmann::ordered_json json;
  json["name"] = study.measure.name;
  json["title"] = study.measure.title;
  json["knob"] = study.knob;
  json["error_is"] = study.measure.error;
  json["reference"] = study.measure.reference;
  json["reference_error"] = study.measure.referenceError;
  json["timed"] = study.timed;
  json["points"] = nlohmann::ordered_json::array();
  for (const Point& point : study.points) json["points"].push_back(jsonOf(point));
  json["orders"] = nlohmann::ordered_json::array();
  for (const Order& order : study.orders) {
    json["orders"].push_back({{"method", order.method},
                              {"order", order.value},
                              {"half_width_95", order.halfWidth},
                              {"points", order.points}});
  }
  json["advice"] = study.advice;
  return json;
}

std::string textOf(const Study& study) {
  std::size_t width = 8;
  for (const Point& point : study.points) width = std::max(width, point.name().size());
  std::string text = study.measure.name + ": " + study.measure.title + "\n  error: " + study.measure.error +
                     "\n  against: " + referenceText(study.measure) + "\n  timed: " + study.timed + "\n";
  char line[320];
  const TimeHeadings headings = headingsOf(study);
  std::snprintf(line, sizeof line, "  %-*s  %10s  %20s  %32s\n", static_cast<int>(width), "setting", "error",
                headings.step, headings.second);
  text += line;
  for (const Point& point : study.points) {
    std::snprintf(line, sizeof line, "  %-*s  %10s  %20.1f  %32.3g  %s\n", static_cast<int>(width),
                  point.name().c_str(), errorText(point.error).c_str(), point.nanosecondsPerNodeStep,
                  point.microsecondsPerNodeSecond, point.isOnFront ? "front" : "");
    text += line;
  }
  for (const Order& order : study.orders) text += "  " + orderText(order) + "\n";
  return text + "  " + study.advice + "\n";
}

std::string markdownOf(const Study& study, const std::string& picture) {
  // What is no curve is short, and is read as a whole.
  const bool isTable = study.knob == "none" || study.knob == "precision";
  const TimeHeadings headings = headingsOf(study);
  std::string text = "### " + study.measure.name + ": " + study.measure.title + "\n\n";
  if (!picture.empty()) text += "![" + study.measure.title + "](" + picture + ")\n\n";
  text += "Error: " + study.measure.error + ". Against: " + referenceText(study.measure) + ". Timed: " + study.timed +
          ".\n\n| " + (isTable ? "setting" : "on the front") + " | error | " + headings.step + " | " + headings.second +
          " |\n|---|---|---|---|\n";
  char line[320];
  for (const Point& point : isTable ? study.points : frontOf(study)) {
    std::snprintf(line, sizeof line, "| %s | %s | %.1f | %.3g |\n", point.name().c_str(),
                  errorText(point.error).c_str(), point.nanosecondsPerNodeStep, point.microsecondsPerNodeSecond);
    text += line;
  }
  text += "\n";
  for (const Order& order : study.orders) text += "- " + orderText(order) + "\n";
  return text + (study.orders.empty() ? "" : "\n") + study.advice + "\n\n";
}

}  // namespace accuracy
