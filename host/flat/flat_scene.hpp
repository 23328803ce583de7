// The scene as flat arrays of shared structs: the only thing that both kernels and reference see. No pointers, no files.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "shared/bvh.h"
#include "shared/frame.h"
#include "shared/light.h"
#include "shared/light_grid.h"
#include "shared/material.h"
#include "shared/medium.h"
#include "shared/method.h"
#include "shared/shape.h"

namespace brume {

struct FlatScene {
  // Lengths are in units of the scene's own size, positions relative to `origin` (both in world units): float is spent on the
  // scene, not on where it stands or how large it is. `unit` is a power of two, so that it rounds nothing; coefficients are per
  // flat unit, intensities that fall off with distance per flat unit squared.
  glm::dvec3 origin{0};
  double unit = 1;
  glm::dvec3 point(const glm::dvec3& world) const { return (world - origin) / unit; }
  glm::dvec3 world(const glm::dvec3& point) const { return point * unit + origin; }
  Frame frame{};

  std::vector<Light> lights;
  // Where lights are chosen (frame.light_picks < lights): light l is picked where [l], [l+1] of [0, 1] say; else empty.
  std::vector<float> light_shares;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<float> texels;  // 3 per texel, linear RGB

  std::vector<Shape> shapes;
  std::vector<Triangle> triangles;
  int bvh_width = 4;
  std::vector<float> bvh_nodes;  // layout: shared/bvh.h
  std::vector<std::int32_t> bvh_links;
  std::vector<float> bvh_blocks;
  std::vector<std::int32_t> bvh_ids;

  std::vector<BrickGrid> grids;
  std::vector<PlacedGrid> placed;  // their densities, of a grid or constant
  std::vector<MediumBody> media;
  std::vector<MediumWalk> walks;     // one per medium
  std::vector<std::string> places;   // of media in the scene file, JSON pointers
  std::vector<std::int32_t> bricks;  // entries of all media, layout: shared/medium.h
  std::vector<float> brick_ranges;
  std::vector<float> voxels;  // as stored: rounded where `storage` is not f32
  int storage = STORAGE_F32;
  std::vector<unsigned char> packed;   // the voxels as devices read them; empty for f32
  double storage_error = 0;            // largest |stored - given| over the largest density
  bool color_tau = false;              // some medium's sigma_t differs between channels: τ has three
  unsigned draws = 0;                  // bit DRAWS_x of every method in use
  std::vector<LightGrid> light_grids;  // of each medium that has them, one per light
  std::int64_t light_entries = 0;      // of all light grids together, per channel of τ

  double exposure = 0;
  std::string name;  // of the scene file, for metadata and stats
  // A medium with everything about it.
  Medium medium(std::size_t i) const {
    const PlacedGrid& stands = placed[static_cast<std::size_t>(medium_placed(media[i]))];
    return medium_join(stands.grid < 0 ? BrickGrid{} : grids[static_cast<std::size_t>(stands.grid)], stands, media[i],
                       walks[i]);
  }

  std::vector<std::string> notes;  // what a user should be told once (dropped triangles, cleaned texels, ...)
};

}  // namespace brume
