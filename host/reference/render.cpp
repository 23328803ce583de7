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
  Lit lit{surface.emission + vec_promote(material.ambient) * vec_promote(scene.frame.ambient)};
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
  return pixel;
}

PixelD path_render(const Context& context, const RayD& ray, const RandomStream& random, int depth);

// The light of one ray that a surface sends on, times its weight; all that it adds to the sample.
void path_add(const Context& context, const SurfaceD& surface, const dvec3& dir, const dvec3& weight,
              const RandomStream& random, int depth, PixelD& sample) {
  const dvec3 unit = glm::normalize(dir);
  const PixelD further = path_render(context, {surface_leave(surface, unit), unit}, random, depth);
  sample.radiance += weight * further.radiance;
  sample.lookups += further.lookups;
  sample.key += further.key;
}

// Reflected and refracted light [Whitted80]. Total reflection gives the refracted weight to the reflected ray.
void specular_add(const Context& context, const SurfaceD& surface, const RayD& ray, const RandomStream& random,
                  int depth, PixelD& sample) {
  const Material& material = context.scene.materials[static_cast<std::size_t>(surface.material)];
  double reflection = material.reflection;
  const double refraction = material.refraction, ior = material.ior;
  if (depth >= context.scene.frame.max_depth || !(reflection > 0 || refraction > 0)) return;
  const dvec3 transmittance = sample.transmittance;
  if (refraction > 0) {
    const double eta = surface.leaving ? ior : 1 / ior, cosine = -glm::dot(surface.normal, ray.dir);
    const double squared = 1 - eta * eta * (1 - cosine * cosine);
    if (squared >= 0)
      path_add(context, surface, eta * ray.dir + (eta * cosine - std::sqrt(squared)) * surface.normal,
               refraction * transmittance, random.child(STREAM_REFRACT), depth + 1, sample);
    else
      reflection += refraction;
  }
  if (reflection > 0)
    path_add(context, surface, glm::reflect(ray.dir, surface.normal), reflection * transmittance,
             random.child(STREAM_REFLECT), depth + 1, sample);
}

// depth: bounces before this ray.
PixelD path_render(const Context& context, const RayD& ray, const RandomStream& random, int depth) {
  const FlatScene& scene = context.scene;
  const HitD hit = nearest_hit(scene, context.bounds, ray);
  const Scattered media = media_scatter(context, ray, hit.t, random);

  PixelD sample;
  sample.samples = 1;
  sample.transmittance = transmittance_of(media.tau);
  sample.lookups = media.lookups;
  if (hit.primitive == PRIMITIVE_NONE) {
    sample.radiance = media.radiance + sample.transmittance * vec_promote(scene.frame.background);
    sample.key = sample_key(hit.primitive, 0, walked(context, media.shadow_key, sample.lookups), 0) *
                 static_cast<uint>(2 * depth + 1);
    return sample;
  }
  const SurfaceD surface = surface_at(scene, ray, hit);
  const Lit lit = surface_light(context, surface, ray.dir, random, sample.lookups);
  sample.normal = surface.normal;
  sample.depth = hit.t;
  sample.hits = 1;
  sample.radiance = media.radiance + sample.transmittance * lit.radiance;
  sample.key =
      sample_key(hit.primitive, lit.lights, walked(context, media.shadow_key, sample.lookups), surface.checker) *
      static_cast<uint>(2 * depth + 1);
  specular_add(context, surface, ray, random, depth, sample);
  return sample;
}

}  // namespace

PixelD ray_render(const Context& context, const RayD& ray, const RandomStream& random) {
  return path_render(context, ray, random, 0);
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
