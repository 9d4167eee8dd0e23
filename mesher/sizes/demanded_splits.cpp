#include "mesher/sizes/demanded_splits.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/base/morton.hpp"

namespace quadloop {

namespace {

constexpr std::size_t block = 16;
constexpr std::uint8_t children_bits = 0xf, asked_bit = 0x10;
constexpr std::uint64_t children_of_word = 0x0f0f0f0f0f0f0f0fULL;

/// Returns the key of the quadrant of this level that contains q. Deeper quadrants are never split:
/// coordinates in units of the quadrant size fit into 32 bits.
std::uint64_t key_of(const Quadrant& q, int level) {
  const int shift = Quadrant::unit_level - level;
  return morton_key(static_cast<std::uint32_t>(q.x >> shift), static_cast<std::uint32_t>(q.y >> shift));
}

void make_unique(std::vector<std::uint64_t>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

/// Returns the keys with all their ancestors.
template <class KeysOfLevels>
KeysOfLevels with_ancestors(KeysOfLevels keys) {
  for (std::size_t level = keys.size() - 1; level > 0; --level) {
    for (const std::uint64_t key : keys[level]) {
      if (keys[level - 1].empty() || keys[level - 1].back() != key >> 2) keys[level - 1].push_back(key >> 2);
    }
    make_unique(keys[level - 1]);
  }
  return keys;
}

}  // namespace

/// The requested keys of one rank, sorted.
DemandedSplits::KeysOfLevels DemandedSplits::keys_of(std::span<const SplitDemand> demands) {
  KeysOfLevels asked;
  for (const SplitDemand& demand : demands) {
    for (std::uint32_t levels = demand.levels; levels != 0; levels &= levels - 1) {
      const int level = std::countr_zero(levels);
      QUADLOOP_REQUIRE(level <= demand.leaf.level && level < Quadrant::unit_level - 1,
                       "a split below its leaf, or below the lattice");
      auto& keys = asked[level];
      const std::uint64_t key = key_of(demand.leaf, level);
      if (keys.empty() || keys.back() != key) keys.push_back(key);
    }
  }
  for (auto& keys : asked) make_unique(keys);
  return asked;
}

/// The requested keys of all ranks. Each rank sends its roots and masks: little more than a byte for each
/// key.
DemandedSplits::KeysOfLevels DemandedSplits::gather_asked(const Communicator& comm,
                                                          std::span<const SplitDemand> demands) {
  DemandedSplits own;
  own.assign(keys_of(demands));
  struct Sizes {
    std::size_t roots, masks;
  };
  const std::vector<Sizes> sizes = comm.all_gather(Sizes{own.roots_.size(), own.masks_.size()});
  KeysOfLevels asked;
  if (std::ranges::all_of(sizes, [](const Sizes& of_rank) { return of_rank.masks == 0; })) return asked;
  const std::vector<Key> roots = comm.all_gather_values(std::span<const Key>(own.roots_));
  const std::vector<std::uint8_t> masks = comm.all_gather_values(std::span<const std::uint8_t>(own.masks_));
  std::span<const Key> roots_left(roots);
  std::span<const std::uint8_t> masks_left(masks);
  for (const Sizes& of_rank : sizes) {
    append_asked(roots_left.first(of_rank.roots), masks_left.first(of_rank.masks), asked);
    roots_left = roots_left.subspan(of_rank.roots);
    masks_left = masks_left.subspan(of_rank.masks);
  }
  for (auto& keys : asked) make_unique(keys);
  return asked;
}

DemandedSplits::DemandedSplits(const Communicator& comm, std::span<const SplitDemand> demands) {
  assign(gather_asked(comm, demands));
}

DemandedSplits::DemandedSplits(const Communicator& comm, std::span<const SplitDemand> demands,
                               const DemandedSplits& before)
    : for_layers_{true} {
  KeysOfLevels asked = gather_asked(comm, demands);
  append_asked(before.roots_, before.masks_, asked);
  for (auto& keys : asked) make_unique(keys);
  assign(asked);
}

void DemandedSplits::assign(const KeysOfLevels& asked) {
  const KeysOfLevels all = with_ancestors(asked);
  std::int32_t first = 0;
  for (std::size_t level = 0; level < all.size() && !all[level].empty(); ++level) {
    const auto begin = size32(masks_);
    append_level(all[level], asked[level],
                 level == 0 ? std::span<const Key>{} : std::span<const Key>(all[level - 1]), first);
    first = begin;
    finest_ = static_cast<int>(level) + 1;
    finest_in_.resize(masks_.size(), static_cast<std::int8_t>(finest_));
  }
  raise_finest();
  roots_ = all[0];
  std::int32_t children = 0;
  for (std::size_t i = 0; i < masks_.size(); ++i) {
    if (i % block == 0) children_before_.push_back(children);
    children += std::popcount(static_cast<unsigned>(masks_[i] & children_bits));
  }
}

/// From the last quadrant to the first; the children of a quadrant are the last ones that remain.
void DemandedSplits::raise_finest() {
  std::size_t child = masks_.size();
  for (std::size_t i = masks_.size(); i-- > 0;) {
    const int children = std::popcount(static_cast<unsigned>(masks_[i] & children_bits));
    for (int k = 0; k < children; ++k) finest_in_[i] = std::max(finest_in_[i], finest_in_[--child]);
  }
}

void DemandedSplits::append_asked(std::span<const Key> roots, std::span<const std::uint8_t> masks,
                                  KeysOfLevels& asked) {
  std::vector<Key> keys(roots.begin(), roots.end()), below;
  std::size_t number = 0;
  for (std::size_t level = 0; !keys.empty(); ++level) {
    below.clear();
    for (const Key key : keys) {
      const std::uint8_t mask = masks[number++];
      if ((mask & asked_bit) != 0) asked[level].push_back(key);
      for (Key child = 0; child < 4; ++child) {
        if ((mask >> child & 1) != 0) below.push_back(key << 2 | child);
      }
    }
    keys.swap(below);
  }
}

/// `first_above` is the number of the first quadrant of the level above, which is linked to its children.
void DemandedSplits::append_level(std::span<const Key> all, std::span<const Key> asked,
                                  std::span<const Key> above, std::int32_t first_above) {
  std::size_t next_asked = 0, parent = 0;
  for (const Key key : all) {
    const bool is_asked = next_asked < asked.size() && asked[next_asked] == key;
    if (is_asked) ++next_asked;
    masks_.push_back(is_asked ? asked_bit : 0);
    if (above.empty()) continue;
    while (above[parent] != key >> 2) ++parent;
    masks_[first_above + parent] |= static_cast<std::uint8_t>(1U << (key & 3));
  }
}

std::int32_t DemandedSplits::root(std::int64_t tree_x, std::int64_t tree_y) const {
  const Key key = key_of({tree_x << Quadrant::unit_level, tree_y << Quadrant::unit_level, 0}, 0);
  const auto found = std::lower_bound(roots_.begin(), roots_.end(), key);
  return found == roots_.end() || *found != key ? none : static_cast<std::int32_t>(found - roots_.begin());
}

std::int32_t DemandedSplits::child(std::int32_t number, Corner quarter) const {
  const int k = curve_index(quarter);
  const std::size_t at = number;
  if ((masks_[at] >> k & 1) == 0) return none;
  std::array<std::uint64_t, block / sizeof(std::uint64_t)>
      masks{};  // masks of the block up to this one: whole words are counted at once
  if (at % block != 0) std::memcpy(masks.data(), &masks_[at - at % block], at % block);
  std::int32_t before = children_before_[at / block];
  for (const std::uint64_t word : masks) before += std::popcount(word & children_of_word);
  before += std::popcount(static_cast<unsigned>(masks_[at]) & ((1U << k) - 1));
  return size32(roots_) + before;
}

bool DemandedSplits::asked(std::int32_t number) const { return (masks_[number] & asked_bit) != 0; }

/// Keeps the steps that also lead to this leaf.
void DemandPath::keep_above(const Quadrant& leaf) {
  const std::uint64_t different = (leaf.x ^ last_.x) | (leaf.y ^ last_.y);
  const int common = Quadrant::unit_level -
                     static_cast<int>(std::bit_width(different));  // negative if even the trees differ
  const int kept = std::min({size32(steps_), common + 1, leaf.level + 1});
  steps_.resize(std::max(kept, 0));
  last_ = leaf;
}

std::uint32_t DemandPath::levels_above(const Quadrant& leaf) {
  if (demanded_->empty()) return 0;
  keep_above(leaf);
  if (steps_.empty())
    steps_.push_back({demanded_->root(leaf.x >> Quadrant::unit_level, leaf.y >> Quadrant::unit_level), 0});
  while (true) {
    const auto [number, levels] = steps_.back();
    const int level = size32(steps_) - 1;
    if (number == DemandedSplits::none || level == leaf.level) return levels;
    const Corner quarter = quarter_at(leaf.x, leaf.y, level);
    steps_.push_back(
        {demanded_->child(number, quarter), levels | (demanded_->asked(number) ? 1U << level : 0U)});
  }
}

}  // namespace quadloop
