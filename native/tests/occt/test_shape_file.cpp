#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepTools.hxx>
#include <BinTools.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "mpm/occt/face_arrays.h"
#include "mpm/occt/shape_file.h"
#include "mpm/surface/surface_model.h"

namespace mpm::occt {
namespace {

using ::testing::HasSubstr;

// A folder of its own that is removed at the end.
class ShapeFile : public ::testing::Test {
 protected:
  ShapeFile() { std::filesystem::create_directories(folder_); }
  ~ShapeFile() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write_text(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
  }

  std::string read_text(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path(name)).rdbuf();
    return text.str();
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) / ("mpm_shape_file_" + std::to_string(::getpid()));
};

TopoDS_Shape box() { return BRepPrimAPI_MakeBox(gp_Pnt(1, 2, 3), 20, 30, 40).Shape(); }

Box3 bounds(const TopoDS_Shape& shape) {
  std::vector<Face> faces;
  for (const FaceArrays& a : face_arrays(shape, 0.01))
    faces.push_back({a.name,
                     BSplineSurface(a.degree_u, a.degree_v, a.knots_u, a.knots_v, a.poles, a.weights),
                     TrimRegion(a.trim_loops),
                     false});
  return SurfaceModel(std::move(faces)).machined_bounds();
}

// IGES keeps nine digits or so.
constexpr double kDigits_mm = 1e-6;

void expect_the_box(const TopoDS_Shape& shape, double scale = 1.0) {
  EXPECT_EQ(faces_in_order(shape).size(), 6u);
  EXPECT_LE((bounds(shape).lo / scale - Vec3(1, 2, 3)).norm(), kDigits_mm);
  EXPECT_LE((bounds(shape).hi / scale - Vec3(21, 32, 43)).norm(), kDigits_mm);
}

std::string message_of(const std::string& path) {
  try {
    read_shape(path);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "accepted";
}

TEST_F(ShapeFile, StepGoesThereAndBack) {
  write_step(box(), path("box.step"), "box");
  expect_the_box(read_shape(path("box.step")));
}

TEST_F(ShapeFile, StepInMetresBecomesMillimetres) {
  write_step(box(), path("mm.step"), "box");
  std::string text = read_text("mm.step");
  const std::string unit = "SI_UNIT(.MILLI.,.METRE.)";
  ASSERT_NE(text.find(unit), std::string::npos);
  write_text("metres.step", text.replace(text.find(unit), unit.size(), "SI_UNIT($,.METRE.)"));
  expect_the_box(read_shape(path("metres.step")), 1000.0);
}

TEST_F(ShapeFile, IgesInInchesBecomesMillimetres) {
  IGESControl_Controller::Init();
  IGESControl_Writer writer("INCH", 1);
  writer.AddShape(box());
  writer.ComputeModel();
  writer.Write(path("inch.igs").c_str());
  expect_the_box(read_shape(path("inch.igs")));
}

TEST_F(ShapeFile, BrepAsTextAndBinary) {
  BRepTools::Write(box(), path("box.brep").c_str());
  BinTools::Write(box(), path("binary.brep").c_str());
  expect_the_box(read_shape(path("box.brep")));
  expect_the_box(read_shape(path("binary.brep")));
}

TEST_F(ShapeFile, BrepText) {
  std::ostringstream text;
  BRepTools::Write(box(), text);
  expect_the_box(read_brep_text(text.str()));
  EXPECT_THROW(read_brep_text("nothing of the kind"), std::invalid_argument);
  EXPECT_THROW(read_brep_text(""), std::invalid_argument);
}

TEST_F(ShapeFile, ContentDecidesNotTheEnding) {
  write_step(box(), path("box.brep"), "box");
  expect_the_box(read_shape(path("box.brep")));
}

TEST_F(ShapeFile, EqualShapesGiveEqualBytes) {
  write_step(box(), path("one.step"), "box");
  write_step(box(), path("two.step"), "box");
  const bool equal = read_text("one.step") == read_text("two.step");
  EXPECT_TRUE(equal);
}

TEST_F(ShapeFile, BadFilesAreNamed) {
  write_text("empty.step", "");
  write_text("prose.step", "Once upon a time there was a surface.");
  write_text("cut.step", "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((");
  write_text("cut.brep", "DBRep_DrawableShape\n\nCASCADE Topology V1, (c) Matra-Datavision\nLocations 3\n");
  EXPECT_THAT(message_of(path("missing.step")), HasSubstr("missing.step: cannot be opened"));
  EXPECT_THAT(message_of(path("empty.step")), HasSubstr("empty.step: is empty"));
  EXPECT_THAT(message_of(path("prose.step")), HasSubstr("prose.step: is not a STEP, IGES or BREP file"));
  EXPECT_THAT(message_of(path("cut.step")), HasSubstr("cut.step: "));
  EXPECT_THAT(message_of(path("cut.brep")), HasSubstr("cut.brep: "));
  EXPECT_THROW(write_step(box(), path("no/such/folder.step"), "box"), std::invalid_argument);
}

TEST_F(ShapeFile, ThreadsMayReadAtTheSameTime) {
  write_step(box(), path("box.step"), "box");
  std::vector<std::thread> threads;
  std::atomic<int> faces = 0;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] { faces += int(faces_in_order(read_shape(path("box.step"))).size()); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(faces, 24);
}

}  // namespace
}  // namespace mpm::occt
