#include <gtest/gtest.h>

#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <Geom2d_Line.hxx>
#include <GeomConvert.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Precision.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <gp_Elips.hxx>
#include <random>

#include "mpm/occt/conversion.h"
#include "mpm/occt/face_arrays.h"
#include "mpm/surface/bspline_surface.h"
#include "mpm/surface/trim_region.h"

namespace mpm::occt {
namespace {

constexpr double kChord_mm = 0.01;
// Two evaluations of the same rational surface, relative to its size.
constexpr double kRounding = 1e-12;

struct Sample {
  TopoDS_Face face;
  FaceArrays arrays;
  BSplineSurface surface;
  TrimRegion trim;
  ConvertedSurface converted;
  double size;
};

Sample sample_of(const TopoDS_Face& face) {
  const FaceArrays a = face_arrays(face, "Face1", kChord_mm);
  const BSplineSurface surface(a.degree_u, a.degree_v, a.knots_u, a.knots_v, a.poles, a.weights);
  Box3 box;
  for (const Vec3& p : a.poles) box.extend(p);
  return {face, a, surface, TrimRegion(a.trim_loops), to_bspline(face), box.diagonal()};
}

// A placement that no coordinate plane survives.
TopoDS_Shape placed(const TopoDS_Shape& shape) {
  gp_Trsf turn, move;
  turn.SetRotation(gp_Ax1(gp_Pnt(1, 2, 3), gp_Dir(1, 2, -1)), 0.7);
  move.SetTranslation(gp_Vec(100, -50, 25));
  return shape.Moved(TopLoc_Location(move * turn));
}

Vec3 to_vec(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }

// Random parameters of the face's own surface, in its UV box.
class Parameters {
 public:
  explicit Parameters(const TopoDS_Face& face) {
    BRepTools::UVBounds(face, box_.u0, box_.u1, box_.v0, box_.v1);
  }
  gp_Pnt2d next() {
    return {box_.u0 + fraction_(random_) * (box_.u1 - box_.u0),
            box_.v0 + fraction_(random_) * (box_.v1 - box_.v0)};
  }
  const ParamBox& box() const { return box_; }

