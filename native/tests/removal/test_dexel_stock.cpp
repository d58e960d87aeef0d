#include <gtest/gtest.h>

#include <map>

#include "mpm/removal/dexel_mesh.h"

namespace mpm {
namespace {

const Tool kBall{0, 5, 0, 30, {}};

SweptPath straight(const Vec3& from, const Vec3& to, const Vec3& axis = Vec3::UnitZ()) {
  return {{{from, axis}, {to, axis}}, {0, 1}};
}

DexelStock cut(const DexelGrid& grid, const Tool& tool, const SweptPath& path, int threads = 1) {
  DexelStock stock(grid);
  Context context(threads);
  cut_stock(stock, ToolSweep(tool, path), context);
  return stock;
}

double volume(const TriangleMesh& mesh) {
  double total = 0;
  for (const auto& t : mesh.triangles)
    total += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6;
  return total;
}

bool closed(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      ++edges[{t[k], t[(k + 1) % 3]}];
      --edges[{t[(k + 1) % 3], t[k]}];
    }
  for (const auto& [edge, balance] : edges)
    if (balance != 0) return false;
  return !edges.empty();
}

TEST(DexelStock, UncutStockIsABox) {
  const DexelStock stock(make_dexel_grid({0, 0, 0}, {10, 8, 4}, 0.5));
  EXPECT_DOUBLE_EQ(stock.volume(), 320);
  const TriangleMesh mesh = stock_mesh(stock);
  EXPECT_TRUE(closed(mesh));
  // Edges are chamfered over half a cell or less.
  EXPECT_NEAR(volume(mesh), 320, 44 * 0.5 * 0.5);
}

// A spherical pocket: the volume of a cap of height h is pi h^2 (3 R - h) / 3.
TEST(DexelStock, SpherePocketConvergesToItsVolume) {
  const double depth = 3, cap = kPi * depth * depth * (15 - depth) / 3;
  double last = kInfinity;
  for (const double cell : {0.4, 0.2, 0.1}) {
    const DexelStock stock =
        cut(make_dexel_grid({0, 0, 0}, {14, 14, 6}, cell), kBall, straight({7, 7, 9}, {7, 7, 3}));
    const double error = std::abs(14 * 14 * 6 - cap - stock.volume());
    EXPECT_LT(error, 4 * cell * cell);
    const TriangleMesh mesh = stock_mesh(stock);
    EXPECT_TRUE(closed(mesh));
    double off = 0;
    for (const Vec3& v : mesh.vertices)
      if (v.z() < 5 && (v.head<2>() - Vec2(7, 7)).norm() < 3.5 && v.z() > 1)
        off = std::max(off, std::abs((v - Vec3(7, 7, 8)).norm() - 5));
    EXPECT_LT(off, cell * cell / 5);  // the sagitta of a cell's diagonal, and a little
    EXPECT_LT(off, last / 2);
    last = off;
  }
}

// A cutter that lies on its side leaves a tunnel, which a height map cannot hold.
TEST(DexelStock, TunnelsStayTunnels) {
  const Tool pin{1, 0, 0, 40, {}};
  const DexelStock stock =
      cut(make_dexel_grid({0, 0, 0}, {10, 10, 10}, 0.25), pin, straight({-5, 5, 5}, {-5, 5, 5}, {1, 0, 0}));
  const DexelField& upright = stock.fields[2];
  const Span* s = upright.begin(20, 20);
  ASSERT_EQ(upright.end(20, 20) - s, 2);
  const double aside = stock.grid.node(1, 20) - 5;
  EXPECT_NEAR(s[0].to, 5 - std::sqrt(1 - aside * aside), 1e-6);
  EXPECT_NEAR(s[1].from, 5 + std::sqrt(1 - aside * aside), 1e-6);
  EXPECT_NEAR(stock.volume(), 1000 - kPi * 10, 0.5);
  EXPECT_TRUE(closed(stock_mesh(stock)));
}

// All three bundles see the same cut.
TEST(DexelStock, DirectionsAgree) {
  const Tool torus{6.7, 6.0, 6.0, 30.0, {}};
  SweptPath path{{{{5, 5, 4}, Vec3(0.1, 0, 1).normalized()},
                  {{25, 22, 6}, Vec3(0.3, 0.2, 1).normalized()},
                  {{30, 30, 3}, Vec3(-0.2, 0.3, 1).normalized()}},
                 {0, 1, 1}};
  const double cell = 0.2;
  const DexelStock stock = cut(make_dexel_grid({0, 0, 0}, {36, 36, 18}, cell), torus, path);
  const double volumes[] = {stock.fields[0].length(), stock.fields[1].length(), stock.fields[2].length()};
  for (const double v : volumes) EXPECT_NEAR(v / volumes[2], 1, 1e-3);
  EXPECT_TRUE(closed(stock_mesh(stock)));
}

TEST(DexelStock, SameBytesForAnyThreadCount) {
  const SweptPath path = straight({5, 5, 0}, {35, 30, 2}, Vec3(0.3, 0.2, 1).normalized());
  const DexelGrid grid = make_dexel_grid({0, 0, 0}, {40, 40, 10}, 1.0);
  const TriangleMesh one = stock_mesh(cut(grid, kBall, path, 1)), two = stock_mesh(cut(grid, kBall, path, 2));
  EXPECT_EQ(one.triangles, two.triangles);
  EXPECT_EQ(one.vertices, two.vertices);
}

TEST(DexelStock, NamesWhatIsWrong) {
  EXPECT_THROW(make_dexel_grid({0, 0, 0}, {0, 5, 5}, 1), std::invalid_argument);
  EXPECT_THROW(make_dexel_grid({0, 0, 0}, {5, 5, 5}, 0), std::invalid_argument);
  EXPECT_THROW(make_dexel_grid({0, 0, 0}, {1000, 1000, 1000}, 0.01), std::invalid_argument);
}

TEST(DexelStock, SaysItsMemoryBeforehand) {
  const DexelGrid grid = make_dexel_grid({0, 0, 0}, {40, 40, 10}, 0.25);
  const DexelStock stock(grid);
  const std::size_t bytes = stock.fields[0].bytes() + stock.fields[1].bytes() + stock.fields[2].bytes();
  EXPECT_NEAR(double(bytes) / double(dexel_bytes(grid)), 1, 0.1);
}

}  // namespace
}  // namespace mpm
