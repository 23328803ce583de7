// Trees of plain files: first the masks of all nodes and the values of the inner ones, then the voxels of the leaves in
// the same order. Values are stored as openvdb::io::readCompressedValues takes them.
#include <blosc.h>
#include <zlib.h>

#include <Imath/half.h>

#include <algorithm>
#include <array>
#include <climits>

#include "vdb/plain_file.hpp"

namespace brume {

namespace {

constexpr std::uint32_t ZIP = 1, ACTIVE_MASK = 2, BLOSC = 4;
constexpr int LEAF_BITS = 3;
constexpr std::int32_t BUFFERS = 1;  // of a tree; more are of before 2013

// What stands before the values of a node: which the inactive ones are.
enum Inactive : std::int8_t { BACKGROUND, MINUS_BACKGROUND, ONE, TWO_BACKGROUNDS, ONE_AND_BACKGROUND, TWO, ALL_STORED };

template <std::size_t WORDS>
using Mask = std::array<std::uint64_t, WORDS>;

template <std::size_t WORDS>
bool is_on(const Mask<WORDS>& mask, std::size_t i) {
  return (mask[i >> 6] >> (i & 63) & 1) != 0;
}

template <std::size_t WORDS>
std::size_t count_on(const Mask<WORDS>& mask) {
  std::size_t count = 0;
  for (const std::uint64_t word : mask) count += static_cast<std::size_t>(__builtin_popcountll(word));
  return count;
}

class TreeReader {
 public:
  TreeReader(const PlainGrid& grid, const VolumeReadRequest& request)
      : grid_(grid), inside_(request.inside != 0), voxels_(request.voxels != 0), in_(grid.tree, grid.end) {}
  PlainVoxels read();

 private:
  struct Leaf {
    std::int32_t origin[3];
    Mask<8> on;
  };

  void stored_read(std::size_t bytes);
  void numbers_read(std::size_t count);
  template <std::size_t WORDS>
  void values_read(const Mask<WORDS>& on, float* out);
  template <int BITS, int BELOW>
  void node_read(const std::int32_t (&origin)[3]);
  void leaf_read(const Leaf& leaf);
  void tile_add(const std::int32_t (&lo)[3], std::int32_t side, bool on, float value);
  void count_leaf(const Leaf& leaf);
  bool takes(bool on, float value) {  // what is neither active nor background is counted
    if (!on && value != background_) ++out_.end.inactive;
    return on || (inside_ && value < 0);
  }

