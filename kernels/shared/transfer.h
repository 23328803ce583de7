// From linear light to what a screen is given: curves of the display formats. No kernel needs them.
#ifndef BRUME_SHARED_TRANSFER_H
#define BRUME_SHARED_TRANSFER_H
#include "shared/platform.h"

// ROW(ID, name, help)
#define BRUME_TRANSFERS(ROW)                \
  ROW(GAMMA, "gamma", "a power, x^(1/2.2)") \
  ROW(SRGB, "srgb", "the curve of sRGB, linear near black [IEC 61966-2-1]")

BRUME_SHARED_BEGIN
enum Transfer {
#define ROW(id, name, help) TRANSFER_##id,
  BRUME_TRANSFERS(ROW)
#undef ROW
      TRANSFER_COUNT
};
BRUME_SHARED_END
#endif
