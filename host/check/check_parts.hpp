// The checks behind check_run, and what they share: scenes, inputs, random numbers.
#pragma once
#include "check/check.hpp"
#include "check/probe.hpp"
#include "mesh/mesh.hpp"
#include "scene/scene_desc.hpp"

namespace brume {

class LoadedScene;

// Adds the errors of one device and lane width.
using CheckCompare = std::function<void(Context&, int lanes, ErrorSum&)>;

// One row of the table. `prepare` makes the inputs and what the reference says of them, once for all lane widths.
struct Check {
  std::string name;
  const char* tolerance;  // a row of TOLERANCES
  std::function<CheckCompare(int size)> prepare;
};

std::vector<Check> basic_checks();     // layout, rng, camera, phase, light
std::vector<Check> material_checks();  // material, texture
std::vector<Check> surface_checks();   // hit, occluded, surface
std::vector<Check> medium_checks();    // cells, integral, scatter, storage, density, in_scattering
std::vector<Check> density_checks();   // points
std::vector<Check> image_checks();     // image

// Small scenes with a bit of everything, made here and not read from files: `brume check` works wherever brume is
// installed. What has a row in a family does not depend on being in one of them: row_scenes.hpp.
struct SceneText {
  const char* name;
  const char* text;
};
const std::vector<SceneText>& liquid_scenes();  // part of them
const std::vector<SceneText>& glass_scenes();
const std::vector<SceneText>& instance_scenes();
std::vector<std::string> check_scene_names();
SceneDesc check_scene_desc(const std::string& name);
PlannedScene check_scene(const std::string& name, int size, int bvh_width);

// The meshes that they name, without files.
LoadedScene check_meshes();
Mesh torus_mesh();  // one of them, smooth

// Image textures without a file, added to a scene: 32 x 24 random texels, repeated; and the same, wrapped otherwise, in
// other units. Return the texture's index.
int image_add(PlannedScene& scene);
int image_add_wrapped(PlannedScene& scene, int wrap);

// Random numbers for test inputs; same on every platform.
class CheckRandom {
 public:
  double uniform(double lo, double hi);
  dvec3 in_box(double half);
  dvec3 direction();  // unit, as float rounds it

 private:
  std::uint64_t state_ = 0x853c49e6748fea9bULL;
};

// Inputs and outputs of probes: three floats of a vector.
void push3(std::vector<float>& out, const dvec3& v);
void add3(ErrorSum& sum, const float* kernel, const dvec3& reference);

}  // namespace brume
