// The tables of scene/kernel families: names, ids and help, expanded from the lists in kernels/shared.
#pragma once
#include "base/family.hpp"
#include "shared/method.h"

namespace brume {

const Family& camera_family();
const Family& bvh_family();
const Family& light_family();
const Family& falloff_family();
const Family& integrator_family();
const Family& light_points_family();
const Family& material_family();
const Family& texture_family();
const Family& wrap_family();
const Family& phase_family();
bool phase_takes_g(int phase);
const Family& interpolation_family();
const Family& in_scattering_family();
const Family& error_metric_family();
const Family& medium_family();
const Family& liquid_model_family();
const Family& presence_family();
const Family& shadow_family();  // without "auto"
const Family& storage_family();
const Family& transfer_family();
const Family& method_family();  // without "auto"
const Family& shape_family();   // analytic shapes, triangle and mesh
const Family& mesh_shading_family();
const Family& level_set_family();
const Family& negative_family();
const Family& glass_shadow_family();

}  // namespace brume
