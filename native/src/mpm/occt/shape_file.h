// STEP, IGES and BREP files.
#pragma once

#include <TopoDS_Shape.hxx>
#include <string>

namespace mpm::occt {

// Reads a part, converted to mm. The format is told by the file's first bytes, not by its ending. A BREP file
// has no unit: it is taken to be in mm.
//
// Fails, as all that follow: std::invalid_argument that names the file and what is wrong.
// Threads: any; calls wait for each other, those of all three functions (the exchange library has global
//   state).
TopoDS_Shape read_shape(const std::string& path);

// The text of a BREP file, such as FreeCAD's Shape.exportBrepToString gives.
TopoDS_Shape read_brep_text(const std::string& text);

// Writes STEP (AP214, mm) with a fixed time stamp, so that equal shapes give equal bytes. `name`: of the
// product.
void write_step(const TopoDS_Shape& shape, const std::string& path, const std::string& name);

}  // namespace mpm::occt
