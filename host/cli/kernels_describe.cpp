// See kernels_describe.hpp.
#include "cli/kernels_describe.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "render/kernel_options.hpp"
#include "scene/families.hpp"

namespace brume {

namespace {

// Of the families that kernels branch over.
const Family* option_family(const std::string& name) {
  static const std::map<std::string, const Family*> families{{"METHODS_USED", &method_family()},
                                                             {"PHASES_USED", &phase_family()},
                                                             {"SHAPES_USED", &shape_family()},
                                                             {"LIGHTS_USED", &light_family()}};
  const auto found = families.find(name);
  return found == families.end() ? nullptr : found->second;
}

// "shapes: sphere, plane" of those whose bit is set in `bits`; empty where none is.
std::string members_text(const KernelOption& option, const Family& family, unsigned bits) {
  Family members;
  for (const FamilyRow& row : family)
    if (row.id < 32 && (bits >> row.id) & 1u) members.push_back(row);
  return members.empty() ? "" : option.what + (": " + family_names(members));
}

}  // namespace

nlohmann::ordered_json kernels_json(const PlannedScene& scene) {
  std::vector<std::string> needs, left_out;
  std::string options;
  for (const KernelOption& option : scene_kernel_options(scene, scene)) {
    options += option_text(option.name, option.value);
    if (const Family* family = option_family(option.name)) {
      needs.push_back(members_text(option, *family, option.value));
      left_out.push_back(members_text(option, *family, option.generic & ~option.value));
    } else if (option.generic > 1) {  // a number: none, one, any
      const std::string what = option.what;
      needs.push_back(option.value == 0 ? "" : option.value == 1 ? what + ": one" : what + ": several");
      left_out.push_back(option.value == 0 ? what : option.value == 1 ? what + ": several" : "");
    } else {
      (option.value ? needs : left_out).push_back(option.what);
    }
  }
  for (auto* words : {&needs, &left_out}) words->erase(std::remove(words->begin(), words->end(), ""), words->end());
  return {{"needs", needs}, {"left_out", left_out}, {"options", options.substr(1)}};
}

}  // namespace brume
