// A limit on this process's memory, so that no file takes more of it than the largest image that is read.
#pragma once

namespace brume {

// Once, before the first file is read: what is loaded by then and IMAGE_WORK_BYTES_MAX more. Beyond that,
// std::bad_alloc.
void memory_limit();

}  // namespace brume
