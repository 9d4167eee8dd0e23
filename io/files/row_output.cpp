#include "io/files/row_output.hpp"

#include <algorithm>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/base/progress.hpp"

namespace quadloop::io {

namespace {

/// Writes bytes at increasing offsets; combines short ones that follow each other.
class Sequence {
 public:
  explicit Sequence(SharedOutput& file) : file_{file} {}

  void move_to(std::int64_t offset) {
    if (offset == end_) return;
    flush();
    end_ = offset;
  }
  void put(std::string_view bytes) {
    end_ += std::ssize(bytes);
    if (waiting_.empty() && bytes.size() >= large) return file_.write_at(end_ - std::ssize(bytes), bytes);
    waiting_ += bytes;
    if (waiting_.size() >= large) flush();
  }
  void flush() {
    file_.write_at(end_ - std::ssize(waiting_), waiting_);
    waiting_.clear();
  }
  std::int64_t end() const { return end_; }

 private:
  static constexpr std::size_t large = std::size_t{1} << 20;
  SharedOutput& file_;
  std::int64_t end_ = 0;
  std::string waiting_;  ///< the bytes before end_
};

/// The bytes of one rank's rows, which are made piece by piece.
class OwnBytes {
 public:
  OwnBytes(const RowSections& sections, const RowOutput::Make& make) : sections_{sections}, make_{make} {
    for (std::size_t s = 0; s < count(); ++s)
      lengths_.push_back(std::ssize(head(s)) + sections.rows[s] * sections.row_bytes);
  }

  /// Of each section, with its head; known after measure() or write_from() if rows vary in length.
  const std::vector<std::int64_t>& lengths() const { return lengths_; }

  /// Makes all rows, and holds the first of them, up to `most_held` bytes.
  void measure(std::int64_t most_held) {
    progress::Stage stage("measuring", static_cast<double>(pieces()), "pieces");
    std::int64_t left = most_held;
    for_each_piece([&](std::size_t s, std::int64_t begin, std::int64_t end) {
      const std::string_view bytes = make_(s, begin, end);
      lengths_[s] += std::ssize(bytes);
      stage.advance(static_cast<double>(++made_));
      left -= std::ssize(bytes);
      if (left >= 0) held_.emplace_back(bytes);
    });
  }

  /// Writes the sections at their places.
  void write_at(SharedOutput& file, const std::vector<std::int64_t>& places) {
    write(file, [&](std::size_t s, std::int64_t) { return places[s]; });
  }
  /// Writes the sections one after another, before their lengths are known.
  void write_from(SharedOutput& file, std::int64_t place) {
    std::fill(lengths_.begin(), lengths_.end(), 0);
    write(file, [&](std::size_t s, std::int64_t end) { return s == 0 ? place : end; });
  }

 private:
  std::size_t count() const { return sections_.rows.size(); }
  std::string_view head(std::size_t s) const {
    return s < sections_.heads.size() ? std::string_view(sections_.heads[s]) : std::string_view();
  }
  std::int64_t pieces() const {
    std::int64_t sum = 0;
    for (const std::int64_t rows : sections_.rows)
      sum += (rows + sections_.rows_per_piece - 1) / sections_.rows_per_piece;
    return sum;
  }
  template <class Visit>
  void for_each_piece_of(std::size_t s, const Visit& visit) const {
    const std::int64_t rows = sections_.rows[s], most = sections_.rows_per_piece;
    for (std::int64_t begin = 0; begin < rows; begin += most) visit(s, begin, std::min(rows, begin + most));
  }
  template <class Visit>
  void for_each_piece(const Visit& visit) const {
    for (std::size_t s = 0; s < count(); ++s) for_each_piece_of(s, visit);
  }

