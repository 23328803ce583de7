// Which media a scene has, one by one, and which method each of them takes. Flattening asks it, since methods differ in
// the kind of density that they need; and so do plans.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "scene/scene_desc.hpp"

namespace brume {

// A medium of the flat scene: those of the scene file but the surfaces of liquids, which are shapes, and the glows
// among them that have a density of their own.
struct MediumRow {
  std::shared_ptr<const MediumDesc> desc;
  bool only_glows;
};
std::vector<MediumRow> media_rows(const SceneDesc& desc);

// The method of a medium: a method of its own has to fit it; where that of the picture does not, it is the exact one.
// Never auto. Throws InputError.
int method_resolve(const SceneDesc& desc, const MediumDesc& medium);
// The rule by which scattered light is summed, never auto: of fourth order where all else is exact, too.
int in_scattering_resolve(const SceneDesc& desc);
// Whether its density is taken as one number, without voxels.
bool takes_constant(const SceneDesc& desc, const MediumDesc& medium);
// Throws InputError where methods or light grids fit no medium; notes media that take another method than the picture
// asks for.
void media_check(const SceneDesc& desc, const std::vector<MediumRow>& media, std::vector<std::string>& notes);

}  // namespace brume
