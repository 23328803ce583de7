// A family is a table of named members (phases, methods, shapes, ...). Those that kernels know too are one list of rows
// ROW(ID, name, ..., help) in kernels/shared, which their enum, scene/families.cpp, dispatchers and tables expand.
// Parser, --help, errors, checks and tests read the table.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace brume {

struct FamilyRow {
  int id;
  std::string_view name;
  std::string_view help;
};
using Family = std::vector<FamilyRow>;

// "a, b, c"
inline std::string family_names(const Family& family) {
  std::string names;
  for (const FamilyRow& row : family) names += (names.empty() ? "" : ", ") + std::string(row.name);
  return names;
}

// The row of that name, or nullptr.
inline const FamilyRow* family_find(const Family& family, std::string_view name) {
  for (const FamilyRow& row : family)
    if (row.name == name) return &row;
  return nullptr;
}

// The name of a member; "?" for an id that the table does not hold.
inline std::string_view family_name(const Family& family, int id) {
  for (const FamilyRow& row : family)
    if (row.id == id) return row.name;
  return "?";
}

}  // namespace brume
