// Files that OBJ and MTL files name, as they lie on another disk than the one they were written on.
#pragma once
#include <filesystem>
#include <string_view>

namespace brume {

struct FoundFile {
  std::filesystem::path path;  // the name beside `folder` where nothing was found
  bool found;
  bool as_named;  // false where only a file of another case or of the same base name was there
};

// The file called `name` ("\" separates folders, too) in `folder`; else one whose name differs in case; else, in `folder` itself,
// one of its base name ("C:\textures\Wood.PNG": wood.png). Quotes about the name are taken off where no file has them.
FoundFile file_find(const std::filesystem::path& folder, std::string_view name);

}  // namespace brume
