// See volume_choice.hpp.
#include "volume/volume_choice.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace brume {

namespace {

using Grids = std::vector<std::size_t>;

constexpr std::size_t NAMES_SHOWN = 8;
constexpr const char* ALLOWED = "float, double, int32, int64, bool and mask grids of class fog volume or unknown";

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::string quoted(const std::string& name) {
  std::string shown = name.substr(0, 80);
  for (char& c : shown)
    if (static_cast<unsigned char>(c) < ' ') c = '?';
  return "'" + shown + (name.size() > shown.size() ? "..." : "") + "'";
}

template <class Text>
std::string bounded_list(std::size_t count, Text text) {
  std::string list;
  for (std::size_t i = 0; i < std::min(count, NAMES_SHOWN); ++i) list += (i ? ", " : "") + text(i);
  return count > NAMES_SHOWN ? list + " and " + std::to_string(count - NAMES_SHOWN) + " more" : list;
}

template <class Is>
Grids grids_that(const VolumeProgram& program, const VolumeValues& values, Is is) {
  Grids found;
  for (std::size_t i = 0; i < program.grids().size(); ++i)
    if (volume_refusal(program.grids()[i], values).empty() && is(program.grids()[i])) found.push_back(i);
  return found;
}

// What can be a density, by how likely it is meant: one row after the other.
std::vector<Grids> grids_by_likelihood(const VolumeProgram& program, const VolumeValues& values) {
  using Head = VolumeProgram::GridHead;
  return {grids_that(program, values, [](const Head& g) { return g.plain_name == "density"; }),
          grids_that(program, values, [](const Head& g) { return lower(g.plain_name) == "density"; }),
          grids_that(program, values, [](const Head& g) { return g.head.scalar == VolumeScalar::FLOATING; }),
          grids_that(program, values, [](const Head&) { return true; })};
}

[[noreturn]] void fail_none(const VolumeProgram& program, const std::string& file, const VolumeValues& values) {
  if (program.grids().size() == 1)
    throw InputError(program.place(0) + ": " + volume_refusal(program.grids()[0], values));
  throw InputError(file + ": none of its grids can be a density: " + volume_listing(program) + "; allowed are " +
                   ALLOWED);
}

std::size_t find_unnamed(const VolumeProgram& program, const std::string& file, const VolumeValues& values) {
  for (const Grids& row : grids_by_likelihood(program, values)) {
    if (row.size() == 1) return row[0];
    if (row.size() > 1)
      throw InputError(file + ": which grid? " +
                       bounded_list(row.size(), [&](std::size_t i) { return quoted(program.grids()[row[i]].name); }) +
                       " can be a density; \"grid\" names one");
  }
  fail_none(program, file, values);
}

}  // namespace

std::string volume_refusal(const VolumeProgram::GridHead& grid, const VolumeValues& values) {
  if (!grid.failure.empty()) return grid.failure;
  if (grid.head.scalar == VolumeScalar::NONE) return "holds " + grid.type + " values; allowed are " + ALLOWED;
  if (grid.head.grid_class == VolumeClass::OTHER) return "is a " + grid.grid_class + " grid; allowed are " + ALLOWED;
  if (values.fill && grid.head.scalar != VolumeScalar::FLOATING)
    return "holds " + grid.type + " values; \"level_set\": \"fill\" wants the distances of a level set";
  if (!values.fill && grid.head.grid_class == VolumeClass::LEVEL_SET)
    return std::string("is a level set; \"level_set\": \"fill\" fills it; allowed without are ") + ALLOWED;
  if (!grid.head.linear) return "has a " + grid.map + "; allowed are linear transforms";
  return "";
}

std::size_t volume_find(const VolumeProgram& program, const std::string& file, const std::string& name,
                        const VolumeValues& values) {
  if (name.empty()) return find_unnamed(program, file, values);
  Grids found;
  for (std::size_t i = 0; i < program.grids().size(); ++i) {
    if (program.grids()[i].name == name) return i;
    if (program.grids()[i].plain_name == name) found.push_back(i);
  }
  if (found.size() == 1) return found[0];
  throw InputError(file + ": " + (found.empty() ? "no grid " : "several grids ") + quoted(name) + "; the file holds " +
                   volume_listing(program));
}

std::vector<std::size_t> volume_candidates(const VolumeProgram& program, const std::string& file) {
  VolumeValues values;
  std::vector<Grids> rows = grids_by_likelihood(program, values);
  values.fill = true;
  rows.push_back(grids_that(
      program, values, [](const VolumeProgram::GridHead& g) { return g.head.grid_class == VolumeClass::LEVEL_SET; }));
  Grids order;
  for (const Grids& row : rows)
    for (const std::size_t i : row)
      if (std::find(order.begin(), order.end(), i) == order.end()) order.push_back(i);
  if (order.empty()) fail_none(program, file, VolumeValues{});
  return order;
}

std::string volume_listing(const VolumeProgram& program) {
  const auto& grids = program.grids();
  return bounded_list(grids.size(), [&](std::size_t i) {
    return quoted(grids[i].name) + " (" + grids[i].type + ", " + grids[i].grid_class + ")";
  });
}

}  // namespace brume
