// A scene as its file states it: plain structs in double, in the file's units, before any loading of volumes, meshes or
// images. Every field's default is the default of its key. Keys, meanings and ranges: scenes/README.md.
#pragma once
#include <array>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "shared/bvh.h"
#include "shared/camera.h"
#include "shared/frame.h"
#include "shared/light.h"
#include "shared/material.h"
#include "shared/method.h"
#include "shared/phase.h"
#include "shared/transfer.h"

namespace brume {

using glm::dvec2;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;

struct CameraDesc {
  int type = CAMERA_PERSPECTIVE;
  dvec3 eye{0, 0, 5}, target{0, 0, 0}, up{0, 1, 0};
  double vfov = 40;   // perspective: degrees, in (0, 180)
  double height = 2;  // orthographic: world units, > 0
};

struct FilmDesc {
  ivec2 size{512, 512};
  int spp = 1;
  double exposure = 0;
  int transfer = TRANSFER_GAMMA;
};

struct LightDesc {
  int type = LIGHT_POINT;
  dvec3 position{0}, direction{0, -1, 0};
  dvec3 intensity{1};  // `irradiance` for directional
  int falloff = FALLOFF_INVERSE_SQUARE;
  double angle = 30;      // spot: half-angle of the cone, degrees, in (0, 90)
  double softness = 0.1;  // spot: share of the angle over which the edge fades, in [0, 1]
};

struct TextureDesc {
  int type = TEXTURE_IMAGE;
  std::filesystem::path file;  // image; already resolved against the scene file
  int wrap = WRAP_REPEAT;      // image
  std::array<dvec3, 2> colors{dvec3(1), dvec3(0)};
  double scale = 1;
};

struct MaterialDesc {
  std::string name;
  int model = MATERIAL_LAMBERT;
  dvec3 ambient{0}, diffuse{0.5}, specular{0}, emission{0};
  double shininess = 50, reflection = 0, refraction = 0, ior = 1.5;
  bool is_light = true;  // where it emits: a light to all else
  bool fresnel = false;  // shares the weights of both rays out between them
  dvec3 absorption{0};   // per world unit, inside a shape that refracts
  std::optional<TextureDesc> texture;
};

// Transform steps are applied in the order in which they are written.
struct Scale {
  dvec3 factor;
};
struct Rotate {
  dvec3 axis;
  double degrees;
};
struct Translate {
  dvec3 offset;
};
using TransformDesc = std::vector<std::variant<Scale, Rotate, Translate>>;

// `material` is an index into SceneDesc::materials, or -1 where the scene names none (a mesh then takes those of its
// MTL).
struct SphereDesc {
  dvec3 center{0};
  double radius = 1;
};
struct CylinderDesc {
  dvec3 base{0}, top{0, 1, 0};
  double radius = 1;
};
struct PlaneDesc {
  dvec3 point{0}, normal{0, 1, 0};
};
struct QuadDesc {
  dvec3 corner{0}, u{1, 0, 0}, v{0, 1, 0};
};
struct BoxDesc {
  dvec3 min{-1}, max{1};
  TransformDesc transform;
};
struct TriangleDesc {
  std::array<dvec3, 3> vertices;
};
enum class MeshShading { FLAT, PHONG, GOURAUD };
struct MeshDesc {
  std::filesystem::path file;
  MeshShading shading = MeshShading::PHONG;
  std::optional<double> crease;  // degrees, in [0, 180]: sharper edges are not smoothed
  TransformDesc transform;
  // Where it stands, each applied after `transform`: written in the scene or in a file, not in both. None: once.
  std::vector<TransformDesc> instances;
  std::filesystem::path instance_file;
};

struct DensityDesc;
struct IsosurfaceDesc {
  std::shared_ptr<DensityDesc> density;  // never null once it is read
  double iso = 0.5;
  std::optional<std::array<dvec3, 2>> bounds;  // as of a medium
  TransformDesc transform;
};

struct ShapeDesc {
  std::variant<SphereDesc, CylinderDesc, PlaneDesc, QuadDesc, BoxDesc, IsosurfaceDesc, TriangleDesc, MeshDesc> geometry;
  int material = -1;
  std::string place;  // JSON pointer, for messages of later stages
};

enum LevelSetRule { LEVEL_SET_REFUSE, LEVEL_SET_FILL };
enum NegativeRule { NEGATIVE_REFUSE, NEGATIVE_CLAMP };

// What the values of a liquid's grid may be: its presence, in [0, 1]. ROW(ID, name, help)
#define BRUME_PRESENCE_RULES(ROW)                                              \
  ROW(REFUSE, "refuse", "values beyond 1 are refused, with the largest found") \
  ROW(SCALE, "scale", "all are divided by the largest where that is beyond 1") \
  ROW(CLAMP, "clamp", "values beyond 1 become 1")
enum PresenceRule {
#define ROW(id, name, help) PRESENCE_##id,
  BRUME_PRESENCE_RULES(ROW)
#undef ROW
      PRESENCE_COUNT
};

// Where densities come from. The tables of generators and formats are in host/volume.
struct DensityDesc {
  std::string type = "constant";  // constant, linear, exponential, perlin, sphere, ball, file
  ivec3 resolution{64};
  double value = 1;  // constant
  double scale = 4;  // perlin: lattice cells along the longest side
  int octaves = 4;
  int seed = 1;
  double radius = 0.75;              // ball: share of half the bounds
  double ramp = 2;                   // ball: voxels over which it rises from 0 to 1
  std::filesystem::path file;        // file; already resolved
  std::string grid;                  // file: name of the grid, empty = the one that is meant if there is no choice
  int level_set = LEVEL_SET_REFUSE;  // file, and all down to `of`: how values become densities, in this order
  std::optional<double> threshold;   // values below it are 0
  std::vector<dvec2> remap;          // (value, density), value ascending
  double factor = 1;                 // `scale`
  int negative = NEGATIVE_CLAMP;
  std::shared_ptr<DensityDesc> of;  // sphere: what is cut
  std::optional<int> presence;      // of a liquid: the rule for values beyond 1
};

// What a medium is. ROW(ID, name, help)
#define BRUME_MEDIUM_TYPES(ROW)                                      \
  ROW(PARTICIPATING, "participating", "absorbs, scatters and glows") \
  ROW(LIQUID, "liquid", "its density is the presence of a liquid, in [0, 1]")
// How a liquid is shown. ROW(ID, name, help)
#define BRUME_LIQUID_MODELS(ROW)                                                                   \
  ROW(LOCAL_LIGHTING, "local_lighting", "lit where its presence changes, absorbing inside: quick") \
  ROW(SURFACE, "surface", "a surface of one presence that reflects and refracts")
enum MediumType {
#define ROW(id, name, help) MEDIUM_##id,
  BRUME_MEDIUM_TYPES(ROW)
#undef ROW
      MEDIUM_TYPE_COUNT
};
enum LiquidModel {
#define ROW(id, name, help) LIQUID_##id,
  BRUME_LIQUID_MODELS(ROW)
#undef ROW
      LIQUID_MODEL_COUNT
};

struct LiquidDesc {
  int model = LIQUID_LOCAL_LIGHTING;
  // surface
  double iso = 0.5;   // presence at the surface, in (0, 1)
  int material = -1;  // an index into SceneDesc::materials; -1: none is named
  // local_lighting
  double outside = 0.5,
         inside = 0.6;           // presence below and above which no light is scattered, 0 <= outside < inside <= 1
  double light_intensity = 0.8;  // times the diffuse light
  dvec3 albedo{1}, specular{0}, ambient{0};
  double shininess = 50;
  bool grazing_correction = true;
  std::optional<int> slices;  // steps between planes across the view, instead of `step`
};

struct MediumDesc {
  int type = MEDIUM_PARTICIPATING;
  LiquidDesc liquid;                           // of a liquid; its rule for values beyond 1 is in the density
  std::optional<std::array<dvec3, 2>> bounds;  // file: the file's own transform when absent; generators: [-1,1]³
  TransformDesc transform;
  int interpolation = INTERPOLATION_TRILINEAR;
  DensityDesc density;
  std::shared_ptr<DensityDesc> emission_density;  // of the emission alone; the density where absent
  dvec3 sigma_a{0}, sigma_s{0}, emission{0};
  int phase = PHASE_ISOTROPIC;
  double g = 0;
  std::optional<int> method;        // instead of render.method, METHOD_AUTO too
  std::optional<double> step;       // instead of render.step
  std::optional<double> tolerance;  // instead of render.tolerance
  std::string place;                // JSON pointer, for messages of later stages
};

inline bool is_liquid(const MediumDesc& m, LiquidModel model) {
  return m.type == MEDIUM_LIQUID && m.liquid.model == model;
}

inline constexpr int METHOD_AUTO = -1;
inline constexpr int IN_SCATTERING_AUTO = -1;
inline constexpr int SHADOW_AUTO = -1;
inline constexpr int LIGHT_PICKS_AUTO = -1;

// What shapes that refract do to the light of lights.
enum GlassShadow { GLASS_OPAQUE, GLASS_CLEAR };

// How far off a picture is, in one number. ROW(ID, name, help)
#define BRUME_ERROR_METRICS(ROW)                                                            \
  ROW(REL_RMSE, "rel_rmse", "root of the mean squared error, over the mean of the picture") \
  ROW(MAX_ABS, "max_abs", "the largest error of a value")                                   \
  ROW(DISPLAY, "display", "what 99 % of the display values, in 0 to 1, are not further off than")
enum ErrorMetric {
#define ROW(id, name, help) METRIC_##id,
  BRUME_ERROR_METRICS(ROW)
#undef ROW
      METRIC_COUNT
};

inline constexpr int LEVEL_MAX = 8;

struct RenderDesc {
  int integrator = INTEGRATOR_WHITTED;
  int directions = 64;             // of ambient occlusion, as the next two
  std::optional<double> distance;  // what is further off does not occlude
  bool rotate = true;              // the directions, from pixel to pixel
  int method = METHOD_AUTO;
  double step = 0.05;       // share of the medium's longest side
  double tolerance = 1e-3;  // of adaptive: how far off a pixel may be, as a share of its light
  int in_scattering = IN_SCATTERING_AUTO;
  int shadow = SHADOW_AUTO;
  int storage = STORAGE_F32;
  int level = 0;                       // of detail: media with voxels averaged over 2^level of them along each axis
  int light_grid = 64;                 // shadow grid: cells of the light grid along the medium's longest side
  int light_picks = LIGHT_PICKS_AUTO;  // how many lights a point asks; 0: all
  int light_samples = 1;               // points on each surface that emits, where all lights are asked
  int light_points = LIGHT_POINTS_STRATIFIED;
  double roulette = 0;  // transmittance below which view rays end at random; 0: never
  int max_depth = 5;
  double cutoff = 1e-5;                // reflected and refracted rays that weigh less are dropped
  std::optional<int> shadow_of_glass;  // opaque, but clear where a liquid is a surface
  int bvh = BVH_SAH;
  int seed = 0;
  std::optional<double> max_error;    // settings of the media are chosen that reach it soonest, in error_metric,
  std::optional<double> time_budget;  // or that come closest in so many seconds; never both
  int error_metric = METRIC_REL_RMSE;

  bool has_goal() const { return max_error || time_budget; }
};

struct SceneDesc {
  std::filesystem::path file;  // empty for a scene made from a bare volume or mesh
  CameraDesc camera;
  FilmDesc film;
  dvec3 background{0}, ambient{0};
  std::vector<LightDesc> lights;
  std::vector<MaterialDesc> materials;
  std::vector<ShapeDesc> shapes;
  std::vector<MediumDesc> media;
  RenderDesc render;
};

}  // namespace brume
