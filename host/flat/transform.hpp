// Transforms of scene files as matrices, and the conversions from double to the packed floats of shared structs.
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "flat/flat_scene.hpp"
#include "scene/scene_desc.hpp"
#include "shared/platform.h"

namespace brume {

using glm::dmat4;

// The steps in the order written: p' = M p.
dmat4 transform_matrix(const TransformDesc& transform);

dvec3 transform_point(const dmat4& m, const dvec3& p);
dvec3 transform_dir(const dmat4& m, const dvec3& d);

Packed3 packed(const dvec3& v);
Affine affine(const dmat4& m);  // the upper three rows
dmat4 matrix(const Affine& a);

// The map from X to flat units, made of the map from X to the world.
dmat4 flat_from(const FlatScene& scene, dmat4 world_from_x);

// A unit vector perpendicular to the unit vector n: the projection of x, or of z where n is nearly x.
dvec3 tangent(const dvec3& n);

}  // namespace brume