 private:
  ParamBox box_;
  std::mt19937 random_{1};
  std::uniform_real_distribution<double> fraction_{0.0, 1.0};
};

// Our evaluation at the mapped parameters is the kernel's evaluation of the original, analytic surface.
void expect_same_surface(const Sample& s) {
  const BRepAdaptor_Surface original(s.face);
  Parameters parameters(s.face);
  for (int i = 0; i < 200; ++i) {
    const gp_Pnt2d p = parameters.next();
    const Vec3 ours = s.surface.point(s.converted.map_u(p.X()), s.converted.map_v(p.Y()));
    ASSERT_LE((ours - to_vec(original.Value(p.X(), p.Y()))).norm(),
              s.arrays.deviation_mm + kRounding * s.size)
        << s.arrays.kind << " at " << p.X() << ", " << p.Y();
  }
}

// Is the original face's boundary within two chord tolerances of `at`? Then either answer is right.
bool near_boundary(const BRepTopAdaptor_FClass2d& kernel,
                   const BRepAdaptor_Surface& surface,
                   const gp_Pnt2d& at) {
  const double du = surface.UResolution(2 * kChord_mm), dv = surface.VResolution(2 * kChord_mm);
  const TopAbs_State here = kernel.Perform(at, false);
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      if (kernel.Perform(gp_Pnt2d(at.X() + i * du, at.Y() + j * dv), false) != here) return true;
  return false;
}

// Returns how many points were compared.
int expect_same_trim(const Sample& s) {
  const BRepAdaptor_Surface original(s.face);
  const BRepTopAdaptor_FClass2d kernel(s.face, Precision::PConfusion());
  Parameters parameters(s.face);
  int compared = 0;
  for (int i = 0; i < 2000; ++i) {
    const gp_Pnt2d p = parameters.next();
    if (near_boundary(kernel, original, p)) continue;
    const bool inside = kernel.Perform(p, false) == TopAbs_IN;
    EXPECT_EQ(s.trim.contains(s.converted.map_u(p.X()), s.converted.map_v(p.Y())), inside)
        << s.arrays.kind << " at " << p.X() << ", " << p.Y();
    ++compared;
  }
  return compared;
}

void expect_faithful(const TopoDS_Shape& shape) {
  for (const TopoDS_Face& face : faces_in_order(shape)) {
    const Sample s = sample_of(face);
    expect_same_surface(s);
    EXPECT_GT(expect_same_trim(s), 1000) << s.arrays.kind;
  }
}

std::vector<std::string> kinds(const TopoDS_Shape& shape) {
  std::vector<std::string> result;
  for (const FaceArrays& face : face_arrays(shape, kChord_mm)) result.push_back(face.kind);
  return result;
}

TEST(FaceArrays, Box) {
  const TopoDS_Shape box = placed(BRepPrimAPI_MakeBox(20, 30, 40).Shape());
  EXPECT_EQ(kinds(box), std::vector<std::string>(6, "plane"));
  expect_faithful(box);
  for (const FaceArrays& face : face_arrays(box, kChord_mm)) EXPECT_TRUE(face.trim_loops.empty());
}

TEST(FaceArrays, NamesFollowTheKernelsOrderAndSharedFacesCountOnce) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(20, 30, 40).Shape();
  const std::vector<FaceArrays> faces = face_arrays(box, kChord_mm);
  ASSERT_EQ(faces.size(), 6u);
  EXPECT_EQ(faces.front().name, "Face1");
  EXPECT_EQ(faces.back().name, "Face6");
}

TEST(FaceArrays, FullCylinder) { expect_faithful(placed(BRepPrimAPI_MakeCylinder(7, 20).Shape())); }
TEST(FaceArrays, PartOfACylinder) { expect_faithful(placed(BRepPrimAPI_MakeCylinder(7, 20, 4.0).Shape())); }
TEST(FaceArrays, ConeWithItsApex) { expect_faithful(placed(BRepPrimAPI_MakeCone(9, 0, 12).Shape())); }
TEST(FaceArrays, Frustum) { expect_faithful(placed(BRepPrimAPI_MakeCone(9, 4, 12, 2.0).Shape())); }
TEST(FaceArrays, WholeSphere) { expect_faithful(placed(BRepPrimAPI_MakeSphere(15).Shape())); }
TEST(FaceArrays, PartOfASphere) {
  expect_faithful(placed(BRepPrimAPI_MakeSphere(15, -0.4, 1.1, 2.5).Shape()));
}
TEST(FaceArrays, WholeTorus) { expect_faithful(placed(BRepPrimAPI_MakeTorus(20, 6).Shape())); }
TEST(FaceArrays, PartOfATorus) {  // only the torus: the kernel's own end faces of it are broken
  expect_faithful(placed(faces_in_order(BRepPrimAPI_MakeTorus(20, 6, 0.3, 2.9, 2.0).Shape())[0]));
}

TEST(FaceArrays, UntrimmedAnalyticFacesHaveNoLoop) {
  for (const TopoDS_Shape& shape : {BRepPrimAPI_MakeSphere(15).Shape(), BRepPrimAPI_MakeTorus(20, 6).Shape()})
    EXPECT_TRUE(face_arrays(shape, kChord_mm)[0].trim_loops.empty());
}

TEST(FaceArrays, CylinderWallWithHolesAcrossItsSeam) {
  const TopoDS_Shape pipe = BRepPrimAPI_MakeCylinder(20, 60).Shape();
  const gp_Ax2 across(gp_Pnt(-50, 0, 30), gp_Dir(1, 0, 0));  // leaves through the seam at angle 0
  expect_faithful(placed(BRepAlgoAPI_Cut(pipe, BRepPrimAPI_MakeCylinder(across, 8, 100).Shape()).Shape()));
}

TEST(FaceArrays, SphereAndTorusCutByOtherSolids) {
  const TopoDS_Shape drill =
      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(12, 3, -50), gp_Dir(0, 0, 1)), 5, 100).Shape();
  expect_faithful(placed(BRepAlgoAPI_Cut(BRepPrimAPI_MakeSphere(20).Shape(), drill).Shape()));
  expect_faithful(placed(BRepAlgoAPI_Cut(BRepPrimAPI_MakeTorus(15, 6).Shape(), drill).Shape()));
}

