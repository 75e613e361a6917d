// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/SheetBounds.h"

#include "tests/support/PassageCheck.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace wetcloth_test::sheet_bounds_test {
namespace {

using wetcloth::GuardBox;
using wetcloth::SheetBounds;

// Rows and columns of places.
struct Sheet {
  int rows;
  int columns;
  std::vector<Place> places;

  Place& at(int row, int column) { return places[std::size_t(row * columns + column)]; }
  const Place& at(int row, int column) const { return places[std::size_t(row * columns + column)]; }
};

using Shape = std::function<Place(double u, double v)>;

// Where the shape has the places of a flat sheet of sides 1 x 1.
Sheet shaped(int rows, int columns, const Shape& shape) {
  Sheet sheet = {rows, columns, std::vector<Place>(std::size_t(rows * columns))};
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) sheet.at(j, i) = shape(double(i) / (columns - 1), double(j) / (rows - 1));
  }
  return sheet;
}

// Each square is cut along one of its diagonals.
PassageMesh meshOf(const Sheet& sheet, const std::function<bool()>& isOther) {
  PassageMesh mesh;
  for (int j = 0; j < sheet.rows; ++j) {
    for (int i = 0; i < sheet.columns; ++i) {
      const int a = j * sheet.columns + i;
      const int b = a + 1;
      const int d = a + sheet.columns;
      mesh.vertices.push_back(a);
      if (i + 1 < sheet.columns) mesh.edges.push_back({a, b});
      if (j + 1 < sheet.rows) mesh.edges.push_back({a, d});
      if (i + 1 == sheet.columns || j + 1 == sheet.rows) continue;
      if (isOther()) {
        mesh.edges.push_back({b, d});
        mesh.faces.push_back({a, b, d});
        mesh.faces.push_back({b, d + 1, d});
      } else {
        mesh.edges.push_back({a, d + 1});
        mesh.faces.push_back({a, b, d + 1});
        mesh.faces.push_back({a, d + 1, d});
      }
    }
  }
  return mesh;
}

void include(GuardBox& box, const Place& from, const Place& to) {
  GuardBox vector;
  const btScalar infinity = std::numeric_limits<btScalar>::infinity();
  vector.low = wetcloth::everywhere<wetcloth::Quad>(0);
  vector.high = wetcloth::everywhere<wetcloth::Quad>(0);
  for (int axis = 0; axis < 3; ++axis) {
    const btScalar x = btScalar(to[std::size_t(axis)] - from[std::size_t(axis)]);
    vector.low[axis] = std::nextafter(x, -infinity);
    vector.high[axis] = std::nextafter(x, infinity);
  }
  box.include(vector);
}

SheetBounds boundsOf(const Sheet& sheet) {
  SheetBounds bounds;
  for (int j = 0; j < sheet.rows; ++j) {
    for (int i = 0; i < sheet.columns; ++i) {
      if (i + 1 < sheet.columns) include(bounds.u, sheet.at(j, i), sheet.at(j, i + 1));
      if (j + 1 < sheet.rows) include(bounds.v, sheet.at(j, i), sheet.at(j + 1, i));
    }
  }
  return bounds;
}

class Random {
 public:
  double between(double low, double high) { return low + (high - low) * m_number(m_random); }
  bool flip() { return m_random() % 2 == 0; }
  Place vector(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
  int count() { return int(2 + m_random() % 6); }

 private:
  std::mt19937 m_random{17};
  std::uniform_real_distribution<double> m_number{0, 1};
};

void turn(Sheet& sheet, Random& random) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double angle = random.between(0, 6.3);
    for (Place& x : sheet.places) {
      const double a = x[axis];
      const double b = x[(axis + 1) % 3];
      x[axis] = a * std::cos(angle) - b * std::sin(angle);
      x[(axis + 1) % 3] = a * std::sin(angle) + b * std::cos(angle);
    }
  }
}

// Sides are a row's vector and a column's, each from a box, and each place is put a little aside; many take the boxes'
// corners, where a certificate that says too much is wrong first.
Sheet randomSheet(int rows, int columns, double size, const Place& u, const Place& v, Random& random) {
  const auto side = [&](const Place& mean) {
    Place vector = mean;
    const bool isAtCorner = random.flip();
    for (double& x : vector) x += isAtCorner ? (random.flip() ? size : -size) : random.between(-size, size);
    return vector;
  };
  Sheet sheet = {rows, columns, std::vector<Place>(std::size_t(rows * columns), Place{0, 0, 0})};
  std::vector<Place> alongRow(std::size_t(columns), Place{0, 0, 0});
  std::vector<Place> alongColumn(std::size_t(rows), Place{0, 0, 0});
  const auto walk = [&](std::vector<Place>& places, const Place& mean) {
    for (std::size_t k = 1; k < places.size(); ++k) {
      const Place step = side(mean);
      for (std::size_t axis = 0; axis < 3; ++axis) places[k][axis] = places[k - 1][axis] + step[axis];
    }
  };
  walk(alongRow, u);
  walk(alongColumn, v);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Place aside = random.vector(size / 2);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        sheet.at(j, i)[axis] = alongRow[std::size_t(i)][axis] + alongColumn[std::size_t(j)][axis] + aside[axis];
      }
    }
  }
  return sheet;
}

