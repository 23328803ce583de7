// See ray_work.hpp.
#include "ray_work.hpp"

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <random>
#include <unordered_map>

#include "base/float_bits.hpp"
#include "base/number_text.hpp"
#include "base/stopwatch.hpp"
#include "cl/program.hpp"
#include "plan/planned_scene.hpp"
#include "rays_texts.hpp"
#include "render/device_scene.hpp"
#include "render/kernel_options.hpp"
#include "render/renderer.hpp"
#include "roofline_parts.hpp"
#include "scene/scene_reader.hpp"

namespace brume::bench {

namespace {

using glm::dvec3;

constexpr int SIDE = 512, TILE = 4;  // pixels; of a tile, in which order rays stand
constexpr double OFF = 1e-5;         // of what the rays hit: from where the next begin

std::filesystem::path spot_file() {
  const char* data = std::getenv("BRUME_TEST_DATA");
  return data ? std::filesystem::path(data) / "meshes/spot/spot_triangulated.obj" : std::filesystem::path();
}

// A camera and a lamp, in the world.
struct View {
  dvec3 eye, target, light;
  double half;  // of the picture's height at a distance of 1
};
const View SPOT_VIEW{{1.2, 0.8, -2}, {0, 0.05, 0}, {2, 3, -1}, 0.364};
const View SPHERE_VIEW{{0.3, 0.1, 0.2}, {-1, 0, 0.1}, {-0.2, 0.3, -0.1}, 1};

std::string scene_text(const RayMesh& mesh) {
  if (mesh.rings > 0) return R"({"shapes": [{"type": "mesh", "file": "sphere.obj"}]})";
  return R"({"shapes": [{"type": "mesh", "file": ")" + spot_file().string() + R"("},
    {"type": "triangle", "vertices": [[-3, -0.74, -3], [3, -0.74, -3], [3, -0.74, 3]]},
    {"type": "triangle", "vertices": [[-3, -0.74, -3], [3, -0.74, 3], [-3, -0.74, 3]]}]})";
}

void ray_add(std::vector<float>& rays, const dvec3& origin, const dvec3& dir, double t_max) {
  for (const dvec3& v : {origin, dir})
    for (int axis = 0; axis < 3; ++axis) rays.push_back(static_cast<float>(v[axis]));
  rays.push_back(static_cast<float>(t_max));
}

std::vector<float> camera_rays(const FlatScene& scene, const View& view) {
  const dvec3 eye = scene.point(view.eye), z = glm::normalize(view.eye - view.target),
              x = glm::normalize(glm::cross(dvec3(0, 1, 0), z)), y = glm::cross(z, x);
  std::vector<float> rays;
  for (int top = 0; top < SIDE; top += TILE)
    for (int left = 0; left < SIDE; left += TILE)
      for (int i = 0; i < TILE * TILE; ++i) {
        const int column = left + i % TILE, row = top + i / TILE;
        const double u = 2 * (column + 0.5) / SIDE - 1, v = 1 - 2 * (row + 0.5) / SIDE;
        ray_add(rays, eye, glm::normalize(view.half * (u * x + v * y) - z), INFINITY);
      }
  return rays;
}

dvec3 vector_at(const float* p) { return {p[0], p[1], p[2]}; }
dvec3 corner(const Triangle& t, int k) { return {t.p[k].x, t.p[k].y, t.p[k].z}; }

