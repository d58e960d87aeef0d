#include <gtest/gtest.h>

#include <random>

#include "mpm/surface/box_tree.h"

namespace mpm {
namespace {

std::vector<Box3> random_boxes(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution place(-50.0, 50.0), size(0.0, 8.0);
  std::vector<Box3> boxes(n);
  for (Box3& box : boxes) {
    const Vec3 at(place(random), place(random), place(random));
    box.extend(at);
    box.extend(Vec3(at + Vec3(size(random), size(random), size(random))));
  }
  return boxes;
}

std::vector<std::uint32_t> found(const BoxTree& tree, const Box3& query) {
  std::vector<std::uint32_t> result;
  tree.visit(query, [&](std::uint32_t i) { result.push_back(i); });
  return result;
}

TEST(BoxTree, FindsExactlyTheBoxesThatMeet) {
  for (std::size_t n : {1u, 4u, 5u, 200u}) {
    const std::vector<Box3> boxes = random_boxes(n, unsigned(n));
    const BoxTree tree(boxes);
    for (const Box3& query : random_boxes(20, 7)) {
      std::vector<std::uint32_t> expected, actual = found(tree, query);
      for (std::uint32_t i = 0; i < n; ++i)
        if (boxes[i].meets(query)) expected.push_back(i);
      std::sort(actual.begin(), actual.end());
      EXPECT_EQ(actual, expected);
    }
  }
}

TEST(BoxTree, ManyEqualBoxesAreAllFound) {
  Box3 box;
  box.extend(Vec3(1, 2, 3));
  const BoxTree tree(std::vector<Box3>(1000, box));
  EXPECT_EQ(found(tree, box).size(), 1000u);
}

TEST(BoxTree, BoundsAreThoseOfAllBoxes) {
  const std::vector<Box3> boxes = random_boxes(30, 3);
  Box3 all;
  for (const Box3& box : boxes) all.extend(box);
  EXPECT_EQ(BoxTree(boxes).bounds().lo, all.lo);
  EXPECT_EQ(BoxTree(boxes).bounds().hi, all.hi);
}

TEST(BoxTree, EmptyFindsNothing) { EXPECT_TRUE(found(BoxTree(), random_boxes(1, 1)[0]).empty()); }

}  // namespace
}  // namespace mpm
