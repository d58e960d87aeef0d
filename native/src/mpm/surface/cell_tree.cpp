#include "mpm/surface/cell_tree.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mpm {
namespace {

constexpr int kMaxSplit = 1024;  // leaves along one side of a patch

using Node = CellTree::Node;

// A rectangle of optional nodes (absent: trimmed away), row-major in u.
struct Level {
  std::size_t nu, nv;
  std::vector<std::optional<Node>> nodes;
};

// Longest control polygons over the patches of one strip decide how often the strip is split.
double strip_length(const BSplineSurface& surface, std::size_t strip, bool along_u) {
  const std::size_t spans_v = surface.breaks_v().size() - 1, spans_u = surface.breaks_u().size() - 1;
  double longest = 0;
  for (std::size_t k = 0; k < (along_u ? spans_v : spans_u); ++k) {
    const BezierPatch& p = surface.patches()[along_u ? strip * spans_v + k : k * spans_v + strip];
    const int rows = along_u ? p.degree_v() : p.degree_u(), steps = along_u ? p.degree_u() : p.degree_v();
    const auto point = [&](int row, int step) -> Vec3 {
      const Vec4& c = along_u ? p.control(step, row) : p.control(row, step);
      return c.head<3>() / c.w();
    };
    for (int row = 0; row <= rows; ++row) {
      double length = 0;
      for (int step = 0; step < steps; ++step) length += (point(row, step + 1) - point(row, step)).norm();
      longest = std::max(longest, length);
    }
  }
  return longest;
}

std::vector<double> split_breaks(const BSplineSurface& surface, bool along_u, double leaf_size) {
  const std::vector<double>& breaks = along_u ? surface.breaks_u() : surface.breaks_v();
  std::vector<double> result{breaks.front()};
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double parts = std::ceil(strip_length(surface, i, along_u) / leaf_size);
    const int n = int(std::clamp(parts, 1.0, double(kMaxSplit)));
    for (int k = 1; k < n; ++k) result.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * k / n);
    result.push_back(breaks[i + 1]);
  }
  return result;
}

Level leaves(const Face& face, std::uint32_t index, double leaf_size) {
  const std::vector<double> us = split_breaks(face.surface, true, leaf_size);
  const std::vector<double> vs = split_breaks(face.surface, false, leaf_size);
  Level level{us.size() - 1, vs.size() - 1, {}};
  level.nodes.resize(level.nu * level.nv);
  for (std::size_t i = 0; i < level.nu; ++i)
    for (std::size_t j = 0; j < level.nv; ++j) {
      const ParamBox box{us[i], us[i + 1], vs[j], vs[j + 1]};
      const TrimRegion::Cover cover = face.trim.cover(box);
      if (cover == TrimRegion::Cover::outside) continue;
      const BezierPatch& patch = face.surface.patch_at(box.u_mid(), box.v_mid());
      const BezierPatch part = patch.restricted(box);
      Node node;
      node.cell = interpolating_cell(part);
      node.box = box;
      node.trimmed = cover == TrimRegion::Cover::crossing;
      node.face = index;
      node.patch = &patch;
      node.third = third_derivative_bound(part);
      level.nodes[i * level.nv + j] = node;
    }
  return level;
}

// A cell over several children: interpolates the surface like a leaf's, its error taken from the children's
// models.
QuadraticCell covering_cell(const BSplineSurface& surface,
                            const ParamBox& box,
                            const std::vector<const Node*>& children) {
  const double us[3] = {box.u0, box.u_mid(), box.u1}, vs[3] = {box.v0, box.v_mid(), box.v1};
  Vec3 s[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) s[i][j] = surface.point(us[i], vs[j]);
  QuadraticCell cell;
  cell.c = s[1][1];
  cell.A = 0.5 * (s[2][1] - s[0][1]);
  cell.B = 0.5 * (s[1][2] - s[1][0]);
  cell.C = 0.5 * (s[2][1] + s[0][1]) - cell.c;
  cell.F = 0.5 * (s[1][2] + s[1][0]) - cell.c;
  cell.E = 0.25 * (s[2][2] - s[2][0] - s[0][2] + s[0][0]);
  const double hu = 0.5 * (box.u1 - box.u0), hv = 0.5 * (box.v1 - box.v0);
  for (const Node* child : children) {
    const ParamBox& b = child->box;
    cell.error = std::max(cell.error,
                          distance_from(child->cell,
                                        cell,
                                        (b.u_mid() - box.u_mid()) / hu,
                                        0.5 * (b.u1 - b.u0) / hu,
                                        (b.v_mid() - box.v_mid()) / hv,
                                        0.5 * (b.v1 - b.v0) / hv));
  }
  cell.set_radius();
  return cell;
}

