#include "mpm/removal/dexel_mesh.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace mpm {
namespace {

using Index = std::ptrdiff_t;
using Node = std::array<Index, 3>;

// Nodes first .. last of a dexel along z that lie in material, and where it begins and ends.
struct Run {
  Index first, last;
  double from, to;
};

class NetBuilder {
 public:
  explicit NetBuilder(const DexelStock& stock) : stock_(stock), grid_(stock.grid) {}

  TriangleMesh build() {
    const Index nx = Index(grid_.count[0]), ny = Index(grid_.count[1]);
    for (Index j = 0; j < ny; ++j)
      for (Index i = 0; i < nx; ++i) add_ends(i, j);
    for (Index j = 0; j < ny; ++j)
      for (Index i = -1; i < nx; ++i) add_sides(0, i, j, i + 1, j);
    for (Index j = -1; j < ny; ++j)
      for (Index i = 0; i < nx; ++i) add_sides(1, i, j, i, j + 1);
    for (std::size_t i = 0; i < sums_.size(); ++i) mesh_.vertices.push_back(sums_[i] / weights_[i]);
    for (const auto& quad : quads_) add_triangles(quad);
    return std::move(mesh_);
  }

 private:
  std::vector<Run> runs(Index i, Index j) const {
    std::vector<Run> result;
    if (i < 0 || j < 0 || i >= Index(grid_.count[0]) || j >= Index(grid_.count[1])) return result;
    const DexelField& field = stock_.fields[2];
    for (const Span* s = field.begin(std::size_t(i), std::size_t(j));
         s != field.end(std::size_t(i), std::size_t(j));
         ++s) {
      const Index first = Index(std::ceil((s->from - grid_.lo.z()) / grid_.cell - 0.5));
      const Index last =
          std::min(Index(std::floor((s->to - grid_.lo.z()) / grid_.cell - 0.5)), Index(grid_.count[2]) - 1);
      if (first > last) continue;
      if (!result.empty() && result.back().last + 1 >= first)
        result.back().last = last, result.back().to = s->to;
      else
        result.push_back({first, last, s->from, s->to});
    }
    return result;
  }

  void add_ends(Index i, Index j) {
    for (const Run& run : runs(i, j)) {
      add_crossing(2, {i, j, run.first - 1}, run.from, false);
      add_crossing(2, {i, j, run.last}, run.to, true);
    }
  }

  // Nodes that are in material on one of two neighbouring dexels only: the surface passes between them.
  void add_sides(int axis, Index i, Index j, Index i1, Index j1) {
    const std::vector<Run> a = runs(i, j), b = runs(i1, j1);
    add_outside(axis, i, j, a, b, true);
    add_outside(axis, i, j, b, a, false);
  }

  void add_outside(
      int axis, Index i, Index j, const std::vector<Run>& in, const std::vector<Run>& out, bool leaves) {
    auto other = out.begin();
    for (const Run& run : in)
      for (Index k = run.first; k <= run.last; ++k) {
        while (other != out.end() && other->last < k) ++other;
        if (other != out.end() && other->first <= k) {
          k = std::min(other->last, run.last);
          continue;
        }
        add_crossing(axis, {i, j, k}, crossing(axis, {i, j, k}, leaves), leaves);
      }
  }

  // Where the material of the dexel along `axis` ends (leaves) or begins between a node and the next; the
  // middle when that dexel does not know of it.
  double crossing(int axis, const Node& node, bool leaves) const {
    const double lo = grid_.node(axis, node[std::size_t(axis)]), hi = lo + grid_.cell;
    const DexelField& field = stock_.fields[std::size_t(axis)];
    const std::size_t u = std::size_t(node[std::size_t((axis + 1) % 3)]),
                      v = std::size_t(node[std::size_t((axis + 2) % 3)]);
    for (const Span* s = field.begin(u, v); s != field.end(u, v); ++s) {
      const double at = leaves ? s->to : s->from;
      if (at >= lo && at <= hi) return at;
    }
    return 0.5 * (lo + hi);
  }

  // The surface crosses the edge from `node` to the next along `axis`; leaves: material on the node's side.
  void add_crossing(int axis, const Node& node, double at, bool leaves) {
    Vec3 point;
    for (int k = 0; k < 3; ++k) point[k] = k == axis ? at : grid_.node(k, node[std::size_t(k)]);
    const std::size_t u = std::size_t((axis + 1) % 3), v = std::size_t((axis + 2) % 3);
    std::array<std::uint32_t, 4> quad;
    constexpr Index kRound[4][2] = {{-1, -1}, {0, -1}, {0, 0}, {-1, 0}};
    for (std::size_t c = 0; c < 4; ++c) {
      Node cell = node;
      cell[u] += kRound[c][0], cell[v] += kRound[c][1];
      quad[c] = vertex(cell);
      sums_[quad[c]] += point;
      weights_[quad[c]] += 1;
    }
    if (!leaves) std::swap(quad[1], quad[3]);
    quads_.push_back(quad);
  }

  std::uint32_t vertex(const Node& cell) {
    const std::uint64_t nx = grid_.count[0] + 1, ny = grid_.count[1] + 1;
    const std::uint64_t key =
        (std::uint64_t(cell[2] + 1) * ny + std::uint64_t(cell[1] + 1)) * nx + std::uint64_t(cell[0] + 1);
    const auto [place, added] = vertex_.try_emplace(key, std::uint32_t(sums_.size()));
    if (added) sums_.push_back(Vec3::Zero()), weights_.push_back(0);
    return place->second;
  }

  // Along the shorter diagonal.
  void add_triangles(const std::array<std::uint32_t, 4>& q) {
    const auto length = [&](std::size_t a, std::size_t b) {
      return (mesh_.vertices[q[a]] - mesh_.vertices[q[b]]).squaredNorm();
    };
    if (length(0, 2) <= length(1, 3)) {
      mesh_.triangles.push_back({q[0], q[1], q[2]});
      mesh_.triangles.push_back({q[0], q[2], q[3]});
    } else {
      mesh_.triangles.push_back({q[0], q[1], q[3]});
      mesh_.triangles.push_back({q[1], q[2], q[3]});
    }
  }

  const DexelStock& stock_;
  const DexelGrid& grid_;
  std::unordered_map<std::uint64_t, std::uint32_t> vertex_;
  std::vector<Vec3> sums_;
  std::vector<double> weights_;
  std::vector<std::array<std::uint32_t, 4>> quads_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh stock_mesh(const DexelStock& stock) { return NetBuilder(stock).build(); }

}  // namespace mpm
