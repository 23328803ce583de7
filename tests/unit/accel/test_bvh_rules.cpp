// How triangles are parted, and what the tree is worth then.
#include <gtest/gtest.h>

#include <cmath>

#include "unit/accel/soup.hpp"

namespace brume {
namespace {

// A leaf takes no more triangles than one block has lanes.
TEST(BinaryBvh, LeavesPartitionTheTriangles) {
  const Soup soup = random_soup(777, 11);
  for (const int leaf_size : {1, 4, 16}) {
    const BinaryBvh tree = bvh_build_binary(boxes_of(soup), leaf_size);
    std::vector<int> seen(soup.size());
    for (const BinaryNode& node : tree.nodes) {
      EXPECT_EQ(node.left < 0, node.right < 0);
      if (node.left >= 0) {
        EXPECT_EQ(tree.nodes.at(node.left).count + tree.nodes.at(node.right).count, node.count);
        continue;
      }
      EXPECT_GE(node.count, 1u);
      EXPECT_LE(node.count, static_cast<unsigned>(leaf_size));
      for (std::uint32_t k = 0; k < node.count; ++k) ++seen.at(tree.order.at(node.first + k));
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<long>(soup.size()));
  }
}

// Two triangles side by side, each in its own box of half of all: the root and two blocks, seen by half of the rays
// each.
TEST(BvhMeasure, CountsNodesAndBlocksByTheRaysThatMeetThem) {
  Soup soup(8, triangle({0, 0, 0}, {1, 1, 1}, {0, 1, 0}));
  for (int i = 0; i < 8; ++i) soup.push_back(triangle({1, 0, 0}, {2, 1, 1}, {1, 1, 0}));
  const BvhMeasure measure = bvh_measure(bvh_build(soup, 8), 0, 8);
  EXPECT_EQ(measure.depth, 1);
  EXPECT_DOUBLE_EQ(measure.sah_cost, 1 + 2 * 0.5 * 3.0 / 5.0);  // areas: 6 of 10
}

// What rules are for: on the same soup the later rows of the table cost less.
TEST(BvhMeasure, OrdersTheRules) {
  const Soup soup = random_soup(5000, 4);
  double cost[BVH_RULES];
  for (int rule = 0; rule < BVH_RULES; ++rule) cost[rule] = bvh_measure(bvh_build(soup, 8, rule), 0, 8).sah_cost;
  EXPECT_GT(cost[BVH_LIST], 300);  // half of its 625 blocks and more
  EXPECT_LT(cost[BVH_MIDPOINT], cost[BVH_LIST] / 5);
  EXPECT_LT(cost[BVH_SAH], cost[BVH_MIDPOINT]);
}

// Two clusters far apart: a builder that looks at areas parts them at the root.
TEST(BinaryBvh, PartsWhatIsFarApart) {
  Soup soup = random_soup(64, 5);
  for (std::size_t i = 0; i < soup.size(); i += 2)
    for (Packed3& p : soup[i].p) p.y += 1000;
  const BinaryBvh tree = bvh_build_binary(boxes_of(soup), 4);
  const BinaryNode &left = tree.nodes.at(tree.nodes.at(0).left), &right = tree.nodes.at(tree.nodes.at(0).right);
  EXPECT_EQ(left.count, 32u);
  EXPECT_EQ(right.count, 32u);
  EXPECT_GT(std::abs(left.lo[1] - right.lo[1]), 900);
}

}  // namespace
}  // namespace brume
