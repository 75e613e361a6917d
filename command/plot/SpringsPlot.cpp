// SPDX-License-Identifier: Zlib
#include "command/plot/Plots.h"
#include "command/scene/BulletWorld.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace command {
namespace {

using SpringKind = wetcloth::ClothPatch::Spring;

constexpr int nodesAlong = 7;  // nodes, few enough to tell the springs apart

/// The links of one kind, with a gap after each. A flexion spring lies on two mechanical ones, so it is drawn as a bow.
PlotSeries springsOf(const btSoftBody& body, SpringKind kind) {
  const btSoftBody::Material* const material = body.m_materials[static_cast<int>(kind)];
  const int pieces = kind == SpringKind::flexion ? 12 : 1;
  PlotSeries series;
  for (int l = 0; l < body.m_links.size(); ++l) {
    const btSoftBody::Link& link = body.m_links[l];
    if (link.m_material != material) continue;
    const btVector3 from = link.m_n[0]->m_x;
    const btVector3 along = link.m_n[1]->m_x - from;
    const std::ptrdiff_t node = link.m_n[0] - &body.m_nodes[0];
    // Its neighbours along the row must not hide it.
    const bool onTheOtherSide = (node / nodesAlong + node % nodesAlong) % 2 == 0;
    const btVector3 across = btVector3(-along.y(), along.x(), 0) * btScalar(onTheOtherSide ? 0.11 : -0.11);
    for (int i = 0; i <= pieces; ++i) {
      const auto share = static_cast<btScalar>(i) / static_cast<btScalar>(pieces);
      btVector3 place = from + along * share;
      if (kind == SpringKind::flexion) place += across * (4 * share * (1 - share));
      series.add(static_cast<double>(place.x()), static_cast<double>(place.y()));
    }
    series.add(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN());
  }
  return series;
}

PlotSeries massesOf(const btSoftBody& body) {
  PlotSeries series{"masses", "masses", PlotSeries::Mark::points, plot_colours::black, {}, {}};
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    series.add(static_cast<double>(body.m_nodes[i].m_x.x()), static_cast<double>(body.m_nodes[i].m_x.y()));
  }
  return series;
}

}  // namespace

std::vector<Plot> springsPlots(const PlotProgress& progress) {
  struct Shown {
    SpringKind kind;
    const char* name;
    const char* colour;
  };
  BulletWorld world(BulletWorld::Settings{});
  wetcloth::ClothPatch patch;
  patch.columns = patch.rows = nodesAlong;
  patch.edgeU = btVector3(btScalar(0.6), 0, 0);
  patch.edgeV = btVector3(0, btScalar(0.6), 0);
  const btSoftBody& body = world.add(patch.build(world.worldInfo()));
  Plot plot;
  plot.name = "springs";
  plot.title = "The springs between the masses of a patch, 7 x 7 (flexion springs drawn as bows)";
  plot.xColumn = "x_m";
  plot.yColumn = "y_m";
  plot.xLabel = "x [m]";
  plot.yLabel = "y [m]";
  plot.xRange = "[-0.04:0.64]";
  plot.yRange = "[-0.04:0.64]";
  plot.keyPlace = "outside right top";
  plot.hasEqualAxes = true;
  for (const auto& [kind, name, colour] : {Shown{SpringKind::flexion, "flexion", plot_colours::green},
                                           Shown{SpringKind::shear, "shear", plot_colours::orange},
                                           Shown{SpringKind::mechanical, "mechanical", plot_colours::blue}}) {
    PlotSeries series = springsOf(body, kind);
    series.name = name;
    series.legend = std::to_string(patch.springCount(kind)) + " " + name;
    series.colour = colour;
    plot.series.push_back(series);
  }
  plot.series.push_back(massesOf(body));
  progress(1);
  return {plot};
}

}  // namespace command
