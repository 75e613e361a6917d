// SPDX-License-Identifier: Zlib
#include "command/ccd/CcdReport.h"

#include "command/cli/Precision.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace command {
namespace {

using nlohmann::ordered_json;
using wetcloth::collision::Contact;
using wetcloth::collision::Pair;
using Tolerance = CcdMethodInfo::Tolerance;

std::string precisionOf(const CcdMethodInfo& method) {
  return nameOf(method.kind == CcdMethodInfo::Kind::bullet ? ownPrecision : Precision::float64);
}

void append(std::vector<std::string>& all, const std::vector<std::string>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

void CcdReport::add(Pair pair, const std::vector<KnownQuery>& queries) {
  Row row;
  row.type = pair == Pair::vertexFace ? "vf" : "ee";
  const auto isAsked = [pair](const KnownQuery& query) { return query.pair == pair; };
  const auto isContact = [&](const KnownQuery& query) { return isAsked(query) && query.meets; };
  row.queries = static_cast<std::size_t>(std::count_if(queries.begin(), queries.end(), isAsked));
  row.contacts = static_cast<std::size_t>(std::count_if(queries.begin(), queries.end(), isContact));
  const bool hasTolerance = m_method.tolerance != Tolerance::none;
  const auto method = makeCcdMethod(m_method, hasTolerance ? std::optional(m_tolerance) : std::nullopt, pair, queries);
  row.isAnswered = method != nullptr;
  if (method && row.queries > 0) {
    std::vector<Contact> contacts(row.queries);
    method->answer(0, row.queries, contacts.data());
    std::size_t next = 0;
    for (const KnownQuery& query : queries) {
      if (!isAsked(query)) continue;
      const bool found = contacts[next++].found;
      if (found != query.meets) (found ? row.falseAlarms : row.missed).push_back(query.id);
    }
    row.batch = std::min(method->batch(), row.queries);
    row.times = timeOf(*method, m_passes);
  }
  m_rows.push_back(std::move(row));
}

CcdReport::Row CcdReport::total() const {
  Row total;
  total.type = "both";
  double nanoseconds = 0;
  for (const Row& row : m_rows) {
    if (!row.isAnswered) continue;
    total.isAnswered = total.isAnswered || row.queries > 0;
    total.queries += row.queries;
    total.contacts += row.contacts;
    append(total.missed, row.missed);
    append(total.falseAlarms, row.falseAlarms);
    nanoseconds += row.times.mean * static_cast<double>(row.queries);
  }
  if (total.queries > 0) total.times.mean = nanoseconds / static_cast<double>(total.queries);
  return total;
}

ordered_json CcdReport::jsonOf(const Row& row) {
  ordered_json json{{"queries", row.queries},
                    {"contacts", row.contacts},
                    {"false_negatives", nullptr},
                    {"false_positives", nullptr},
                    {"ns_per_query", nullptr}};
  if (!row.isAnswered) return json;
  json["false_negatives"] = row.missed.size();
  json["false_positives"] = row.falseAlarms.size();
  if (row.queries == 0) return json;
  json["ns_per_query"] = {{"mean", row.times.mean},
                          {"median", row.times.median},
                          {"p99", row.times.p99},
                          {"worst", row.times.worst},
                          {"queries_timed_together", row.batch}};
  return json;
}

ordered_json CcdReport::json(bool withDisagreements) const {
  const Row all = total();
  std::size_t notAnswered = 0;
  for (const Row& row : m_rows) notAnswered += row.isAnswered ? 0 : row.queries;
  ordered_json json = jsonOf(all);
  json["ns_per_query"] = all.isAnswered ? ordered_json(all.times.mean) : ordered_json();
  json["not_answered"] = notAnswered;
  ordered_json result{{"method", m_method.name},
                      {"guarantee", m_method.guarantee},
                      {"precision", precisionOf(m_method)},
                      {"tolerance", nullptr},
                      {"passes", m_passes}};
  if (m_method.tolerance != Tolerance::none) result["tolerance"] = m_tolerance;
  result.update(json);
  for (const Row& row : m_rows) result[row.type] = jsonOf(row);
  if (withDisagreements) {
    result["disagreements"] = {{"false_negatives", all.missed}, {"false_positives", all.falseAlarms}};
  }
  return result;
}

std::string CcdReport::heading() const {
  std::string text = m_method.name + " (" + precisionOf(m_method);
  char tolerance[64];
  std::snprintf(tolerance, sizeof tolerance, ", %stolerance %g",
                m_method.tolerance == Tolerance::inside ? "inside " : "", m_tolerance);
  if (m_method.tolerance != Tolerance::none) text += tolerance;
  text += "): " + m_method.guarantee + "\n";
  std::size_t batch = 1;
  for (const Row& row : m_rows) batch = std::max(batch, row.batch);
  const std::string what = batch > 1 ? "in batches of " + std::to_string(batch) : "one at a time";
  char lines[256];
  std::snprintf(lines, sizeof lines,
                "\n%44sns per query: mean of all in a row, the rest %s\n%-6s%9s%10s%8s%14s%10s%10s%10s%10s\n", "",
                what.c_str(), "type", "queries", "contacts", "missed", "false alarms", "mean", "median", "99 %",
                "worst");
  return text + lines;
}

std::string CcdReport::lineOf(const Row& row) {
  char line[256];
  int length = std::snprintf(line, sizeof line, "%-6s%9zu%10zu", row.type.c_str(), row.queries, row.contacts);
  std::string text(line, static_cast<std::size_t>(length));
  if (!row.isAnswered) return text + "    none\n";
  length = std::snprintf(line, sizeof line, "%8zu%14zu", row.missed.size(), row.falseAlarms.size());
  text.append(line, static_cast<std::size_t>(length));
  if (row.queries == 0) return text + "\n";
  length = std::snprintf(line, sizeof line, "%10.0f", row.times.mean);
  text.append(line, static_cast<std::size_t>(length));
  if (row.times.worst == 0) return text + "\n";
  length = std::snprintf(line, sizeof line, "%10.0f%10.0f%10.0f", row.times.median, row.times.p99, row.times.worst);
  return text.append(line, static_cast<std::size_t>(length)) + "\n";
}

std::string CcdReport::table(bool withDisagreements) const {
  std::string text = heading();
  const Row all = total();
  bool isWhole = true;
  for (const Row& row : m_rows) {
    text += lineOf(row);
    isWhole = isWhole && row.isAnswered;
  }
  if (isWhole) text += lineOf(all);
  if (!withDisagreements) return text;
  text += all.missed.empty() && all.falseAlarms.empty() ? "\nno disagreements\n" : "\n";
  for (const std::string& id : all.missed) text += "missed " + id + "\n";
  for (const std::string& id : all.falseAlarms) text += "false alarm " + id + "\n";
  return text;
}

}  // namespace command