  const PlainGrid& grid_;
  const bool inside_, voxels_;
  PlainBytes in_;
  float background_ = 0;
  PlainVoxels out_{};
  std::vector<Leaf> leaves_;
  std::vector<char> raw_;       // what was compressed,
  std::vector<float> numbers_;  // and as floats
};

// Bytes into raw_.
void TreeReader::stored_read(std::size_t bytes) {
  raw_.resize(std::max<std::size_t>(bytes, 1));
  const bool packed = (grid_.compression & (BLOSC | ZIP)) != 0;
  const auto size = packed ? in_.take<std::int64_t>() : -static_cast<std::int64_t>(bytes);
  if (size <= 0) {  // as they are
    if (size != -static_cast<std::int64_t>(bytes)) throw NotPlain();
    std::memcpy(raw_.data(), in_.skip(bytes), bytes);
    return;
  }
  const auto packed_size = static_cast<std::size_t>(size);
  const char* const from = in_.skip(packed_size);
  if (grid_.compression & BLOSC) {
    std::size_t all = 0, here = 0, block = 0;
    if (packed_size >= BLOSC_MIN_HEADER_LENGTH) blosc_cbuffer_sizes(from, &all, &here, &block);
    if (all != bytes || here != packed_size) throw NotPlain();
    if (blosc_decompress_ctx(from, raw_.data(), bytes, 1) != static_cast<int>(bytes)) throw NotPlain();
    return;
  }
  uLongf all = bytes;
  const auto* const zipped = reinterpret_cast<const Bytef*>(from);
  if (uncompress(reinterpret_cast<Bytef*>(raw_.data()), &all, zipped, packed_size) != Z_OK || all != bytes)
    throw NotPlain();
}

void TreeReader::numbers_read(std::size_t count) {
  numbers_.resize(count);
  if (!grid_.half) {
    stored_read(count * sizeof(float));
    std::memcpy(numbers_.data(), raw_.data(), count * sizeof(float));
  } else if (count > 0) {
    stored_read(count * sizeof(std::uint16_t));
    for (std::size_t i = 0; i < count; ++i) {
      Imath::half value;
      std::memcpy(&value, raw_.data() + i * sizeof value, sizeof value);
      numbers_[i] = value;
    }
  }
}

template <std::size_t WORDS>
void TreeReader::values_read(const Mask<WORDS>& on, float* out) {
  const auto kind = in_.take<std::int8_t>();
  if (kind < BACKGROUND || kind > ALL_STORED) throw NotPlain();
  float inactive[2] = {kind == BACKGROUND ? background_ : -background_, background_};
  if (kind == ONE || kind == ONE_AND_BACKGROUND || kind == TWO) inactive[0] = in_.take<float>();
  if (kind == TWO) inactive[1] = in_.take<float>();
  Mask<WORDS> second{};
  if (kind == TWO_BACKGROUNDS || kind == ONE_AND_BACKGROUND || kind == TWO) second = in_.take<Mask<WORDS>>();
  const bool by_mask = (grid_.compression & ACTIVE_MASK) != 0 && kind != ALL_STORED;
  numbers_read(by_mask ? count_on(on) : 64 * WORDS);
  const float* stored = numbers_.data();
  for (std::size_t i = 0; i < 64 * WORDS; ++i)
    out[i] = !by_mask || is_on(on, i) ? *stored++ : inactive[is_on(second, i) ? 1 : 0];
}

void TreeReader::tile_add(const std::int32_t (&lo)[3], std::int32_t side, bool on, float value) {
  VolumeTopology& t = out_.topology;
  VolumeTile tile{};
  for (int axis = 0; axis < 3; ++axis) {
    tile.lo[axis] = lo[axis];
    tile.hi[axis] = lo[axis] + (side - 1);
    if (!on) continue;
    t.lo[axis] = std::min(t.lo[axis], tile.lo[axis]);
    t.hi[axis] = std::max(t.hi[axis], tile.hi[axis]);
  }
  if (on)
    t.active += static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side);
  tile.value = value;
  if (voxels_ && takes(on, value)) out_.tiles.push_back(tile);
}

void TreeReader::count_leaf(const Leaf& leaf) {
  VolumeTopology& t = out_.topology;
  std::uint64_t across = 0;  // all slices of one x in one another
  for (int x = 0; x < 8; ++x) {
    const std::uint64_t slice = leaf.on[static_cast<std::size_t>(x)];
    across |= slice;
    t.active += static_cast<std::uint64_t>(__builtin_popcountll(slice));
    if (slice == 0) continue;
    t.lo[0] = std::min(t.lo[0], leaf.origin[0] + x);
    t.hi[0] = std::max(t.hi[0], leaf.origin[0] + x);
  }
  for (int n = 0; n < 64; ++n) {
    if ((across >> n & 1) == 0) continue;
    const std::int32_t at[3] = {0, leaf.origin[1] + (n >> 3), leaf.origin[2] + (n & 7)};
    for (int axis = 1; axis < 3; ++axis) {
      t.lo[axis] = std::min(t.lo[axis], at[axis]);
      t.hi[axis] = std::max(t.hi[axis], at[axis]);
    }
  }
}

// A node of 2^BITS children a side, each of 2^BELOW voxels: the children below it are nodes of 4 bits, or leaves.
template <int BITS, int BELOW>
void TreeReader::node_read(const std::int32_t (&origin)[3]) {
  constexpr std::size_t COUNT = std::size_t{1} << (3 * BITS);
  constexpr std::int32_t SIDE = 1 << BELOW;
  const auto children = in_.take<Mask<COUNT / 64>>(), on = in_.take<Mask<COUNT / 64>>();
  std::vector<float> values(COUNT);
  values_read(on, values.data());
  for (std::size_t i = 0; i < COUNT; ++i) {
    const bool child = is_on(children, i);
    if (!child && !is_on(on, i) && values[i] == background_ && !(inside_ && background_ < 0)) continue;
    const auto n = static_cast<std::int32_t>(i);
    const std::int32_t mask = (1 << BITS) - 1;
    const std::int32_t lo[3] = {origin[0] + (n >> (2 * BITS)) * SIDE, origin[1] + ((n >> BITS) & mask) * SIDE,
                                origin[2] + (n & mask) * SIDE};
    if (!child) {
      tile_add(lo, SIDE, is_on(on, i), values[i]);
    } else if constexpr (BELOW == LEAF_BITS) {
      leaves_.push_back({{lo[0], lo[1], lo[2]}, in_.take<Mask<8>>()});
      count_leaf(leaves_.back());
    } else {
      node_read<BELOW - LEAF_BITS, LEAF_BITS>(lo);
    }
  }
}

void TreeReader::leaf_read(const Leaf& leaf) {
  in_.skip(sizeof leaf.on);  // once more
  float values[512];
  values_read(leaf.on, values);
  VolumeLeaf& out = out_.leaves.emplace_back();
  std::copy(std::begin(leaf.origin), std::end(leaf.origin), out.origin);
  for (std::size_t n = 0; n < 512; ++n) {
    if (!takes(is_on(leaf.on, n), values[n])) continue;
    out.active[n >> 6] |= std::uint64_t{1} << (n & 63);
    out.values[n] = values[n];
  }
}

PlainVoxels TreeReader::read() {
  VolumeTopology& t = out_.topology;
  std::fill_n(t.lo, 3, INT_MAX);
  std::fill_n(t.hi, 3, INT_MIN);
  if (in_.take<std::int32_t>() != BUFFERS) throw NotPlain();
  background_ = in_.take<float>();
  t.background = background_;
  const auto tiles = in_.take<std::uint32_t>(), children = in_.take<std::uint32_t>();
  if (tiles > 0) throw NotPlain();  // of 4096³ voxels
  std::array<std::int32_t, 3> last{};
  for (std::uint32_t i = 0; i < children; ++i) {
    const auto at = in_.take<std::array<std::int32_t, 3>>();
    const bool aligned = std::all_of(
        at.begin(), at.end(), [](std::int32_t x) { return (x & 4095) == 0 && x > INT_MIN / 2 && x < INT_MAX / 2; });
    if (!aligned || (i > 0 && !(last < at))) throw NotPlain();  // voxels come in the order of the map that is read
    last = at;
    node_read<5, 7>({at[0], at[1], at[2]});
  }
  if (t.active == 0) {
    std::fill_n(t.lo, 3, 0);
    std::fill_n(t.hi, 3, -1);
  }
  if (voxels_) {
    out_.leaves.reserve(leaves_.size());
    for (const Leaf& leaf : leaves_) leaf_read(leaf);
    if (in_.at() != grid_.end) throw NotPlain();
  }
  return std::move(out_);
}

}  // namespace

PlainVoxels plain_read(const PlainGrid& grid, const VolumeReadRequest& request) {
  PlainVoxels voxels = TreeReader(grid, request).read();
  VolumeTopology& t = voxels.topology;
  const bool miscounted = grid.counted && static_cast<std::uint64_t>(grid.count) != t.active;
  const bool elsewhere = t.active > 0 && ((grid.boxed[0] && !std::equal(t.lo, t.lo + 3, grid.box[0])) ||
                                          (grid.boxed[1] && !std::equal(t.hi, t.hi + 3, grid.box[1])));
  t.stale = miscounted || elsewhere;
  return voxels;
}

}  // namespace brume
