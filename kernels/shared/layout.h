// Every struct that crosses between host and device with its fields in their order: expanded on both sides, so that
// `brume check` compares the size of each and where its fields lie. Whoever includes this includes the headers that
// define them.
#ifndef BRUME_SHARED_LAYOUT_H
#define BRUME_SHARED_LAYOUT_H

// STRUCT(type, F(field) F(field) ...). A new struct is a row here; a field that a row lacks does not compile
// (check_basics.cpp).
#define BRUME_STRUCTS(STRUCT)                                                                                          \
  STRUCT(Packed3, F(x) F(y) F(z))                                                                                      \
  STRUCT(Affine, F(m))                                                                                                 \
  STRUCT(Camera, F(axis) F(type) F(forward) F(width) F(right) F(height) F(up) F(spp) F(back))                          \
  STRUCT(Frame, F(camera) F(background) F(light_count) F(ambient) F(list_count) F(medium_count) F(triangle_count)      \
                    F(seed) F(in_scattering) F(max_depth) F(roulette) F(takes_ends) F(crop_x0) F(crop_y0) F(crop_x1)   \
                        F(crop_y1) F(bounds_lo) F(bounds_hi) F(light_picks) F(directions) F(occlusion_reach)           \
                            F(occlusion_rotates) F(hides_background) F(cutoff) F(clear_shadows) F(starts_inside)       \
                                F(instance_root) F(shape_root) F(light_ladder))                                        \
  STRUCT(Light, F(position) F(type) F(direction) F(falloff) F(intensity) F(outer) F(inner) F(exponent) F(primitive)    \
                    F(instance) F(point) F(points))                                                                    \
  STRUCT(LightGrid, F(grid_from_cell) F(cell_from_grid) F(nu) F(nv) F(nk) F(offset) F(slope_u) F(slope_v)              \
                        F(column_step) F(from_first) F(first_u) F(first_v) F(columns_u) F(columns_v) F(media) F(pad))  \
  STRUCT(Material, F(diffuse) F(model) F(specular) F(shininess) F(ambient) F(texture) F(emission) F(ior) F(reflection) \
                       F(refraction) F(emission_texture) F(fresnel) F(absorption))                                     \
  STRUCT(Texture, F(type) F(width) F(height) F(offset) F(color_a) F(scale) F(color_b) F(wrap) F(uv_scale) F(uv_offset) \
                      F(base) F(gain) F(pad))                                                                          \
  STRUCT(Shape, F(type) F(material) F(pad) F(data))                                                                    \
  STRUCT(Isosurface, F(cell_from_world) F(lo) F(iso) F(hi) F(brick_offset) F(cells_x) F(cells_y) F(cells_z)            \
                         F(brick_nx) F(brick_ny) F(brick_nz) F(masks))                                                 \
  STRUCT(Triangle, F(p) F(n) F(uv) F(material) F(shading))                                                             \
  STRUCT(Instance, F(mesh_from_world) F(world_from_mesh) F(root) F(mesh) F(material) F(reach) F(lo) F(hi))             \
  STRUCT(BrickGrid, F(brick_offset) F(cells_x) F(cells_y) F(cells_z) F(brick_nx) F(brick_ny) F(brick_nz))              \
  STRUCT(PlacedGrid,                                                                                                   \
         F(cell_from_world) F(world_from_cell) F(lo) F(grid) F(hi) F(interpolation) F(region) F(constant_density))     \
  STRUCT(MediumBody, F(sigma_a) F(density) F(sigma_s) F(glow) F(emission) F(phase) F(g) F(liquid))                     \
  STRUCT(Liquid, F(diffuse) F(outside) F(specular) F(inside) F(ambient) F(shininess) F(rate) F(gradients))             \
  STRUCT(GradientBrick, F(medium) F(x) F(y) F(z))                                                                      \
  STRUCT(MediumWalk, F(method) F(step) F(light_grade) F(track_sigma) F(light_grids) F(tolerance) F(tau_part)           \
                         F(tau_lit) F(piece_rates) F(light_steps) F(slices))                                           \
  STRUCT(Medium, F(cell_from_world) F(world_from_cell) F(lo) F(hi) F(brick_offset) F(cells_x) F(cells_y) F(cells_z)    \
                     F(brick_nx) F(brick_ny) F(brick_nz) F(interpolation) F(region) F(is_constant) F(constant_density) \
                         F(sigma_a) F(sigma_s) F(emission) F(phase) F(g) F(method) F(step) F(light_grade)              \
                             F(track_sigma) F(light_grids) F(tolerance) F(tau_part) F(tau_lit) F(piece_rates)          \
                                 F(light_steps) F(liquid) F(slices))                                                   \
  STRUCT(Ray, F(origin) F(pixel) F(dir) F(sample) F(weight) F(seed) F(heirs) F(start) F(inside))                       \
  STRUCT(Hit, F(t) F(primitive) F(u) F(v) F(instance) F(in_media))                                                     \
  STRUCT(MediumResult, F(transmittance) F(lookups) F(radiance) F(shadow_key) F(shadow_rays) F(error) F(tau_error))     \
  STRUCT(SurfaceResult,                                                                                                \
         F(radiance) F(lit) F(normal) F(second) F(lookups) F(shadow_rays) F(sent) F(dropped_rays) F(dropped_weight))   \
  STRUCT(Sample, F(radiance) F(key) F(normal) F(depth) F(transmittance) F(hit) F(first_ray) F(rays) F(lookups)         \
                     F(shadow_rays) F(secondary_rays) F(dropped_rays) F(dropped_weight) F(error))                      \
  STRUCT(Work, F(pixel) F(first_sample) F(samples) F(first_ray))                                                       \
  STRUCT(FilmPixel, F(radiance) F(samples) F(squares) F(normal) F(depth) F(transmittance) F(hits) F(lookups) F(key) F( \
                        shadow_rays) F(secondary_rays) F(dropped_rays) F(dropped_weight) F(invalid) F(clear) F(error))

#endif