// From where a camera ray hits: to the lamp, and anywhere by the cosine.
void next_rays(const FlatScene& scene, const View& view, const float* ray, const float* hit, std::mt19937& random,
               RayFile& file) {
  if (!(hit[0] < INFINITY)) return;
  const Triangle& t = scene.triangles[static_cast<std::size_t>(float_as_bits(hit[1]) - FIRST_TRIANGLE)];
  const dvec3 dir = vector_at(ray + 3);
  dvec3 n = glm::normalize(glm::cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)));
  if (glm::dot(n, dir) > 0) n = -n;
  const dvec3 from = vector_at(ray) + double(hit[0]) * dir + OFF * n, to_light = scene.point(view.light) - from;
  ray_add(file.rays[1], from, glm::normalize(to_light), glm::length(to_light));
  std::uniform_real_distribution<double> uniform(0, 1);
  const double share = uniform(random), turn = 2 * M_PI * uniform(random);
  const dvec3 x = glm::normalize(glm::cross(n, std::abs(n.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
  const dvec3 y = glm::cross(n, x);
  ray_add(file.rays[2], from, std::sqrt(share) * (std::cos(turn) * x + std::sin(turn) * y) + std::sqrt(1 - share) * n,
          INFINITY);
}

struct PointHash {
  std::size_t operator()(const std::array<float, 3>& p) const {
    std::size_t hash = 0;
    for (const float v : p) hash = hash * 0x9E3779B97F4A7C15u + static_cast<std::uint32_t>(float_as_bits(v));
    return hash ^ (hash >> 32);
  }
};

// Corners that triangles share stand there once.
void triangles_put(const FlatScene& scene, RayFile& file) {
  std::unordered_map<std::array<float, 3>, std::uint32_t, PointHash> known;
  for (const Triangle& t : scene.triangles)
    for (const Packed3& p : t.p) {
      const auto [at, is_new] = known.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(known.size()));
      if (is_new) file.corners.insert(file.corners.end(), {p.x, p.y, p.z});
      file.numbers.push_back(at->second);
    }
}

}  // namespace

const std::vector<RayMesh>& ray_meshes() {
  static const std::vector<RayMesh> meshes = [] {
    std::vector<RayMesh> all{{"sphere70k", 187}, {"sphere1m", 708}};
    if (std::filesystem::exists(spot_file())) all.insert(all.begin(), {"spot", 0});
    return all;
  }();
  return meshes;
}

RayWork ray_work_make(Context& context, const RayMesh& mesh, const std::filesystem::path& folder, int lanes) {
  if (mesh.rings > 0) bumpy_sphere_write(mesh.rings, folder / "sphere.obj");
  const View& view = mesh.rings > 0 ? SPHERE_VIEW : SPOT_VIEW;
  RayWork work{flatten(scene_read_text(scene_text(mesh), folder / "rays.json", {}), {bvh_width_for(lanes), {}}),
               {},
               folder / (std::string(mesh.name) + ".rays")};
  triangles_put(work.scene, work.rays);
  std::vector<float> hits, &camera = work.rays.rays[0];
  camera = camera_rays(work.scene, view);
  RayKernels(context, work.scene, lanes).run("rays_alone", camera, 0, hits);
  std::mt19937 random(1);
  for (std::size_t i = 0; i < camera.size() / RAY_FLOATS; ++i)
    next_rays(work.scene, view, &camera[RAY_FLOATS * i], &hits[2 * i], random, work.rays);
  for (std::vector<float>& rays : work.rays.rays)
    rays.resize(rays.size() / RAY_FLOATS / RAY_MULTIPLE * RAY_MULTIPLE * RAY_FLOATS);
  ray_file_write(work.rays, work.file);
  return work;
}

RayKernels::RayKernels(Context& context, const PlannedScene& scene, int lanes)
    : context_(context), scene_(scene), lanes_(lanes) {}

std::vector<double> RayKernels::run(const char* name, const std::vector<float>& rays, int runs,
                                    std::vector<float>& out) const {
  const std::size_t count = rays.size() / RAY_FLOATS;
  out.resize(2 * count);
  DeviceScene uploaded(context_, scene_);
  const DevicePlan planned(context_, uploaded, scene_, 3);
  const cl::Program program = program_build(context_, kernel_source_text(RAYS_CL, "bench/rays.cl"),
                                            kernel_options(scene_, scene_, context_.device(), lanes_, false));
  cl::Kernel kernel = kernel_create(program, name);
  cl_uint argument = planned.set_arguments(kernel);
  const cl::Buffer in = context_.buffer("bench rays", rays), results = context_.buffer("bench hits", out);
  kernel.setArg(argument++, static_cast<cl_uint>(count));
  kernel.setArg(argument++, in);
  kernel.setArg(argument, results);
  std::vector<double> seconds;
  for (int run = -1; run < runs; ++run) {
    const Stopwatch watch;
    context_.launch(kernel, count);
    context_.queue().finish();
    if (run >= 0) seconds.push_back(watch.seconds());
  }
  context_.queue().enqueueReadBuffer(results, CL_TRUE, 0, out.size() * sizeof(float), out.data());
  return seconds;
}

}  // namespace brume::bench
