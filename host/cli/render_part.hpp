// Renders in part: which samples are to be rendered, which a film holds then, and what a file says of itself so that
// others can be joined to it.
#pragma once
#include <filesystem>
#include <string>

#include "film/film_partial.hpp"
#include "image/image.hpp"
#include "plan/render_plan.hpp"
#include "render/work.hpp"
#include "scene/scene_desc.hpp"

namespace brume {

// "A-B", both inclusive; "": all. InputError for anything else, and for samples beyond `spp`.
SampleRange samples_parse(const std::string& text, int spp);

// Of each pixel of the crop, those of `range` that are not held yet.
WorkList work_missing(const Frame& frame, SampleRange range, const SampleCover& held);

// What a film holds that held `held`, and into which all of `work` or a part of it was rendered.
SampleCover cover_after(const SampleCover& held, const WorkList& work, const Film& film);

// The part_keys() of a picture, and what a joined one needs: exposure, alpha.
ImageMetadata part_metadata(const SceneDesc& desc, const PlannedScene& flat);

// The file of --resume, or nothing yet; it may have been begun with fewer samples per pixel. InputError where it is
// part of another picture.
FilmPart part_begin(const std::filesystem::path& resume, const SceneDesc& desc, const PlannedScene& flat);

}  // namespace brume
