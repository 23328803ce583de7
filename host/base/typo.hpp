// "Did you mean ...?": the known key that an unknown one is likely a typo of.
#pragma once
#include <string>
#include <vector>

namespace brume {

// The nearest candidate of which about a third of the letters or fewer differ (one of 2 to 4, two of 5 to 7); "" for
// none.
std::string key_nearest(const std::string& key, const std::vector<std::string>& candidates);

}  // namespace brume
