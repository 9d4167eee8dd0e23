#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/files/binary_output.hpp"
#include "io/files/boundary_stream.hpp"
#include "io/files/shared_output.hpp"

namespace quadloop::io {

/// The rows of one rank, which are appended to a file section by section.
struct RowSections {
  std::vector<std::int64_t> rows;       ///< of this rank in each section; all ranks have the same sections
  std::int64_t row_bytes = 0;           ///< of each row; 0 if it varies
  std::int64_t rows_per_piece = 1;      ///< limits the memory
  std::vector<std::string> heads = {};  ///< on rank 0: the bytes before each section; may be empty
  /// Where each section begins, in space that was reserved; empty: each follows the one before it.
  std::vector<std::int64_t> places = {};
};

/// A file to which all ranks append rows at once: of each section first the rows of rank 0, then those of
/// rank 1, and so on. Each rank writes its own bytes; their places follow from the lengths on lower ranks,
/// so that the file does not depend on the number of ranks. A rank holds one piece of its rows at a time; of
/// rows of varying length, also the bytes made before their place is known, within a limit, beyond which they
/// are made twice.
class RowOutput {
 public:
  static constexpr std::int64_t usually_held = std::int64_t{1} << 26;  ///< bytes

  /// `most_held`: the limit for bytes without a place. *Collective.*
  RowOutput(OutputSet& outputs, const StagedFile& staged, std::int64_t most_held = usually_held)
      : file_{outputs, staged}, most_held_{most_held} {}

  const Communicator& communicator() const { return file_.communicator(); }

  /// Appends rank 0's bytes; they are written together with what follows. Not collective.
  void write(std::string_view bytes) {
    if (communicator().is_root()) waiting_ += bytes;
  }

  /// Continues at this offset, where space may have been reserved. All ranks must call it.
  void move_to(std::int64_t offset);

  using Make = std::function<std::string_view(std::size_t section, std::int64_t begin, std::int64_t end)>;
  /// Appends sections: `make` returns the bytes of this rank's rows begin to end - 1 of a section; they need
  /// to be valid until the next call. It may be called twice for the same rows. *Collective.*
  void write_sections(RowSections sections, const Make& make);

  /// Appends the rows of all ranks: `make(i)`, this rank's row i, is an array of numbers in the byte order of
  /// the file. *Collective.*
  template <class Make>
  void write_rows(std::int64_t rows, const Make& make) {
    write_made<decltype(make(std::int64_t{0}))>({{rows}},
                                                [&](std::size_t, std::int64_t i) { return make(i); });
  }
  /// Appends `count` rows, given by their number over all ranks, which share the work. *Collective.*
  template <class Make>
  void write_shared_rows(std::int64_t count, const Make& make) {
    const auto [begin, end] = share_of(count);
    write_rows(end - begin, [&, first = begin](std::int64_t i) { return make(first + i); });
  }
  /// Appends `on_each` rows for each boundary edge: `make(edge, k)`; those of each boundary at its place, if
  /// there are `places`. *Collective.*
  template <class Make>
  void write_edges(const BoundaryStream& edges, std::int64_t on_each, const Make& make,
                   std::vector<std::int64_t> places = {}) {
    write_made<decltype(make(BoundaryStream::Edge{}, std::int64_t{0}))>(
        {.rows = edges.own_rows(on_each), .places = std::move(places)},
        [&](std::size_t n, std::int64_t i) { return make(edges.own_edge(n, i / on_each), i % on_each); });
  }

  /// *Collective.*
  void close();

 private:
  template <class Row, class Make>
  void write_made(RowSections sections, const Make& make) {
    std::vector<Row> made;
    sections.row_bytes = sizeof(Row);
    sections.rows_per_piece = bytes_per_piece / sections.row_bytes;
    write_sections(std::move(sections), [&](std::size_t section, std::int64_t begin, std::int64_t end) {
      made.clear();
      for (std::int64_t i = begin; i < end; ++i) made.push_back(make(section, i));
      return bytes_of(std::span<const Row>(made));
    });
  }

  std::pair<std::int64_t, std::int64_t> share_of(std::int64_t count) const;
  std::vector<std::int64_t> take_places(const RowSections& sections,
                                        const std::vector<std::int64_t>& lengths);

  static constexpr std::int64_t bytes_per_piece = std::int64_t{1} << 20;

  SharedOutput file_;
  std::int64_t most_held_;
  std::int64_t end_ = 0;  ///< of what all ranks have written
  std::string waiting_;   ///< on rank 0: bytes that follow it
};

}  // namespace quadloop::io
