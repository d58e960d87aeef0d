#include "mpm/removal/dexel_stock.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mpm/base/error.h"
#include "mpm/base/parallel.h"

namespace mpm {
namespace {

constexpr std::size_t kStrokesPerBox = 8;  // after so many strokes the tile's box is made anew
constexpr double kCellSlack = 1e-9;        // of a cell: a width of a whole number of cells gets no cell more

using SpanList = std::vector<Span>;

// Takes from..to out of ascending spans; less than kRayEpsilon is not left over.
void take_out(SpanList& spans, double from, double to) {
  SpanList left;
  for (const Span& s : spans) {
    if (to <= s.from || from >= s.to) {
      left.push_back(s);
      continue;
    }
    if (from - s.from > kRayEpsilon) left.push_back({s.from, from});
    if (s.to - to > kRayEpsilon) left.push_back({to, s.to});
  }
  spans.swap(left);
}

void cut_dexel(SpanList& spans,
               const Ray& ray,
               const ToolSweep& sweep,
               std::uint32_t stroke,
               std::uint32_t pieces,
               SpanList& gaps) {
  gaps.clear();
  for (const Span& s : spans) {
    const std::uint32_t near = sweep.pieces_not_above(stroke, pieces, ray, s.from, s.to);
    sweep.visit_spans(stroke, near, ray, s.from, s.to, [&](double a, double b) { gaps.push_back({a, b}); });
  }
  for (const Span& gap : gaps) take_out(spans, gap.from, gap.to);
}

}  // namespace

DexelGrid make_dexel_grid(const Vec3& lo, const Vec3& hi, double cell) {
  require(std::isfinite(cell) && cell > 0, "cell_mm must be a positive number");
  require(lo.allFinite() && hi.allFinite() && (lo.array() < hi.array()).all(), "lo, hi: empty box of stock");
  const Vec3 n = ((hi - lo) / cell).array().ceil();
  require(n.x() * n.y() + n.y() * n.z() + n.z() * n.x() <= kMaxDexels,
          "cell_mm: gives more than " + std::to_string(std::size_t(kMaxDexels)) +
              " dexels; take a larger cell or a smaller box of stock");
  DexelGrid grid{lo, hi, cell, {}};
  for (int k = 0; k < 3; ++k)
    grid.count[std::size_t(k)] =
        std::max<std::size_t>(1, std::size_t(std::ceil((hi - lo)[k] / cell - kCellSlack)));
  return grid;
}

DexelField::DexelField(const DexelGrid& grid, int axis)
    : grid_(grid),
      axis_(axis),
      count_u_(grid.count[std::size_t((axis + 1) % 3)]),
      count_v_(grid.count[std::size_t((axis + 2) % 3)]),
      tiles_u_((count_u_ + kSide - 1) / kSide) {
  Tile full;
  full.spans.assign(kTileRays, Span{grid.lo[axis], grid.hi[axis]});
  for (std::uint32_t i = 0; i <= kTileRays; ++i) full.start[i] = i;
  tiles_.assign(tiles_u_ * ((count_v_ + kSide - 1) / kSide), full);
}

const Span* DexelField::begin(std::size_t u, std::size_t v) const {
  const Tile& tile = tiles_[tile_of(u, v)];
  return tile.spans.data() + tile.start[slot(u, v)];
}

const Span* DexelField::end(std::size_t u, std::size_t v) const {
  const Tile& tile = tiles_[tile_of(u, v)];
  return tile.spans.data() + tile.start[slot(u, v) + 1];
}

Ray DexelField::ray(std::size_t u, std::size_t v) const {
  Ray ray{Vec3::Zero(), Vec3::Unit(axis_)};
  const int a = (axis_ + 1) % 3, b = (axis_ + 2) % 3;
  ray.origin[a] = grid_.node(a, std::ptrdiff_t(u));
  ray.origin[b] = grid_.node(b, std::ptrdiff_t(v));
  return ray;
}

// Upright dexels are cut first by the strokes that come lowest at their middle, others by those that lie
// deepest round them: these take most away.
double DexelField::order_key(const ToolSweep& sweep, std::uint32_t stroke, const Box3& box) const {
  Vec3 point = box.center();
  const StrokePose& pose = sweep.strokes()[stroke].middle;
  if (axis_ != 2) {
    point[axis_] = std::clamp(pose.center[axis_], box.lo[axis_], box.hi[axis_]);
    return sweep.depth(stroke, point);
  }
  double entry = kInfinity;
  const Ray upright{{point.x(), point.y(), 0}, Vec3::UnitZ()};
  sweep.visit_spans(
      stroke, sweep.pieces_near(stroke, ~0u, box), upright, box.lo.z(), box.hi.z(), [&](double from, double) {
        entry = std::min(entry, from);
      });
  return entry;
}

void DexelField::cut_tile(std::size_t index, const ToolSweep& sweep, const Context& context) {
  Tile& tile = tiles_[index];
  const std::size_t u0 = index % tiles_u_ * kSide, v0 = index / tiles_u_ * kSide;
  std::array<SpanList, kTileRays> spans;
  std::array<Ray, kTileRays> rays;
  for (std::size_t i = 0; i < kTileRays; ++i) {
    const std::size_t u = u0 + i % kSide, v = v0 + i / kSide;
    rays[i] = ray(u, v);
    // What lies beyond the last node belongs to no dexel.
    if (u < count_u_ && v < count_v_)
      spans[i].assign(tile.spans.data() + tile.start[i], tile.spans.data() + tile.start[i + 1]);
  }
  const auto bounds = [&] {
    Box3 box;
    for (std::size_t i = 0; i < kTileRays; ++i)
      if (!spans[i].empty())
        box.extend(rays[i].at(spans[i].front().from)), box.extend(rays[i].at(spans[i].back().to));
    return box;
  };
  Box3 box = bounds();
  std::vector<std::uint32_t> strokes;
  if (!box.empty()) sweep.strokes_near(box, strokes);
  if (strokes.empty()) return;
  order_strokes([&](std::uint32_t i) { return order_key(sweep, i, box); }, strokes);
  SpanList gaps;
  std::size_t tried = 0;
  for (const std::uint32_t stroke : strokes) {
    if (context.cancelled()) return;
    const std::uint32_t pieces = sweep.pieces_near(stroke, ~0u, box);
    if (pieces == 0) continue;
    for (std::size_t i = 0; i < kTileRays; ++i) cut_dexel(spans[i], rays[i], sweep, stroke, pieces, gaps);
    if (++tried % kStrokesPerBox == 0) box = bounds();
    if (box.empty()) break;
  }
  tile.spans.clear();
  for (std::size_t i = 0; i < kTileRays; ++i) {
    tile.start[i] = std::uint32_t(tile.spans.size());
    tile.spans.insert(tile.spans.end(), spans[i].begin(), spans[i].end());
  }
  tile.start[kTileRays] = std::uint32_t(tile.spans.size());
}

double DexelField::length() const {
  double total = 0;
  for (std::size_t v = 0; v < count_v_; ++v)
    for (std::size_t u = 0; u < count_u_; ++u)
      for (const Span* s = begin(u, v); s != end(u, v); ++s) total += s->to - s->from;
  return total;
}

std::size_t DexelField::bytes() const {
  std::size_t total = 0;
  for (const Tile& tile : tiles_) total += sizeof(Tile) + tile.spans.capacity() * sizeof(Span);
  return total;
}

std::size_t dexel_bytes(const DexelGrid& grid) {
  const auto [x, y, z] = grid.count;
  const double per_dexel = sizeof(Span) + double(sizeof(std::uint32_t)) + 1;
  return std::size_t(per_dexel * (double(x) * double(y) + double(y) * double(z) + double(z) * double(x)));
}

void cut_stock(DexelStock& stock, const ToolSweep& sweep, Context& context) {
  std::vector<std::pair<DexelField*, std::size_t>> tiles;
  for (DexelField& field : stock.fields)
    for (std::size_t i = 0; i < field.tiles(); ++i) tiles.emplace_back(&field, i);
  context.start(tiles.size());
  for_each_range(tiles.size(), 1, context, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) tiles[i].first->cut_tile(tiles[i].second, sweep, context);
  });
}

}  // namespace mpm
