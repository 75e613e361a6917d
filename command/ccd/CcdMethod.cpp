// SPDX-License-Identifier: Zlib
#include "command/ccd/CcdMethod.h"

#include "command/ccd/BulletCheck.h"
#include "command/ccd/NewtonCheck.h"
#include "command/ccd/TextbookCheck.h"
#include "command/cli/Errors.h"

#include <bullet_wetcloth/collision/ContinuousCheck.h>

#include <cstdio>
#include <utility>

namespace command {
namespace {

using wetcloth::collision::CheckSettings;
using wetcloth::collision::Contact;
using wetcloth::collision::ContinuousCheck;
using wetcloth::collision::Pair;
using wetcloth::collision::Tier;
using Query = wetcloth::collision::Query<double>;
using Kind = CcdMethodInfo::Kind;
using Tolerance = CcdMethodInfo::Tolerance;

/// Answers one query at a time: check(query) gives a Contact.
template <class GivenQuery, class Check>
class OneByOne : public CcdMethod {
 public:
  OneByOne(std::vector<GivenQuery> queries, Check check) : m_queries(std::move(queries)), m_check(std::move(check)) {}

  std::size_t count() const override { return m_queries.size(); }
  void answer(std::size_t first, std::size_t count, Contact* contacts) const override {
    for (std::size_t i = 0; i < count; ++i) contacts[i] = m_check(m_queries[first + i]);
  }

 private:
  std::vector<GivenQuery> m_queries;
  Check m_check;
};

template <class GivenQuery, class Check>
std::unique_ptr<CcdMethod> oneByOne(std::vector<GivenQuery> queries, Check check) {
  return std::make_unique<OneByOne<GivenQuery, Check>>(std::move(queries), std::move(check));
}

class InBatches : public CcdMethod {
 public:
  InBatches(Pair pair, std::vector<Query> queries, const ContinuousCheck& check)
      : m_pair(pair), m_queries(std::move(queries)), m_check(check) {}

  std::size_t count() const override { return m_queries.size(); }
  std::size_t batch() const override { return 64; }
  void answer(std::size_t first, std::size_t count, Contact* contacts) const override {
    m_check(m_pair, m_queries.data() + first, count, contacts);
  }

 private:
  Pair m_pair;
  std::vector<Query> m_queries;
  ContinuousCheck m_check;
};

std::vector<Query> pointsOf(Pair pair, const std::vector<KnownQuery>& queries) {
  std::vector<Query> points;
  for (const KnownQuery& query : queries) {
    if (query.pair == pair) points.push_back(query.points);
  }
  return points;
}

/// Bullet's answer depends on the unit of time. With a second it finds no contact at all of a cloth with meshes of a
/// centimetre, in float32; so it gets what worlds give it.
std::vector<BulletQuery> bulletQueries(const std::vector<Query>& queries) {
  std::vector<BulletQuery> result;
  result.reserve(queries.size());
  for (const Query& query : queries) result.emplace_back(query, 1. / 60);
  return result;
}

CheckSettings settingsOf(std::optional<double> tolerance) {
  CheckSettings settings;
  settings.tolerance = tolerance.value_or(defaultCcdTolerance);
  return settings;
}

void requireTolerance(const CcdMethodInfo& info, double tolerance) {
  char text[128];
  if (info.tolerance == Tolerance::none) {
    std::snprintf(text, sizeof text, "wetcloth: --tolerance = %g: %s has none", tolerance, info.name.c_str());
    throw InputError(text);
  }
  const double smallest = info.tolerance == Tolerance::time ? 1e-12 : 0;
  if (tolerance >= smallest && tolerance <= 1) return;
  std::snprintf(text, sizeof text, "wetcloth: --tolerance = %g: must be in [%g, 1] for %s", tolerance, smallest,
                info.name.c_str());
  throw InputError(text);
}

}  // namespace

const std::vector<CcdMethodInfo>& ccdMethods() {
  static const std::vector<CcdMethodInfo> methods{
      {Kind::fast, "fast", "never misses a contact; false alarms are possible", Tolerance::time},
      {Kind::conservative, "conservative", "never misses a contact; false alarms are possible", Tolerance::time},
      {Kind::exact, "exact", "never misses a contact, gives no false alarms", Tolerance::time},
      {Kind::bullet, "bullet", "misses contacts; no edge-edge check; takes the motion for a step of 1/60 s",
       Tolerance::none},
      {Kind::textbook, "textbook", "misses contacts", Tolerance::inside},
      {Kind::newton, "newton", "misses contacts", Tolerance::inside}};
  return methods;
}

const CcdMethodInfo& ccdMethodNamed(const std::string& name) {
  for (const CcdMethodInfo& info : ccdMethods()) {
    if (info.name == name) return info;
  }
  throw InputError("wetcloth: --method = \"" + name + "\": there is none");
}

void requireCcdMethod(const CcdMethodInfo& info, std::optional<double> tolerance) {
  if (tolerance) requireTolerance(info, *tolerance);
  if (info.kind != Kind::exact || ContinuousCheck::hasExact()) return;
  throw InputError(
      "wetcloth: --method = \"exact\": is not in this build, for which Boost.Multiprecision was not found");
}

std::unique_ptr<CcdMethod> makeCcdMethod(const CcdMethodInfo& info, std::optional<double> tolerance, Pair pair,
                                         const std::vector<KnownQuery>& queries) {
  requireCcdMethod(info, tolerance);
  std::vector<Query> points = pointsOf(pair, queries);
  if (info.kind == Kind::bullet) {
    if (pair == Pair::edgeEdge) return nullptr;
    return oneByOne(bulletQueries(points), [](const BulletQuery& query) {
      Contact contact;
      contact.found = query.check();
      return contact;
    });
  }
  const CheckSettings settings = settingsOf(tolerance);
  const double inside = settings.tolerance;
  switch (info.kind) {
    case Kind::textbook:
      return oneByOne(std::move(points),
                      [=](const Query& query) { return comparison::textbookCheck(pair, query, inside); });
    case Kind::newton:
      return oneByOne(std::move(points),
                      [=](const Query& query) { return comparison::newtonCheck(pair, query, inside); });
    case Kind::fast: return std::make_unique<InBatches>(pair, std::move(points), ContinuousCheck(Tier::fast, settings));
    default: break;
  }
  const ContinuousCheck check(info.kind == Kind::exact ? Tier::exact : Tier::conservative, settings);
  return oneByOne(std::move(points), [=](const Query& query) { return check(pair, query); });
}

}  // namespace command