  /// `place(s, end)`: the offset of section s; `end` is the end of what was written before.
  template <class Place>
  void write(SharedOutput& file, const Place& place) {
    progress::Stage stage("writing", static_cast<double>(pieces()), "pieces");
    Sequence sequence(file);
    std::size_t written = 0;
    for (std::size_t s = 0; s < count(); ++s) {
      const std::int64_t begin = place(s, sequence.end());
      sequence.move_to(begin);
      sequence.put(head(s));
      for_each_piece_of(s, [&](std::size_t, std::int64_t first, std::int64_t last) {
        sequence.put(written < held_.size() ? std::string_view(held_[written]) : make_(s, first, last));
        if (written < held_.size()) std::string().swap(held_[written]);
        stage.advance(static_cast<double>(++written));
      });
      lengths_[s] = sequence.end() - begin;
    }
    sequence.flush();
  }

  const RowSections& sections_;
  const RowOutput::Make& make_;
  std::vector<std::int64_t> lengths_;
  std::vector<std::string> held_;  ///< the first pieces
  std::int64_t made_ = 0;
};

}  // namespace

void RowOutput::move_to(std::int64_t offset) {
  QUADLOOP_REQUIRE(waiting_.empty(), "bytes that were not written before moving");
  end_ = offset;
}

/// Rank 0 knows where its first section begins before any length is known, and where all do if it is alone.
void RowOutput::write_sections(RowSections sections, const Make& make) {
  if (sections.rows.empty()) return;
  QUADLOOP_REQUIRE(sections.places.empty() || (sections.row_bytes > 0 && waiting_.empty()),
                   "places are for rows of one length");
  if (!waiting_.empty()) {
    sections.heads.resize(sections.rows.size());
    sections.heads[0].insert(0, std::exchange(waiting_, {}));
  }
  OwnBytes own(sections, make);
  const bool at_once = communicator().is_root() && (communicator().size() == 1 || sections.rows.size() == 1);
  if (sections.row_bytes == 0) {
    file_.together([&] { at_once ? own.write_from(file_, end_) : own.measure(most_held_); });
  }
  const bool is_written = at_once && sections.row_bytes == 0;
  const std::vector<std::int64_t> places = take_places(sections, own.lengths());
  file_.together([&] {
    if (!is_written) own.write_at(file_, places);
  });
}

/// Returns where this rank's part of each section begins; the end is then that of the last one. *Collective.*
std::vector<std::int64_t> RowOutput::take_places(const RowSections& sections,
                                                 const std::vector<std::int64_t>& lengths) {
  const Communicator& comm = communicator();
  if (!sections.places.empty()) end_ = sections.places[0];
  if (lengths.size() == 1) {
    const std::int64_t place = end_ + comm.exclusive_sum(lengths[0]);
    end_ += comm.sum(lengths[0]);
    return {place};
  }
  struct Share {
    std::int64_t section, rank, bytes;
  };
  std::vector<Share> own;
  for (std::size_t s = 0; s < lengths.size(); ++s) {
    if (lengths[s] > 0) own.push_back({static_cast<std::int64_t>(s), comm.rank(), lengths[s]});
  }
  std::vector<Share> all = comm.all_gather_values(std::span<const Share>(own));
  std::ranges::stable_sort(all, {}, &Share::section);
  std::vector<std::int64_t> places(lengths.size(), end_);
  std::int64_t section = 0;
  for (const Share& share : all) {
    if (share.section != section && !sections.places.empty()) end_ = sections.places[share.section];
    section = share.section;
    if (share.rank == comm.rank()) places[share.section] = end_;
    end_ += share.bytes;
  }
  return places;
}

std::pair<std::int64_t, std::int64_t> RowOutput::share_of(std::int64_t count) const {
  const std::int64_t ranks = communicator().size(), rank = communicator().rank();
  const std::int64_t each = count / ranks, more = count % ranks;
  const std::int64_t begin = each * rank + std::min(more, rank);
  return {begin, begin + each + (rank < more ? 1 : 0)};
}

void RowOutput::close() {
  file_.together([&] { file_.write_at(end_, std::exchange(waiting_, {})); });
  file_.close();
}

}  // namespace quadloop::io
