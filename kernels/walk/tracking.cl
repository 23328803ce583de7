// Placement of the trackers [Woodcock65] [Novak14]: tentative collisions at a rate that nowhere is below σt ρ, brick by
// brick from each brick's own range of densities. A collision is a segment whose `size` is the mean distance between
// collisions there, so that ρ · size is an estimate of ∫ρ without bias.
#ifndef BRUME_WALK_TRACKING_CL
#define BRUME_WALK_TRACKING_CL
#include "density/dda.cl"
#include "lib/rng.cl"

#if BRUME_TRACKING

typedef struct {
  Random random;
  uint next;      // number of the next collision
  float sigma;    // extinction per density of the rate
  float left;     // optical distance, at the rate, that is left to the next collision
  float control;  // ∫ of the bricks' lower bounds since the last collision; stays 0 without `residual`
  int residual;   // the bricks' lower bounds are accounted for in closed form
  int only_tau;   // a shadow ray: only what exceeds the lower bounds needs collisions
  int trailing;   // the control behind the last collision has not been handed out
} Track;

// -log(1 - ξ); ξ is a multiple of 2^-24 below 1, so 1 - ξ is exact and positive.
static inline float track_distance(const Track* t) { return -log(1.0f - random_at(&t->random, t->next, RANDOM_PLACE)); }

static inline Track track_begin(const Medium* medium, Random random, int residual, int only_tau) {
  Track t;
  t.random = random;
  t.next = 0;
  t.sigma = medium->track_sigma;
  t.control = 0.0f;
  t.residual = residual;
  t.only_tau = only_tau;
  t.trailing = residual;
  t.left = track_distance(&t);
  return t;
}

static inline void track_emit(const Dda* d, Track* t, float size, float low, int i, Segments* out) {
  out->begin[i] = out->place[i] = d->s;
  out->size[i] = size;
  dda_brick_store(d, i, out);
  out->x[i] = d->x.brick * BRICK_CELLS;
  out->y[i] = d->y.brick * BRICK_CELLS;
  out->z[i] = d->z.brick * BRICK_CELLS;
  out->low[i] = low;
  out->control[i] = t->control;
  out->id[i] = t->next;
  t->control = 0.0f;
}

static inline void track_fill(const Scene* scene, const Medium* medium, Dda* d, Track* t, Segments* out) {
  int n = 0;
  while (n < W) {
    if (!(d->s < d->brick_end) && !dda_next_brick(scene, medium, d)) {
      if (t->trailing) {
        track_emit(d, t, 0.0f, 0.0f, n, out);
        // The walk has left the last brick: its next cells are not those of any, and may lie outside of all voxels.
        out->base[n] = 0;
        out->x[n] = out->y[n] = out->z[n] = 0.0f;
        ++n;
      }
      t->trailing = 0;
      break;
    }
    const float2 range = vload2(d->number, scene->ranges);
    const float low = t->residual ? range.x : 0.0f;
    const float rate = t->sigma * (t->only_tau ? range.y - low : range.y);
    const float rest = d->brick_end - d->s;
    if (rate * rest > t->left) {
      const float step = t->left / rate;
      t->control += low * step;
      // past the last digit of s the collision moves on by one digit: the walk ends whatever the rate
      d->s = fmax(d->s + step, nextafter(d->s, INFINITY));
      track_emit(d, t, 1.0f / rate, low, n++, out);
      ++t->next;
      t->left = track_distance(t);
    } else {
      t->left -= rate * rest;
      t->control += low * rest;
      d->s = d->brick_end;
    }
  }
  out->count = n;
  segments_pad(out);
}

#endif
#endif
