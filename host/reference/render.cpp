// Pixels, surfaces under lights, keys and film sums: see the header and ARCHITECTURE.md.
#include "reference/render.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <thread>

#include "base/error.hpp"
#include "reference/sampling.hpp"
#include "reference/surface.hpp"
#include "reference/tracking.hpp"

namespace brume::reference {
namespace {

struct Lit {
  dvec3 radiance;
  uint lights = 0;  // bit i: light i (mod 32) reaches the surface
};

Lit surface_light(const Context& context, const SurfaceD& surface, const dvec3& view_dir, const RandomStream& random,
                  double& lookups) {
  const FlatScene& scene = context.scene;
  const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
  Lit lit{vec_promote(material.emission) + vec_promote(material.ambient) * vec_promote(scene.frame.ambient)};
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const dvec3 to_light = -light_at(scene.lights[i], surface.point).travel;
    if (!(glm::dot(surface.normal, to_light) > 0)) continue;
    const dvec3 origin = surface_leave(surface, to_light);
    const Arrival arrival = light_arrival(context, i, surface.point, origin, random, lookups);
    if (arrival.blocked) continue;
    lit.lights |= 1u << (i % 32);
    lit.radiance += arrival.irradiance * surface_reflect(scene, surface, view_dir, arrival.light.travel);
  }
  return lit;
}

uint sample_key(int primitive, uint lit, uint shadow_key, int checker) {
  return static_cast<uint>(primitive) * 0x9E3779B1u + lit * 0x85EBCA6Bu + shadow_key * 0xC2B2AE35u +
         static_cast<uint>(checker) * 0x27D4EB2Fu;
}

// Trackers that take another number of collisions take another way.
uint walked(const Context& context, uint shadow_key, double lookups) {
  for (const Medium& medium : context.scene.media)
    if (method_tracks(medium.method) && !context.exact()) return shadow_key + static_cast<uint>(lookups);
  return shadow_key;
}

void pixel_add(PixelD& sum, const PixelD& sample) {
  sum.radiance += sample.radiance;
  sum.normal += sample.normal;
  sum.transmittance += sample.transmittance;
  sum.samples += sample.samples;
  sum.depth += sample.depth;
  sum.hits += sample.hits;
  sum.lookups += sample.lookups;
  sum.key += sample.key;
  sum.dropped += sample.dropped;
}

Packed3 pack(const dvec3& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

FilmPixel film_pixel(const PixelD& p) {
  FilmPixel pixel{};
  pixel.radiance = pack(p.radiance);
  pixel.samples = static_cast<float>(p.samples);
  pixel.normal = pack(p.normal);
  pixel.depth = static_cast<float>(p.depth);
  pixel.transmittance = pack(p.transmittance);
  pixel.hits = static_cast<float>(p.hits);
  pixel.lookups = static_cast<float>(p.lookups);
  pixel.key = p.key;
  pixel.dropped = static_cast<float>(p.dropped);
  return pixel;
}

// A ray that a surface sends on.
struct Path {
  RayD ray;
  dvec3 weight;  // of its light in the sample
  RandomStream random;
  int depth;  // bounces before it
};

// The rays of one sample: those that are still to be followed, and those that are left out.
struct Paths {
  std::vector<Path> waiting;
  int left = PATHS_MAX;
  double dropped = 0;

  void add(const SurfaceD& surface, const dvec3& dir, const dvec3& weight, const RandomStream& random, int depth) {
    const double largest = std::max({weight.x, weight.y, weight.z});
    if (!(largest > 0)) return;
    if (largest < PATH_WEIGHT_MIN || left == 0) {
      dropped += largest;
      return;
    }
    --left;
    const dvec3 unit = glm::normalize(dir);
    waiting.push_back({{surface_leave(surface, unit), unit}, weight, random, depth});
  }
};

// Reflected and refracted light [Whitted80]. Total reflection gives the refracted weight to the reflected ray.
void specular_add(const Context& context, const SurfaceD& surface, const Path& path, const dvec3& transmittance,
                  Paths& paths) {
  const Material& material = context.scene.materials[static_cast<std::size_t>(surface.material)];
  double reflection = material.reflection;
  const double refraction = material.refraction, ior = material.ior;
  if (path.depth >= context.scene.frame.max_depth) return;
  const dvec3 weight = path.weight * transmittance, &dir = path.ray.dir;
  if (refraction > 0) {
    const double eta = surface.leaving ? ior : 1 / ior, cosine = -glm::dot(surface.normal, dir);
    const double squared = 1 - eta * eta * (1 - cosine * cosine);
    if (squared >= 0)
      paths.add(surface, eta * dir + (eta * cosine - std::sqrt(squared)) * surface.normal, refraction * weight,
                path.random.child(STREAM_REFRACT), path.depth + 1);
    else
      reflection += refraction;
  }
  if (reflection > 0)
    paths.add(surface, glm::reflect(dir, surface.normal), reflection * weight, path.random.child(STREAM_REFLECT),
              path.depth + 1);
}

// The light of one ray, times its weight, and the key of what it meets; what the surface sends on goes to `paths`. A sample's own
// values (normal, depth, transmittance) are those of its camera ray.
void path_follow(const Context& context, const Path& path, Paths& paths, PixelD& sample) {
  const FlatScene& scene = context.scene;
  const HitD hit = nearest_hit(scene, context.bounds, path.ray);
  const Scattered media = media_scatter(context, path.ray, hit.t, path.random);
  const dvec3 transmittance = transmittance_of(media.tau);
  double lookups = media.lookups;
  Lit lit{vec_promote(scene.frame.background), 0};
  int checker = 0;
  if (hit.primitive != PRIMITIVE_NONE) {
    const SurfaceD surface = surface_at(scene, path.ray, hit);
    lit = surface_light(context, surface, path.ray.dir, path.random, lookups);
    checker = surface.checker;
    specular_add(context, surface, path, transmittance, paths);
    if (path.depth == 0) {
      sample.normal = surface.normal;
      sample.depth = hit.t;
      sample.hits = 1;
    }
  }
  if (path.depth == 0) sample.transmittance = transmittance;
  sample.radiance += path.weight * (media.radiance + transmittance * lit.radiance);
  sample.lookups += lookups;
  sample.key += sample_key(hit.primitive, lit.lights, walked(context, media.shadow_key, lookups), checker) *
                static_cast<uint>(2 * path.depth + 1);
}

}  // namespace

PixelD ray_render(const Context& context, const RayD& ray, const RandomStream& random) {
  PixelD sample;
  sample.samples = 1;
  Paths paths;
  paths.waiting.push_back({ray, dvec3(1), random, 0});
  while (!paths.waiting.empty()) {
    const Path path = paths.waiting.back();
    paths.waiting.pop_back();
    path_follow(context, path, paths, sample);
  }
  sample.dropped = paths.dropped;
  return sample;
}

PixelD pixel_render(const Context& context, int x, int y) {
  const Frame& frame = context.scene.frame;
  const uint pixel = static_cast<uint>(y) * static_cast<uint>(frame.camera.width) + static_cast<uint>(x);
  PixelD sum;
  for (int sample = 0; sample < std::max(1, frame.camera.spp); ++sample) {
    const double xi0 = rng_uniform(pixel, static_cast<uint>(sample), 0, frame.seed);
    const double xi1 = rng_uniform(pixel, static_cast<uint>(sample), 1, frame.seed);
    const dvec2 position = pixel_position(sample, frame.camera.spp, xi0, xi1);
    pixel_add(sum, ray_render(context, camera_ray(frame.camera, x, y, position),
                              {pixel, static_cast<uint>(sample), frame.seed}));
  }
  return sum;
}

void render(const FlatScene& scene, Film& film, const Options& options) {
  const Frame& frame = scene.frame;
  const int width = frame.camera.width, height = frame.camera.height;
  if (film.size().x != width || film.size().y != height)
    throw RuntimeError("reference: the film is " + std::to_string(film.size().x) + "x" + std::to_string(film.size().y) +
                       ", the camera " + std::to_string(width) + "x" + std::to_string(height));
  const Context context(scene, options);
  std::atomic<int> next_row{frame.crop_y0};
  const auto work = [&] {  // rows are independent, so the picture does not depend on who takes which
    for (int y = next_row++; y < frame.crop_y1; y = next_row++)
      for (int x = frame.crop_x0; x < frame.crop_x1; ++x)
        film.pixels()[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
            film_pixel(pixel_render(context, x, y));
  };
  const int count =
      options.threads > 0 ? options.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<std::thread> helpers;
  for (int i = 1; i < count; ++i) helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers) helper.join();
}

}  // namespace brume::reference
