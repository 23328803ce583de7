// Pixels, surfaces under lights, keys and film sums: see the header and PICTURE.md.
#include "reference/render.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <thread>

#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "reference/ambient_occlusion.hpp"
#include "reference/glass.hpp"
#include "reference/sampling.hpp"
#include "reference/surface.hpp"
#include "shared/method.h"
#include "shared/ray.h"

namespace brume::reference {
namespace {

struct Lit {
  dvec3 radiance;
  uint lights = 0;  // bit i: light i (mod 32) reaches the surface
};

// `weight`: of what it scatters, in the sample.
Lit surface_light(const Context& context, const SurfaceD& surface, const dvec3& view_dir, const dvec3& weight,
                  const RandomStream& random, double& lookups) {
  const PlannedScene& scene = context.scene;
  const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
  Lit lit{surface.emission + vec_promote(material.ambient) * vec_promote(scene.frame.ambient)};
  uint n = 0;
  for (const LightPick& pick : light_picks(scene, random, 0, context.exact())) {
    const RandomStream shadow = random.child(STREAM_LIGHT + n++);
    const LightSample light = light_at(scene, scene.lights[pick.light], surface.point, random);
    const dvec3 to_light = -light.travel;
    if (!(glm::dot(surface.normal, to_light) > 0) || light.in_plane(surface.geometric_normal, surface.ray_epsilon))
      continue;
    const dvec3 reflected = surface_reflect(scene, surface, view_dir, -to_light), seen = weight * reflected;
    if (material.refraction > 0 && std::max({seen.x, seen.y, seen.z}) < scene.frame.cutoff) continue;
    const Arrival arrival =
        light_arrival(context, pick.light, surface.point, surface_leave(surface, to_light), random, shadow, lookups);
    if (arrival.blocked) continue;
    lit.lights |= 1u << (pick.light % 32);
    lit.radiance += pick.weight * arrival.irradiance * reflected;
  }
  return lit;
}

Lit corners_light(const Context& context, const SurfaceD& surface, const HitD& hit, const dvec3& view_dir,
                  const dvec3& weight, const RandomStream& random, double& lookups) {
  Lit all{dvec3(0)};
  for (const auto& [corner, share] : surface_corners(context.scene, surface, hit)) {
    const Lit lit = surface_light(context, corner, view_dir, weight, random, lookups);
    all.radiance += share * lit.radiance;
    all.lights |= lit.lights;
  }
  return all;
}

Lit lit_by_sky(const Context& context, const SurfaceD& surface, const RandomStream& random) {
  const Sky sky = ambient_occlusion(context, surface, random);
  return {dvec3(sky.open), sky.seen};
}

uint sample_key(const HitD& hit, uint lit, uint shadow_key, int second) {
  return primitive_name(hit.primitive, hit.instance) * 0x9E3779B1u + lit * 0x85EBCA6Bu + shadow_key * 0xC2B2AE35u +
         static_cast<uint>(second) * 0x27D4EB2Fu;
}

// Trackers that take another number of collisions take another way.
uint walked(const Context& context, uint shadow_key, double lookups) {
  for (const Medium& medium : context.media)
    if (method_tracks(medium.method) && !context.exact()) return shadow_key + static_cast<uint>(lookups);
  return shadow_key;
}

// squares: the deviation from the mean before times that from the mean with the sample [Welford62].
void pixel_add(PixelD& sum, const PixelD& sample) {
  const dvec3 before = sum.radiance / std::max(sum.samples, 1.0);
  sum.radiance += sample.radiance;
  const dvec3 after = sum.radiance / (sum.samples + 1);
  if (sum.samples > 0) sum.squares += (sample.radiance - before) * (sample.radiance - after);
  sum.normal += sample.normal;
  sum.transmittance += sample.transmittance;
  sum.samples += sample.samples;
  sum.depth += sample.depth;
  sum.hits += sample.hits;
  sum.clear += sample.clear;
  sum.lookups += sample.lookups;
  sum.dropped_rays += sample.dropped_rays;
  sum.dropped_weight += sample.dropped_weight;
  sum.key += sample.key;
  sum.error += sample.error;
}

Packed3 pack(const dvec3& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

FilmPixel film_pixel(const PixelD& p) {
  FilmPixel pixel{};
  pixel.radiance = pack(p.radiance);
  pixel.samples = static_cast<float>(p.samples);
  pixel.squares = pack(p.squares);
  pixel.normal = pack(p.normal);
  pixel.depth = static_cast<float>(p.depth);
  pixel.transmittance = pack(p.transmittance);
  pixel.hits = static_cast<float>(p.hits);
  pixel.lookups = static_cast<float>(p.lookups);
  pixel.key = p.key;
  pixel.dropped_rays = static_cast<float>(p.dropped_rays);
  pixel.dropped_weight = static_cast<float>(p.dropped_weight);
  pixel.invalid = static_cast<float>(p.invalid);
  pixel.clear = static_cast<float>(p.clear);
  pixel.error = static_cast<float>(p.error);
  return pixel;
}

// depth: bounces before a ray. heirs: how many rays it may send on, those that these send on included; in single
// precision, as in the kernels, so that both drop the same rays. weight: of its light in the sample.
struct PathState {
  RandomStream random;
  int depth = 0;
  float heirs = INFINITY;
  dvec3 weight{1};
  Inside inside;     // of what refracts
  double start = 0;  // how far before its origin the ray begins
};

double mean_of(const dvec3& v) { return (v.x + v.y + v.z) / 3; }

// What `adaptive` expects a ray of this weight to be off by; `seen`: what lies behind the media, through them.
double error_of(const Scattered& media, const dvec3& seen, const dvec3& weight) {
  return mean_of(weight) * (media.error + mean_of(seen) * media.tau_error);
}

PixelD path_render(const Context& context, const RayD& ray, const PathState& path);

// The light of one ray that a surface sends on, times `factor`; all that it adds to the sample.
void path_add(const Context& context, const SurfaceD& surface, const dvec3& dir, const dvec3& factor, PathState path,
              PixelD& sample) {
  const dvec3 unit = glm::normalize(dir);
  path.weight *= factor;
  const double largest = std::max({path.weight.x, path.weight.y, path.weight.z});
  if (!(path.heirs >= 1) || largest < context.scene.frame.cutoff) {
    sample.dropped_rays += largest > 0;
    sample.dropped_weight += largest;
    return;
  }
  path.heirs -= 1;
  ++path.depth;
  const dvec3 origin = surface_leave(surface, unit);
  path.start = glm::dot(origin - surface.point, unit);
  const PixelD further = path_render(context, {origin, unit}, path);
  sample.radiance += factor * further.radiance;
  sample.error += further.error;
  sample.lookups += further.lookups;
  sample.dropped_rays += further.dropped_rays;
  sample.dropped_weight += further.dropped_weight;
  sample.key += further.key;
}

// Reflected and refracted light [Whitted80]. Total reflection gives the refracted weight to the reflected ray.
void specular_add(const Context& context, const SurfaceD& surface, const RayD& ray, const PathState& path,
                  PixelD& sample) {
  const Material& material = context.scene.materials[static_cast<std::size_t>(surface.material)];
  float reflection = material.reflection, refraction = material.refraction;
  const float both = reflection + refraction;
  const double ior = material.ior;
  if (path.depth >= context.scene.frame.max_depth || !(both > 0)) return;
  const dvec3 transmittance = sample.transmittance;
  const auto add = [&](const dvec3& dir, float share, uint stream) {
    PathState next = path;
    next.random = path.random.child(stream);
    next.heirs = path.heirs * (share / both);
    if (material.refraction > 0 && glm::dot(surface.geometric_normal, dir) < 0) next.inside.cross(surface);
    path_add(context, surface, dir, double(share) * transmittance, next, sample);
  };
  if (refraction > 0) {
    const double eta = surface.leaving ? ior : 1 / ior, cosine = -glm::dot(surface.normal, ray.dir);
    const double squared = 1 - eta * eta * (1 - cosine * cosine);
    double mirrored = squared >= 0 ? 0 : 1;
    if (material.fresnel) mirrored = fresnel(std::max(cosine, 0.0), eta);
    reflection += refraction * static_cast<float>(mirrored);
    refraction *= 1 - static_cast<float>(mirrored);
    if (refraction > 0)
      add(eta * ray.dir + (eta * cosine - std::sqrt(squared)) * surface.normal, refraction, STREAM_REFRACT);
  }
  if (reflection > 0) add(glm::reflect(ray.dir, surface.normal), reflection, STREAM_REFLECT);
}

PixelD path_render(const Context& context, const RayD& ray, const PathState& path) {
  const RandomStream& random = path.random;
  const PlannedScene& scene = context.scene;
  const HitD hit = nearest_hit(scene, context.bounds, ray);
  const Scattered media = media_scatter(context, ray, hit.t, random);

  PixelD sample;
  sample.samples = 1;
  sample.transmittance = transmittance_of(media.tau) * absorbed(scene, path.inside.innermost(), path.start + hit.t);
  sample.lookups = media.lookups;
  if (hit.primitive == PRIMITIVE_NONE) {
    sample.clear = (sample.transmittance.x + sample.transmittance.y + sample.transmittance.z) / 3;
    const bool hidden = scene.frame.hides_background && path.depth == 0;
    const dvec3 seen = hidden ? dvec3(0) : sample.transmittance * vec_promote(scene.frame.background);
    sample.radiance = media.radiance + seen;
    sample.error = error_of(media, seen, path.weight);
    sample.key = sample_key(hit, 0, walked(context, media.shadow_key, sample.lookups), 0) *
                 static_cast<uint>(2 * path.depth + 1);
    return sample;
  }
  const SurfaceD surface = surface_at(scene, ray, hit);
  const Lit lit =
      scene.frame.directions > 0
          ? lit_by_sky(context, surface, random)
          : corners_light(context, surface, hit, ray.dir, path.weight * sample.transmittance, random, sample.lookups);
  sample.normal = surface.normal;
  sample.depth = hit.t;
  sample.hits = 1;
  sample.radiance = media.radiance + sample.transmittance * lit.radiance;
  sample.error = error_of(media, sample.transmittance * lit.radiance, path.weight);
  sample.key = sample_key(hit, lit.lights, walked(context, media.shadow_key, sample.lookups),
                          scene.frame.directions > 0 ? 0 : surface.second) *
               static_cast<uint>(2 * path.depth + 1);
  specular_add(context, surface, ray, path, sample);
  return sample;
}

// Planes have no bounds: a camera ray that begins behind some begins anew before the first of them.
FrameRayD start_before_planes(const PlannedScene& scene, const FrameRayD& from) {
  double back = 0;
  for (const Shape& shape : scene.shapes) {
    if (shape.type != SHAPE_PLANE) continue;
    const dvec3 normal = vec_unit(vec_promote(shape.data + 3));
    const double t = glm::dot(from.ray.origin - vec_promote(shape.data), normal) / glm::dot(from.ray.dir, normal);
    if (t >= 0 && t < from.start) back = std::max(back, std::min(from.start, t + std::max(1.0, t) / 32));
  }
  return {{from.ray.at(-back), from.ray.dir}, from.start - back};
}

// What float could not hold, and what no sum over samples should meet.
bool is_valid(const PixelD& sample) {
  const dvec3& r = sample.radiance;
  return std::abs(r.x) <= SAMPLE_MAX && std::abs(r.y) <= SAMPLE_MAX && std::abs(r.z) <= SAMPLE_MAX;
}

}  // namespace

PixelD ray_render(const Context& context, const RayD& ray, const RandomStream& random, double start) {
  const bool whole = context.scene.frame.max_depth <= SECONDARY_DEPTH_WHOLE;
  const Inside inside = context.scene.frame.starts_inside ? inside_of(context.scene, context.bounds, ray) : Inside{};
  return path_render(context, ray, {random, 0, whole ? INFINITY : float(SECONDARY_RAYS_MAX), dvec3(1), inside, start});
}

PixelD pixel_render(const Context& context, int x, int y, const std::function<RayD(const RayD&)>& moved) {
  const Frame& frame = context.scene.frame;
  const uint pixel = static_cast<uint>(y) * static_cast<uint>(frame.camera.width) + static_cast<uint>(x);
  PixelD sum;
  for (int sample = 0; sample < std::max(1, frame.camera.spp); ++sample) {
    const dvec2 position = pixel_position(pixel, static_cast<uint>(sample), frame.camera.spp, frame.seed);
    const FrameRayD camera = start_before_planes(context.scene, frame_ray(frame, x, y, position));
    PixelD one = ray_render(context, moved ? moved(camera.ray) : camera.ray,
                            {pixel, static_cast<uint>(sample), frame.seed}, camera.start);
    one.depth = (one.depth + one.hits * camera.start) * context.scene.unit;
    if (is_valid(one)) {
      pixel_add(sum, one);
    } else {
      ++sum.invalid;
    }
  }
  return sum;
}

void render(const PlannedScene& scene, Film& film, const Options& options) {
  const Frame& frame = scene.frame;
  const int width = frame.camera.width, height = frame.camera.height;
  if (film.size().x != width || film.size().y != height)
    throw RuntimeError("reference: the film is " + std::to_string(film.size().x) + "x" + std::to_string(film.size().y) +
                       ", the camera " + std::to_string(width) + "x" + std::to_string(height));
  const Context context(scene, options);
  std::atomic<int> next_row{frame.crop_y0};
  const auto work = [&] {  // rows are independent, so the picture does not depend on who takes which
    for (int y = next_row++; y < frame.crop_y1; y = next_row++)
      for (int x = frame.crop_x0; x < frame.crop_x1 && !interrupt_requested(); ++x)
        film.pixels()[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
            film_pixel(pixel_render(context, x, y));
  };
  const int count =
      options.threads > 0 ? options.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<std::thread> helpers;
  for (int i = 1; i < count; ++i) helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers) helper.join();
  interrupt_check();
}

}  // namespace brume::reference
