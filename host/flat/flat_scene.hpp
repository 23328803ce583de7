// The scene as flat arrays of shared structs: with a RenderPlan the only thing that both kernels and reference see. No
// pointers, no files, nothing that one picture decides: made once, uploaded once.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "flat/bounds.hpp"
#include "shared/bvh.h"
#include "shared/light.h"
#include "shared/material.h"
#include "shared/medium.h"
#include "shared/method.h"
#include "shared/shape.h"

namespace brume {

inline constexpr double FAR_AWAY = 16;  // flat units from the scene's centre, from which on eyes and lights are far

// What plans need to know of a medium.
struct MediumSize {
  std::string place;   // in the scene file, a JSON pointer
  double longest = 0;  // side, flat units
  float densest = 0;   // largest density
};

// A mesh with instances.
struct FlatMesh {
  std::int32_t first, count;  // of FlatScene::triangles
};

struct FlatScene {
  // Lengths are in units of the scene's own size, positions relative to `origin` (both in world units): float is spent
  // on the scene, not on where it stands or how large it is. `unit` is a power of two, so that it rounds nothing;
  // coefficients are per flat unit, intensities that fall off with distance per flat unit squared.
  glm::dvec3 origin{0};
  double unit = 1;
  glm::dvec3 point(const glm::dvec3& world) const { return (world - origin) / unit; }
  glm::dvec3 world(const glm::dvec3& point) const { return point * unit + origin; }
  Bounds bounds;  // of everything finite, in the world; empty where nothing is

  std::size_t world_triangles() const {  // which stand first
    return meshes.empty() ? triangles.size() : static_cast<std::size_t>(meshes.front().first);
  }

  std::vector<Light> light_sources;  // those of the scene file, then surfaces that emit, at one point each
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<float> texels;  // 3 per texel, linear RGB

  std::vector<Shape> shapes;
  std::vector<std::int32_t> shape_list;  // those that every ray tries: all, or all but those behind a BVH
  int shape_root = -1;                   // of the BVH over the others; -1: none
  std::vector<Isosurface> isosurfaces;
  std::vector<uint> iso_masks;      // which cells of a brick each of them may cross
  std::vector<Triangle> triangles;  // in the world, then those of each mesh with instances in its own space
  std::vector<FlatMesh> meshes;     // with instances
  std::vector<Instance> instances;
  int instance_root = -1;  // of the BVH over them; -1: none
  int bvh_width = 4, bvh_rule = BVH_SAH;
  std::vector<float> bvh_nodes;  // layout: shared/bvh.h
  std::vector<float> bvh_blocks;

  std::vector<BrickGrid> grids;
  std::vector<PlacedGrid> placed;  // their densities, of a grid or constant
  std::vector<MediumBody> media;
  std::vector<Liquid> liquids;
  std::vector<GradientBrick> gradient_bricks;  // of their grids, in the order of the stored bricks
  std::vector<MediumSize> sizes;               // one per medium
  std::vector<std::int32_t> bricks;            // entries of all media, layout: shared/medium.h
  std::vector<float> brick_ranges;
  std::vector<float> voxels;  // as given
  bool color_tau = false;     // some medium's sigma_t differs between channels: τ has three

  std::string name;                // of the scene file, for metadata and stats
  std::vector<std::string> notes;  // what a user should be told once (dropped triangles, cleaned texels, ...)
};

}  // namespace brume
