#include "mpm/occt/trim_loops.h"

#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>

#include "mpm/base/error.h"

namespace mpm::occt {
namespace {

using Loop = std::vector<Vec2>;

// A segment is halved at most this often; 2^16 sides a curve piece bound the work whatever the tolerance.
constexpr int kMaxHalvings = 16;
// Where on a segment its distance from the curve is looked at: not only the middle, which an S-shape passes
// through.
constexpr double kProbes[] = {0.25, 0.5, 0.75};

// Samples one edge's curve in the parameter plane of the converted surface.
class EdgeSampler {
 public:
  EdgeSampler(const Handle(Geom2d_Curve) & curve, const ConvertedSurface& surface, double chord_mm)
      : curve_(curve), surface_(surface), chord_mm_(chord_mm) {}

  // Appends the points from `first` to `last`, both included.
  void sample(double first, double last, Loop& out) const {
    const std::vector<double> stops = smooth_pieces(first, last);
    out.push_back(at(stops.front()));
    for (std::size_t i = 1; i < stops.size(); ++i) refine(stops[i - 1], stops[i], kMaxHalvings, out);
  }

 private:
  Vec2 at(double t) const {
    const gp_Pnt2d p = curve_->Value(t);
    return {surface_.map_u(p.X()), surface_.map_v(p.Y())};
  }

  std::vector<double> smooth_pieces(double first, double last) const {
    const Geom2dAdaptor_Curve adaptor(curve_, first, last);
    TColStd_Array1OfReal stops(1, adaptor.NbIntervals(GeomAbs_C2) + 1);
    adaptor.Intervals(stops, GeomAbs_C2);
    return {stops.begin(), stops.end()};
  }

  // Appends the points after t0 up to t1.
  void refine(double t0, double t1, int halvings, Loop& out) const {
    const Vec2 a = at(t0), b = at(t1);
    if (halvings == 0 || fits(t0, t1, a, b)) {
      out.push_back(b);
      return;
    }
    const double middle = 0.5 * (t0 + t1);
    refine(t0, middle, halvings - 1, out);
    refine(middle, t1, halvings - 1, out);
  }

  bool fits(double t0, double t1, const Vec2& a, const Vec2& b) const {
    return std::all_of(std::begin(kProbes), std::end(kProbes), [&](double f) {
      return distance_mm(at(t0 + f * (t1 - t0)), a, b) <= chord_mm_;
    });
  }

  // Distance of p from the segment a-b, with the surface's metric at p.
  double distance_mm(const Vec2& p, const Vec2& a, const Vec2& b) const {
    gp_Pnt point;
    gp_Vec su, sv;
    surface_.surface->D1(p.x(), p.y(), point, su, sv);
    const auto to_mm = [&](const Vec2& d) { return su * d.x() + sv * d.y(); };
    const gp_Vec side = to_mm(b - a), offset = to_mm(p - a);
    const double length2 = side.SquareMagnitude();
    const double along = length2 > 0 ? std::clamp(offset.Dot(side) / length2, 0.0, 1.0) : 0.0;
    return (offset - side * along).Magnitude();
  }

  Handle(Geom2d_Curve) curve_;
  const ConvertedSurface& surface_;
  double chord_mm_;
};

int count_edges(const TopoDS_Wire& wire) {
  int count = 0;
  for (TopoDS_Iterator it(wire); it.More(); it.Next())
    count += it.Value().Orientation() == TopAbs_FORWARD || it.Value().Orientation() == TopAbs_REVERSED;
  return count;
}

void append_edge(const TopoDS_Edge& edge,
                 const TopoDS_Face& face,
                 const ConvertedSurface& surface,
                 double chord_mm,
                 Loop& loop) {
  double first = 0, last = 0;
  const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
  require(!curve.IsNull(), "an edge has no curve on the surface");
  require(first < last, "an edge has an empty range of parameters");
  Loop points;
  EdgeSampler(curve, surface, chord_mm).sample(first, last, points);
  if (edge.Orientation() == TopAbs_REVERSED) std::reverse(points.begin(), points.end());
  loop.insert(loop.end(), points.begin(), points.end());
}

Loop sample_wire(const TopoDS_Wire& wire,
                 const TopoDS_Face& face,
                 const ConvertedSurface& surface,
                 double chord_mm) {
  Loop loop;
  int seen = 0;
  for (BRepTools_WireExplorer it(wire, face); it.More(); it.Next(), ++seen)
    append_edge(it.Current(), face, surface, chord_mm, loop);
  require(seen == count_edges(wire), "its boundary is not one closed chain of edges");
  return loop;
}

// The domain with the size of `Precision::Confusion()` mm in each parameter.
struct Domain {
  ParamBox box;
  double slack_u, slack_v;

  explicit Domain(const Handle(Geom_BSplineSurface) & surface) {
    surface->Bounds(box.u0, box.u1, box.v0, box.v1);
    const GeomAdaptor_Surface adaptor(surface);
    slack_u =
        std::min(adaptor.UResolution(Precision::Confusion()), Precision::PConfusion() * (box.u1 - box.u0));
    slack_v =
        std::min(adaptor.VResolution(Precision::Confusion()), Precision::PConfusion() * (box.v1 - box.v0));
  }
};

double snapped(double t, double lo, double hi, double slack) {
  if (std::abs(t - lo) <= slack) return lo;
  if (std::abs(t - hi) <= slack) return hi;
  return std::clamp(t, lo, hi);
}

void tidy(Loop& loop, const Domain& d) {
  for (Vec2& p : loop)
    p = {snapped(p.x(), d.box.u0, d.box.u1, d.slack_u), snapped(p.y(), d.box.v0, d.box.v1, d.slack_v)};
  loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
  while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
}

bool runs_round(const Loop& loop, const ParamBox& d) {
  const auto on_edge = [&](const Vec2& a, const Vec2& b) {
    return (a.x() == b.x() && (a.x() == d.u0 || a.x() == d.u1)) ||
           (a.y() == b.y() && (a.y() == d.v0 || a.y() == d.v1));
  };
  double twice_area = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
    if (!on_edge(a, b)) return false;
    twice_area += a.x() * b.y() - b.x() * a.y();
  }
  return twice_area != 0;
}

}  // namespace

std::vector<std::vector<Vec2>> trim_loops(const TopoDS_Face& face,
                                          const ConvertedSurface& surface,
                                          double chord_mm) {
  require(chord_mm > 0 && std::isfinite(chord_mm), "chord_mm must be positive");
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  const Domain domain(surface.surface);
  std::vector<Loop> loops;
  for (TopoDS_Iterator it(forward); it.More(); it.Next()) {
    if (it.Value().ShapeType() != TopAbs_WIRE) continue;
    Loop loop = sample_wire(TopoDS::Wire(it.Value()), forward, surface, chord_mm);
    tidy(loop, domain);
    require(loop.size() >= 3, "a boundary encloses no area in the parameters of its surface");
    loops.push_back(std::move(loop));
  }
  if (loops.size() == 1 && runs_round(loops.front(), domain.box)) loops.clear();
  return loops;
}

}  // namespace mpm::occt
