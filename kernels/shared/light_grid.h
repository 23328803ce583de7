// Light grids: the optical depth of all media from the points of a lattice about a medium, or about several on one
// spot, to one light.
// Planes k = 0 … nk-1 divide the medium's box evenly along one axis, columns (U, V) cross them all. The columns of a
// directional light run along it, so that each point's depth is that of the point before plus that between the two. To
// keep them inside the box every plane holds its own nu × nv of them, U from floor(slope_u k) and V from
// floor(slope_v k) on. Other lights: columns along an axis. In plane k the box lies over U from slope_u k + m to
// slope_u k + m + nu - 1 - 3m, with m = 1 for columns along the light, else 0. Points outside it or nearer to its sides
// than LIGHT_GRID_INSET are moved there: depths go on outside as they are at the side. A figure: ARCHITECTURE, Light
// grids.
#ifndef BRUME_SHARED_LIGHT_GRID_H
#define BRUME_SHARED_LIGHT_GRID_H
#include "shared/platform.h"

#define LIGHT_GRID_INSET 1e-4f  // of the spacing: a ray along a side stays in the box

BRUME_SHARED_BEGIN
// One entry per channel of τ (1 when all media are grey, else 3) and point: that of column (U, V) in plane k is at
// offset · channels + ((channel · nk + k) · nv + V - floor(slope_v k)) · nu + U - floor(slope_u k).
typedef struct {
  Affine grid_from_cell;  // of the medium's cell space -> (U, V, k)
  Affine cell_from_grid;
  int nu, nv, nk;  // at least 2 each
  int offset;      // entries of the grids before it
  float slope_u,
      slope_v;  // in [-1, 1]: how the box moves over the columns from plane to plane; 0 for lights without columns
  float column_step;     // world length of a column between two planes; 0 for lights without columns
  int from_first;        // the light comes from plane 0
  int first_u, first_v;  // the columns that meet the box anywhere
  int columns_u, columns_v;
  int media;  // that read these entries, each by maps of its own; those of the first fill them
  int pad[3];
} LightGrid;
BRUME_LAYOUT(LightGrid, 160);
BRUME_SHARED_END
#endif
