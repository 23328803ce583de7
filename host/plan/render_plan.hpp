// What one picture of a FlatScene decides: size, crop and samples, seed, method and step of each medium, how light
// reaches it, how voxels are stored. Another plan of the same scene reads no file and uploads no geometry.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "flat/flat_scene.hpp"
#include "plan/piece_errors.hpp"
#include "scene/scene_desc.hpp"
#include "shared/frame.h"
#include "shared/light_grid.h"

namespace brume {

// Voxels in fewer bytes, as devices read them.
struct StoredVoxels {
  std::vector<unsigned char> packed;
  std::vector<float> ranges;  // FlatScene::brick_ranges, rounded as the voxels are
  double error = 0;           // largest |stored - given| over the largest density
};

struct RenderPlan {
  Frame frame{};
  std::vector<Light> lights;  // what a point may ask: the sources, each surface that emits once for each of its points
  // Where lights are chosen, light l is picked from [l] up to [l + 1] of [0, 1].
  std::vector<float> light_shares;
  std::vector<MediumWalk> walks;       // one per medium
  unsigned draws = 0;                  // bit DRAWS_x of every method in use
  std::vector<float> piece_rates;      // of `adaptive`, PIECE_ROW for every stored brick
  std::vector<LightGrid> light_grids;  // of each medium that has them, one per light
  std::int64_t light_entries = 0;      // of all light grids together, per channel of τ
  int storage = STORAGE_F32;
  std::shared_ptr<const StoredVoxels> stored;  // where they are packed already; null: not yet, or f32
  std::vector<std::string> plan_notes;         // what a user should be told of it
};

// Whether a light has an area, so that each ray asks other places of it.
bool plan_lights_extend(const RenderPlan& plan);

struct PlanOptions {
  std::array<int, 4> crop{0, 0, 0, 0};  // x0, y0, x1, y1 in pixels; empty: the whole film
  bool hide_background = false;         // from the camera; mirrors and glass go on seeing it
  PieceErrors* piece_errors = nullptr;  // of the scene, kept from plan to plan; null: measured where they are needed
};

// `desc` may differ from that of the flat scene in its camera, film and "render", and in "method" and "step" of media.
// Throws InputError for a plan that does not fit, naming the place; also where a constant density would need voxels
// that the flat scene does not have, or the other way round.
RenderPlan plan_render(const SceneDesc& desc, const FlatScene& flat, const PlanOptions& options);

// All voxels as `storage` (not f32) holds them; `voxels`, those of the flat scene, become the values that devices see.
StoredVoxels voxels_store(const FlatScene& flat, int storage, std::vector<float>& voxels);

// A medium with everything about it.
Medium medium_of(const FlatScene& flat, const MediumWalk& walk, std::size_t medium);

// A scene with its only plan. Its voxels and ranges are those that devices see, rounded where the storage is not f32:
// what the reference renders.
struct PlannedScene : FlatScene, RenderPlan {
  Medium medium(std::size_t i) const { return medium_of(*this, walks[i], i); }
  std::vector<std::string> all_notes() const {
    std::vector<std::string> all = notes;
    all.insert(all.end(), plan_notes.begin(), plan_notes.end());
    return all;
  }
};

}  // namespace brume