// What a certificate is for. The sheet moves from one shape to another one; all that it is on its way has its sides
// between those of both.
TEST(SheetBounds, ASheetThatIsCertifiedNeverMeetsItself) {
  Random random;
  int certified = 0;
  int meeting = 0;
  for (int turn = 0; turn < 20000; ++turn) {
    const int rows = random.count();
    const int columns = random.count();
    const Place u = random.vector(1);
    const Place v = random.vector(1);
    const double size = random.between(0, 0.8);
    const Sheet from = randomSheet(rows, columns, size, u, v, random);
    const Sheet to = randomSheet(rows, columns, size, u, v, random);
    SheetBounds bounds = boundsOf(from);
    bounds.include(boundsOf(to));
    const bool isCertified = bounds.areOfASheetThatCannotMeetItself();
    if (!isCertified && turn % 20 != 0) continue;
    const PassageMesh mesh = meshOf(from, [&] { return random.flip(); });
    const int passages = countPassages(mesh, from.places, to.places);
    if (isCertified) {
      ++certified;
      ASSERT_EQ(passages, 0) << rows << " x " << columns << ", turn " << turn;
    } else if (passages > 0) {
      ++meeting;
    }
  }
  EXPECT_GT(certified, 1000);
  EXPECT_GT(meeting, 50);
}

Shape foldedAt(double line, double angle, double lift) {
  // Behind a line across the sheet all goes back, a little above.
  return [=](double u, double v) {
    const double along = std::cos(angle) * (u - 0.5) + std::sin(angle) * (v - 0.5);
    if (along <= line) return Place{u, v, 0.0};
    const double back = 2 * (along - line);
    return Place{u - back * std::cos(angle), v - back * std::sin(angle), lift};
  };
}

TEST(SheetBounds, ASheetFoldedOverIsNeverCertified) {
  Random random;
  for (int turnNumber = 0; turnNumber < 2000; ++turnNumber) {
    const Shape shape = foldedAt(random.between(-0.3, 0.1), random.between(0, 6.3), random.between(0, 0.05));
    Sheet sheet = shaped(9, 7, shape);
    turn(sheet, random);
    EXPECT_FALSE(boundsOf(sheet).areOfASheetThatCannotMeetItself()) << turnNumber;
  }
}

Shape cylinder(double bend, bool isAlongColumns) {
  const double radius = 1 / bend;
  return [=](double u, double v) {
    const double along = isAlongColumns ? v : u;
    const Place x = {radius * std::sin(along * bend), isAlongColumns ? u : v, radius * (1 - std::cos(along * bend))};
    return x;
  };
}

TEST(SheetBounds, AFlatSheetIsCertified) {
  Random random;
  for (int count = 0; count < 200; ++count) {
    const double length = random.between(0.3, 3);
    Sheet sheet = shaped(5, 8, [&](double u, double v) { return Place{length * u, v, 0.0}; });
    turn(sheet, random);
    EXPECT_TRUE(boundsOf(sheet).areOfASheetThatCannotMeetItself()) << count << ", length " << length;
  }
}

TEST(SheetBounds, ASheetBentALittleIsCertifiedAndATubeIsNot) {
  Random random;
  for (int count = 0; count < 200; ++count) {
    for (const bool isAlongColumns : {false, true}) {
      Sheet bent = shaped(9, 9, cylinder(0.5, isAlongColumns));
      turn(bent, random);
      EXPECT_TRUE(boundsOf(bent).areOfASheetThatCannotMeetItself()) << count << ", by 29 degrees";
      Sheet tube = shaped(9, 9, cylinder(6.4, isAlongColumns));
      turn(tube, random);
      EXPECT_FALSE(boundsOf(tube).areOfASheetThatCannotMeetItself()) << count;
    }
  }
}

TEST(SheetBounds, NothingIsSaidOfSidesThatVanishOrAreParallel) {
  const auto certified = [](const Place& u, const Place& v) {
    const Sheet sheet = shaped(4, 4, [&](double s, double t) {
      return Place{u[0] * s + v[0] * t, u[1] * s + v[1] * t, u[2] * s + v[2] * t};
    });
    return boundsOf(sheet).areOfASheetThatCannotMeetItself();
  };
  EXPECT_FALSE(certified({0, 0, 0}, {0, 1, 0}));
  EXPECT_FALSE(certified({1, 0, 0}, {0, 0, 0}));
  EXPECT_FALSE(certified({1, 1, 0}, {1, 1, 0}));
  EXPECT_FALSE(certified({1, 1, 0}, {-1, -1, 0}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(certified({nan, 0, 0}, {0, 1, 0}));
}

TEST(GuardBox, HasWhatItIncludes) {
  GuardBox box;
  EXPECT_TRUE(box.isEmpty());
  include(box, {0, 0, 0}, {1, 2, 3});
  EXPECT_FALSE(box.isEmpty());
  GuardBox other;
  include(other, {0, 0, 0}, {1, 2, 4});
  EXPECT_FALSE(box.overlaps(other));
  include(other, {0, 0, 0}, {1, 2, 2});
  EXPECT_TRUE(box.overlaps(other));
  EXPECT_TRUE(other.overlaps(box));
}

}  // namespace
}  // namespace wetcloth_test::sheet_bounds_test
