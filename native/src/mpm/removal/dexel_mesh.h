// The stock's surface as triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/removal/dexel_stock.h"

namespace mpm {

struct TriangleMesh {
  std::vector<Vec3> vertices;                           // mm, set-up frame
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside
};

// Surface nets (Gibson 1998) on the dexels' crossings: in every cell of eight nodes that the surface passes
// stands one vertex, the mean of the points where the surface crosses the cell's edges, known from the
// dexels; every crossed edge between two nodes gives a quadrilateral of the cells round it. The mesh is
// closed. Edges are chamfered over a cell, and walls thinner than a cell may be missed.
TriangleMesh stock_mesh(const DexelStock& stock);

}  // namespace mpm
