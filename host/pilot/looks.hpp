// Pixels that tell of a whole picture before it is rendered.
#pragma once
#include "film/film.hpp"
#include "image/image.hpp"
#include "render/work.hpp"

namespace brume {

// The middles of squares of pixels, as large ones as leave few enough; and what they show in all pixels of theirs.
class Look {
 public:
  explicit Look(const Frame& frame);

  // Of `all` pixels of a film that is so wide, those in the middle of a square.
  WorkList work(const WorkList& all, int film_width) const;

  // The crop, of the film's size or less: each pixel as the middle of its square.
  Image picture(const Film& film) const;

 private:
  int middle(int at, int size) const;

  int x0_, y0_, width_, height_, side_;
};

// A few in a hundred of these, from all over the picture.
WorkList work_spread(const WorkList& all);

}  // namespace brume
