// The BVH against the layout that shared/bvh.h states: every triangle once, boxes around all that lies below them,
// absent lanes marked, no traversal deeper than the stack. Read lane by lane here, as a kernel would.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/float_bits.hpp"
#include "unit/accel/soup.hpp"

namespace brume {
namespace {

struct Case {
  const char* name;
  std::function<Soup(int count)> make;
};
const Case CASES[] = {
    {"random", [](int n) { return random_soup(n, static_cast<unsigned>(n)); }},
    {"coincident",
     [](int n) {
       return Soup(static_cast<std::size_t>(n), triangle({1, 2, 3}, {2, 2, 3}, {1, 3, 3}));
     }},
    {"points",
     [](int n) {
       return Soup(static_cast<std::size_t>(n), triangle({1, 1, 1}, {1, 1, 1}, {1, 1, 1}));
     }},
    {"needles",  // no area, on one line, overlapping
     [](int n) {
       Soup soup;
       for (int i = 0; i < n; ++i)
         soup.push_back(triangle({float(i), 0, 0}, {float(i) + 2, 0, 0}, {float(i) + 1, 0, 0}));
       return soup;
     }},
    {"flat",  // all in the plane y = 0
     [](int n) {
       Soup soup = random_soup(n, 7);
       for (Triangle& t : soup)
         for (Packed3& p : t.p) p.y = 0;
       return soup;
     }},
    {"doubling",  // each twice as far out as the one before: the splitter peels them off one by one
     [](int n) {
       Soup soup;
       for (int i = 0; i < n; ++i) {
         const float s = std::exp2(static_cast<float>(i % 120) - 60);
         soup.push_back(triangle({s, 0, 0}, {s, s / 8, 0}, {s, 0, s / 8}));
       }
       return soup;
     }},
    {"nested",  // all around the same centre
     [](int n) {
       Soup soup;
       for (int i = 0; i < n; ++i) {
         const float s = 1 + static_cast<float>(i);
         soup.push_back(triangle({-s, -s, 0}, {s, -s, 0}, {0, 2 * s, s}));
       }
       return soup;
     }},
};

struct Box {
  float lo[3], hi[3];
};

// Walks the flat arrays and checks what the layout promises. Nothing here knows how the tree was built.
class Walk {
 public:
  Walk(const FlatBvh& bvh, const Soup& soup, int width) : bvh_(bvh), soup_(soup), width_(width), seen_(soup.size()) {}

  void run() {
    const std::size_t w = width_;
    ASSERT_FALSE(bvh_.nodes.empty());
    ASSERT_EQ(bvh_.nodes.size() % (7 * w), 0u);
    ASSERT_EQ(bvh_.blocks.size() % (10 * w), 0u);
    nodes_.assign(bvh_.nodes.size() / (7 * w), 0);
    blocks_.assign(bvh_.blocks.size() / (10 * w), 0);
    inner(0, 0);
    for (std::size_t i = 0; i < seen_.size(); ++i) EXPECT_EQ(seen_[i], 1) << "triangle " << i;
    for (std::size_t i = 0; i < nodes_.size(); ++i) EXPECT_EQ(nodes_[i], 1) << "node " << i;
    for (std::size_t i = 0; i < blocks_.size(); ++i) EXPECT_EQ(blocks_[i], 1) << "block " << i;
    EXPECT_LE(stack_, BVH_STACK);
  }
  int stack() const { return stack_; }

 private:
  Box box(int node, int lane) const {
    const auto value = [&](int run) { return bvh_.nodes[(std::size_t(node) * 7 + run) * width_ + lane]; };
    return {{value(0), value(1), value(2)}, {value(3), value(4), value(5)}};
  }
  int link_of(int node, int lane) const {
    return float_as_bits(bvh_.nodes[(std::size_t(node) * 7 + 6) * width_ + lane]);
  }