TEST(FaceArrays, SweptAndRevolvedEllipse) {
  const gp_Elips ellipse(gp_Ax2(gp_Pnt(30, 0, 0), gp_Dir(0, 1, 0)), 9, 4);
  const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(ellipse, 0.3, 4.0);
  const TopoDS_Shape swept = BRepPrimAPI_MakePrism(edge, gp_Vec(3, 25, 1)).Shape();
  const TopoDS_Shape revolved = BRepPrimAPI_MakeRevol(edge, gp::OZ(), 2.2).Shape();
  EXPECT_EQ(kinds(swept), std::vector<std::string>{"extrusion"});
  EXPECT_EQ(kinds(revolved), std::vector<std::string>{"revolution"});
  expect_faithful(placed(swept));
  expect_faithful(placed(revolved));
}

TEST(FaceArrays, MirroredPlacement) {
  gp_Trsf mirror;
  mirror.SetMirror(gp_Ax2(gp_Pnt(5, 0, 0), gp_Dir(1, 1, 0)));
  for (const TopoDS_Shape& shape :
       {BRepPrimAPI_MakeCone(9, 4, 12, 2.0).Shape(), BRepPrimAPI_MakeTorus(20, 6).Shape()})
    expect_faithful(BRepBuilderAPI_Transform(shape, mirror, true).Shape());
}

Handle(Geom_BezierSurface) bezier(int degree_u, int degree_v) {
  TColgp_Array2OfPnt poles(1, degree_u + 1, 1, degree_v + 1);
  for (int i = 0; i <= degree_u; ++i)
    for (int j = 0; j <= degree_v; ++j)
      poles(i + 1, j + 1) = gp_Pnt(100.0 * i / degree_u, 80.0 * j / degree_v, 10 * std::sin(2.0 * i + j));
  return new Geom_BezierSurface(poles);
}

TopoDS_Face face_on(const Handle(Geom_Surface) & surface) {
  return BRepBuilderAPI_MakeFace(surface, Precision::Confusion());
}

