// See typo.hpp: Levenshtein distance, cut off where it no longer matters.
#include "base/typo.hpp"

#include <algorithm>
#include <cstddef>

namespace brume {

namespace {

// Steps of one inserted, removed or changed letter; `limit` + 1 where there are more.
std::size_t edit_distance(const std::string& a, const std::string& b, std::size_t limit) {
  if (std::max(a.size(), b.size()) - std::min(a.size(), b.size()) > limit) return limit + 1;
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return std::min(row[b.size()], limit + 1);
}

}  // namespace

std::string key_nearest(const std::string& key, const std::vector<std::string>& candidates) {
  std::string nearest;
  std::size_t best = static_cast<std::size_t>(-1);
  for (const std::string& candidate : candidates) {
    const std::size_t limit = (std::min(key.size(), candidate.size()) + 1) / 3;
    const std::size_t distance = edit_distance(candidate, key, limit);
    if (distance > limit || distance >= best) continue;
    best = distance;
    nearest = candidate;
  }
  return nearest;
}

}  // namespace brume