  // Returns the triangles below. `waiting`: entries on the stack while this node is opened. A ray may hit every child;
  // the traversal pushes all of them, then pops one and opens it with the others still there.
  std::vector<int> inner(int node, int waiting) {
    std::vector<int> below;
    EXPECT_LT(static_cast<std::size_t>(node), nodes_.size());
    if (static_cast<std::size_t>(node) >= nodes_.size() || nodes_[node]++ > 0) return below;
    int children = 0;
    for (int lane = 0; lane < width_; ++lane) children += link_of(node, lane) != BVH_ABSENT;
    EXPECT_GE(children, 1);
    stack_ = std::max(stack_, waiting + children);
    for (int lane = 0; lane < width_; ++lane) {
      const int link = link_of(node, lane);
      const Box b = box(node, lane);
      if (link == BVH_ABSENT) {
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_EQ(b.lo[axis], INFINITY);
          EXPECT_EQ(b.hi[axis], -INFINITY);
        }
        continue;
      }
      const std::vector<int> in = link < 0 ? leaf(link) : inner(link, waiting + children - 1);
      EXPECT_FALSE(in.empty());
      for (const int id : in) expect_inside(b, id, node, lane);
      below.insert(below.end(), in.begin(), in.end());
    }
    return below;
  }

  std::vector<int> leaf(int link) {
    std::vector<int> below;
    const int first = (~link) / 16, count = (~link) % 16;
    EXPECT_GE(count, 1);
    EXPECT_LE(count, BVH_LEAF_BLOCKS_MAX);
    const int blocks = static_cast<int>(blocks_.size());
    EXPECT_LE(first + count, blocks);
    if (first + count > blocks) return below;
    for (int block = first; block < first + count; ++block) {
      ++blocks_[block];
      for (int lane = 0; lane < width_; ++lane) {
        const float* const values = &bvh_.blocks[std::size_t(block) * 10 * width_ + lane];
        const int id = float_as_bits(values[9 * width_]);
        EXPECT_GE(id, -1);
        EXPECT_LT(id, static_cast<int>(soup_.size()));
        for (int run = 0; run < 9; ++run) {
          const float value = values[run * width_];
          if (id < 0) {
            EXPECT_EQ(value, 0.0f);
          } else {
            const Packed3& p = soup_[id].p[run / 3];
            EXPECT_EQ(value, run % 3 == 0 ? p.x : run % 3 == 1 ? p.y : p.z);
          }
        }
        if (id < 0) continue;
        ++seen_[id];
        below.push_back(id);
      }
    }
    return below;
  }

  void expect_inside(const Box& b, int id, int node, int lane) const {
    for (const Packed3& p : soup_[id].p) {
      const bool inside =
          b.lo[0] <= p.x && p.x <= b.hi[0] && b.lo[1] <= p.y && p.y <= b.hi[1] && b.lo[2] <= p.z && p.z <= b.hi[2];
      EXPECT_TRUE(inside) << "triangle " << id << " sticks out of lane " << lane << " of node " << node;
    }
  }