TEST(FaceArrays, BezierKeepsItsPoles) {
  const FaceArrays a = face_arrays(face_on(bezier(3, 5)), "Face1", kChord_mm);
  EXPECT_EQ(a.kind, "bezier");
  EXPECT_EQ(a.poles_u, 4u);
  EXPECT_EQ(a.poles_v, 6u);
  EXPECT_EQ(a.knots_v, (std::vector<double>{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(a.poles[7], Vec3(100.0 / 3, 16, 10 * std::sin(3.0)));
  EXPECT_TRUE(a.weights.empty());
  EXPECT_EQ(a.deviation_mm, 0.0);
}

TEST(FaceArrays, DegreeOverTenIsApproximatedAndSaysSo) {
  const Sample s = sample_of(face_on(bezier(12, 3)));
  EXPECT_LE(s.arrays.degree_u, 10);
  EXPECT_GT(s.arrays.deviation_mm, 0.0);
  EXPECT_LE(s.arrays.deviation_mm, 1e-3);
  expect_same_surface(s);
}

TEST(FaceArrays, OffsetIsApproximatedAndSaysSo) {
  const Sample s = sample_of(face_on(new Geom_OffsetSurface(bezier(3, 3), 2.5)));
  EXPECT_EQ(s.arrays.kind, "offset");
  EXPECT_GT(s.arrays.deviation_mm, 0.0);
  EXPECT_LE(s.arrays.deviation_mm, 1e-3);
  expect_same_surface(s);
}

// A closed tube as a periodic B-spline: a face of it that crosses the seam, and one that does not.
TEST(FaceArrays, PeriodicBSplineIsOpenedWhereTheFaceLies) {
  const TopoDS_Face wall = faces_in_order(BRepPrimAPI_MakeCylinder(7, 20).Shape())[0];
  const Handle(Geom_BSplineSurface) tube = to_bspline(wall).surface;
  tube->SetUPeriodic();
  ASSERT_TRUE(tube->IsUPeriodic());
  for (const auto& [first, last] : {std::pair(1.0, 3.0), std::pair(5.0, 8.0), std::pair(-1.0, 1.0)}) {
    const TopoDS_Face part = BRepBuilderAPI_MakeFace(tube, first, last, 2, 15, Precision::Confusion());
    const Sample s = sample_of(part);
    EXPECT_LE(s.surface.domain().u0, Parameters(part).box().u0 + Precision::PConfusion());
    EXPECT_GE(s.surface.domain().u1, Parameters(part).box().u1 - Precision::PConfusion());
    expect_same_surface(s);
    EXPECT_GT(expect_same_trim(s), 1000);
  }
}

TEST(FaceArrays, FreeFormFaceWithAHole) {
  const TopoDS_Shape solid = BRepPrimAPI_MakePrism(face_on(bezier(4, 3)), gp_Vec(0, 0, -50)).Shape();
  const TopoDS_Shape drill =
      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(45, 40, -100), gp_Dir(0, 0, 1)), 12, 200).Shape();
  expect_faithful(placed(BRepAlgoAPI_Cut(solid, drill).Shape()));
}

TEST(FaceArrays, TrimLoopsKeepTheirChordTolerance) {
  const TopoDS_Face disc = faces_in_order(BRepPrimAPI_MakeCylinder(50, 5).Shape())[1];
  for (double chord_mm : {1.0, 0.1, 0.001}) {
    const FaceArrays a = face_arrays(disc, "Face2", chord_mm);
    ASSERT_EQ(a.trim_loops.size(), 1u);
    const BSplineSurface s(a.degree_u, a.degree_v, a.knots_u, a.knots_v, a.poles, a.weights);
    const std::vector<Vec2>& loop = a.trim_loops[0];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 middle = 0.5 * (loop[i] + loop[(i + 1) % loop.size()]);
      EXPECT_LE(50 - s.point(middle.x(), middle.y()).head<2>().norm(), chord_mm);
    }
  }
}

TEST(FaceArrays, SurfaceGoesThereAndBack) {
  const Handle(Geom_BSplineSurface) surface = GeomConvert::SurfaceToBSplineSurface(bezier(3, 5));
  surface->InsertUKnot(0.25, 2, 0.0);
  const FaceArrays a = face_arrays(face_on(surface), "Face1", kChord_mm);
  const Handle(Geom_BSplineSurface) back = make_surface(a);
  EXPECT_LE(back->Value(0.3, 0.6).Distance(surface->Value(0.3, 0.6)), 1e-12);
}

// A circle round a cylinder is closed in space but only a line in its parameters: without a seam it bounds
// nothing.
TEST(FaceArrays, BoundaryThatEnclosesNothingIsRefused) {
  const Handle(Geom_CylindricalSurface) cylinder = new Geom_CylindricalSurface(gp_Ax3(), 7);
  const Handle(Geom2d_Line) level = new Geom2d_Line(gp_Pnt2d(0, 3), gp_Dir2d(1, 0));
  TopoDS_Edge circle = BRepBuilderAPI_MakeEdge(level, cylinder, 0, 2 * kPi);
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(cylinder, BRepBuilderAPI_MakeWire(circle));
  EXPECT_THROW(face_arrays(face, "Face1", kChord_mm), std::invalid_argument);
}

TEST(FaceArrays, ShapeWithoutFaceIsRefused) {
  EXPECT_THROW(face_arrays(TopoDS_Shape(), kChord_mm), std::invalid_argument);
  EXPECT_THROW(face_arrays(BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(1, 0, 0)).Shape(), kChord_mm),
               std::invalid_argument);
}

}  // namespace
}  // namespace mpm::occt