CellBatch batch_of(const Node* const* nodes, std::size_t count) {
  CellBatch batch;
  for (int lane = 0; lane < kLanes; ++lane)
    put_lane(batch, lane, nodes[std::min(std::size_t(lane), count - 1)]->cell);
  return batch;
}

}  // namespace

CellTree::CellTree(const SurfaceModel& model, double leaf_size, std::size_t max_leaves) : model_(model) {
  double area = 0;
  for (const PatchRef& p : model.patches()) {
    const Vec3 d = p.patch->bounds().hi - p.patch->bounds().lo;
    area += d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
  }
  const double size = std::max(leaf_size, std::sqrt(area / double(max_leaves)));
  for (std::uint32_t f = 0; f < model.faces().size(); ++f) add_face(f, size);
  std::vector<const Node*> all;
  for (const std::uint32_t root : roots_) all.push_back(&nodes_[root]);
  for (std::size_t i = 0; i < all.size(); i += kLanes)
    root_batches_.push_back(batch_of(&all[i], std::min<std::size_t>(kLanes, all.size() - i)));
}

void CellTree::add_face(std::uint32_t face, double leaf_size) {
  const BSplineSurface& surface = model_.faces()[face].surface;
  Level level = leaves(model_.faces()[face], face, leaf_size);
  while (level.nu * level.nv > 1) {
    // Narrow levels are halved in their long direction only.
    const std::size_t su = level.nu * 2 >= level.nv ? 2 : 1, sv = level.nv * 2 >= level.nu ? 2 : 1;
    Level up{(level.nu + su - 1) / su, (level.nv + sv - 1) / sv, {}};
    up.nodes.resize(up.nu * up.nv);
    for (std::size_t i = 0; i < up.nu; ++i)
      for (std::size_t j = 0; j < up.nv; ++j) {
        std::vector<const Node*> children;
        for (std::size_t k = i * su; k < std::min(i * su + su, level.nu); ++k)
          for (std::size_t l = j * sv; l < std::min(j * sv + sv, level.nv); ++l)
            if (level.nodes[k * level.nv + l]) children.push_back(&*level.nodes[k * level.nv + l]);
        if (children.empty()) continue;
        if (children.size() == 1) {
          up.nodes[i * up.nv + j] = *children[0];
          continue;
        }
        Node node;
        node.box = children[0]->box;
        for (const Node* c : children) {
          node.box = {std::min(node.box.u0, c->box.u0),
                      std::max(node.box.u1, c->box.u1),
                      std::min(node.box.v0, c->box.v0),
                      std::max(node.box.v1, c->box.v1)};
          node.trimmed |= c->trimmed;
        }
        node.trimmed |= children.size() < std::min(su, level.nu - i * su) * std::min(sv, level.nv - j * sv);
        node.face = face;
        node.first_child = std::uint32_t(nodes_.size());
        node.children = std::uint8_t(children.size());
        node.cell = covering_cell(surface, node.box, children);
        for (const Node* c : children) nodes_.push_back(*c);
        node.batch = std::uint32_t(batches_.size());
        batches_.push_back(batch_of(children.data(), children.size()));
        up.nodes[i * up.nv + j] = node;
      }
    level = std::move(up);
  }
  if (!level.nodes[0]) return;
  roots_.push_back(std::uint32_t(nodes_.size()));
  nodes_.push_back(*level.nodes[0]);
}

}  // namespace mpm