  const FlatBvh& bvh_;
  const Soup& soup_;
  int width_, stack_ = 0;
  std::vector<int> seen_, nodes_, blocks_;  // how often each was met
};

class Bvh : public testing::TestWithParam<int> {};

TEST_P(Bvh, HoldsEveryTriangleOnceWithinItsBoxes) {
  for (const Case& c : CASES)
    for (const int count : {1, 2, 5, 200, 2000})
      for (int rule = 0; rule < BVH_RULES; ++rule) {
        SCOPED_TRACE(std::string(c.name) + " " + std::to_string(count) + " by rule " + std::to_string(rule));
        const Soup soup = c.make(count);
        const FlatBvh bvh = bvh_build(soup, GetParam(), rule);
        Walk(bvh, soup, GetParam()).run();
        if (HasFailure()) return;
      }
}

TEST_P(Bvh, IsEmptyWithoutTriangles) {
  const FlatBvh bvh = bvh_build({}, GetParam());
  EXPECT_TRUE(bvh.nodes.empty() && bvh.blocks.empty());
}

// Equal middles, which no rule parts: halved.
TEST_P(Bvh, EndsForAMillionOfTheSame) {
  const Soup soup(1000000, triangle({1, 2, 3}, {2, 2, 3}, {1, 3, 3}));
  for (int rule = 0; rule < BVH_RULES; ++rule) {
    const FlatBvh bvh = bvh_build(soup, GetParam(), rule);
    EXPECT_LE(bvh_measure(bvh, 0, GetParam()).depth, 20);
    const std::vector<int> ids = last_runs(bvh.blocks, 10, GetParam());
    EXPECT_EQ(std::count_if(ids.begin(), ids.end(), [](int id) { return id >= 0; }), 1000000);
  }
}

// Built on several threads.
TEST_P(Bvh, IsTheSameEveryTime) {
  const Soup soup = random_soup(20000, 3);
  const FlatBvh a = bvh_build(soup, GetParam()), b = bvh_build(soup, GetParam());
  EXPECT_TRUE(same_bits(a.nodes, b.nodes));
  EXPECT_TRUE(same_bits(a.blocks, b.blocks));
}

// Two soups, one behind the other: links, ids and the root of the second count from the start of all.
TEST_P(Bvh, StandsBehindAnother) {
  const int w = GetParam();
  Soup soup = random_soup(300, 5);
  const FlatBvh alone = bvh_build(soup, GetParam());
  const Soup more = random_soup(70, 6);
  const FlatBvh other = bvh_build(more, GetParam());
  FlatBvh both = alone;
  soup.insert(soup.end(), more.begin(), more.end());
  const int root = bvh_append(both, soup, 300, GetParam());
  const auto links = [w](const FlatBvh& bvh) { return last_runs(bvh.nodes, 7, w); };
  const auto ids = [w](const FlatBvh& bvh) { return last_runs(bvh.blocks, 10, w); };
  const int blocks = static_cast<int>(ids(alone).size()) / w;
  EXPECT_EQ(root, static_cast<int>(links(alone).size()) / w);
  std::vector<int> expected_links = links(alone), expected_ids = ids(alone);
  for (const int link : links(other))
    expected_links.push_back(link == BVH_ABSENT ? BVH_ABSENT : link < 0 ? ~(~link + 16 * blocks) : link + root);
  for (const int id : ids(other)) expected_ids.push_back(id < 0 ? -1 : id + 300);
  EXPECT_EQ(links(both), expected_links);
  EXPECT_EQ(ids(both), expected_ids);
}

TEST_P(Bvh, HoldsEveryBoxOnce) {
  for (const int count : {1, 2, 5, 2000}) {
    std::vector<BvhBox> boxes;
    for (int i = 0; i < count; ++i) {
      const float x = static_cast<float>(i * 7 % count);
      boxes.push_back({{x, 0, 0}, {x + 1, 1, x}});
    }
    FlatBvh bvh;
    EXPECT_EQ(bvh_append_boxes(bvh, boxes, GetParam()), 0);
    std::vector<int> seen(boxes.size());
    for (const int link : last_runs(bvh.nodes, 7, GetParam()))
      if (link < 0) ++seen.at(static_cast<std::size_t>(~link));
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), count);
  }
}

INSTANTIATE_TEST_SUITE_P(Widths, Bvh, testing::Values(4, 8), testing::PrintToStringParamName());

// A comb: every inner node has one leaf and one inner node, `depth` of them. What bvh_build never makes, bvh_collapse
// must refuse.
BinaryBvh comb(int depth) {
  BinaryBvh tree;
  tree.nodes.resize(std::size_t(2) * depth + 1);
  const auto total = static_cast<std::uint32_t>(depth) + 1;
  for (int level = 0; level <= depth; ++level) {
    const float top = static_cast<float>(total) - static_cast<float>(level);
    BinaryNode& node = tree.nodes[std::size_t(2) * level];
    node = {{0, 0, 0}, {top, top, top}};
    node.first = static_cast<std::uint32_t>(level);
    node.count = total - node.first;
    if (level == depth) break;
    node.left = 2 * level + 1;
    node.right = 2 * level + 2;
    BinaryNode& leaf = tree.nodes[std::size_t(2) * level + 1];
    leaf = {{0, 0, 0}, {0.5f, 0.5f, 0.5f}};
    leaf.first = node.first;
    leaf.count = 1;
  }
  for (std::uint32_t i = 0; i < total; ++i) tree.order.push_back(i);
  return tree;
}

TEST(BvhStack, TheWalkSeesWhatACombNeeds) {
  const Soup soup(31, triangle({0, 0, 0}, {0.5f, 0, 0}, {0, 0.5f, 0}));
  FlatBvh bvh;
  EXPECT_EQ(bvh_collapse(bvh, comb(30), soup, 0, 4), 0);
  Walk walk(bvh, soup, 4);
  walk.run();
  EXPECT_EQ(walk.stack(), 31);  // ten nodes of four children, each with three that wait
}

TEST(BvhStack, ATreeThatNeedsMoreIsRefused) {
  const Soup soup(200, triangle({0, 0, 0}, {0.5f, 0, 0}, {0, 0.5f, 0}));
  for (const int width : {4, 8}) {
    FlatBvh bvh;
    EXPECT_THROW(bvh_collapse(bvh, comb(199), soup, 0, width), std::runtime_error) << width;
  }
}

}  // namespace
}  // namespace brume
