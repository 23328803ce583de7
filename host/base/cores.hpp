// How many cores this process may use: fewer than there are in a container or under taskset.
#pragma once
#include <string>

namespace brume {

// By what a file cpu.max of a control group holds, microseconds of quota and of period; no more than `cores`.
int cores_of_quota(const std::string& cpu_max, int cores);

// By its affinity and the quotas of the control groups it is in (version 2 of them).
int cores_usable();

// Whether those are all that the machine has.
bool cores_are_all_usable();

}  // namespace brume
