// The parts of the scene reader, one file each.
#pragma once
#include "base/json_value.hpp"
#include "scene/scene_desc.hpp"

namespace brume {

std::vector<MaterialDesc> read_materials(const JsonValue& scene, const std::filesystem::path& folder);
std::vector<ShapeDesc> read_shapes(const JsonValue& scene, const std::vector<MaterialDesc>& materials,
                                   const std::filesystem::path& folder);
std::vector<MediumDesc> read_media(const JsonValue& scene, const std::vector<MaterialDesc>& materials,
                                   const std::filesystem::path& folder);
// The key "material" of `owner`: an index into `materials`, -1 where there is none.
int read_material_name(const JsonValue& owner, const std::vector<MaterialDesc>& materials);
std::vector<LightDesc> read_lights(const JsonValue& scene);
TransformDesc read_transform(const JsonValue& owner);
// Where a density comes from and the box in which it stands.
DensityDesc read_density(const JsonValue& density, const std::filesystem::path& folder);
std::array<dvec3, 2> read_bounds(const JsonValue& bounds);
// The keys "method", "step" and "tolerance" of `owner`, of the whole picture or of one medium.
int read_method(const JsonValue& owner, int fallback);
double read_step(const JsonValue& owner, double fallback);
double read_tolerance(const JsonValue& owner, double fallback);

// Of what is seen as it is; more of it than this could not be summed over the samples of a pixel (SAMPLE_MAX).
inline constexpr double RADIANCE_MAX = 3e32;

// A path of the file, resolved against the folder of the scene.
std::filesystem::path read_path(const JsonValue& value, const std::filesystem::path& folder);

// Applies "/json/pointer=VALUE" to the parsed scene.
void apply_override(nlohmann::json& scene, const std::string& text);

// Puts the number of the frame into every text of `at` that has a place for it; FRAME_NONE: such a text fails.
// `file` and `place` of `at` for the message.
void apply_frame(nlohmann::json& at, int frame, const std::string& file, const std::string& place);

// Too short to have a direction, or not even finite.
bool is_zero(const dvec3& v);

// False where u and v are parallel or zero, to a part in 1e9.
bool spans_area(const dvec3& u, const dvec3& v);

}  // namespace brume
