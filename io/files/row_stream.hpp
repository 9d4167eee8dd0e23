#pragma once

#include <algorithm>
#include <cstdint>
#include <exception>
#include <functional>
#include <numeric>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/base/progress.hpp"

namespace quadloop::io {

/// Streams distributed rows through rank 0 in pieces: all of rank 0, then all of rank 1, and so on.
struct RowStream {
  const Communicator& comm;
  std::int64_t rows = 0;            ///< of this rank
  std::int64_t rows_per_piece = 1;  ///< limits the memory on rank 0

  template <class T>
  using Make = std::function<std::vector<T>(std::int64_t begin, std::int64_t end)>;
  template <class T>
  using Consume = std::function<void(std::span<const T> piece)>;

  static constexpr std::int64_t pieces_ahead = 8;  ///< created by a rank while it waits for its turn

  std::int64_t pieces() const { return (rows + rows_per_piece - 1) / rows_per_piece; }
  std::int64_t begin_of(std::int64_t piece) const { return std::min(rows, piece * rows_per_piece); }

  /// `make(begin, end)` returns a std::vector<T> for the rank's own rows begin .. end-1 (of any length);
  /// `consume` receives a std::span<const T> for each piece, on rank 0 only. An exception in either ends the
  /// call on every rank, without deadlock. *Collective.*
  template <class T>
  void run(const Make<T>& make, const Consume<T>& consume) const {
    const std::vector<std::int64_t> pieces_of_rank = comm.all_gather(pieces());
    comm.together([&] {
      if (comm.is_root()) {
        take_all<T>(pieces_of_rank, make, consume);
      } else {
        send_all<T>(make);
      }
    });
  }

 private:
  /// After a failure the other ranks' pieces are still received, as those ranks would otherwise wait forever.
  template <class T>
  void take_all(const std::vector<std::int64_t>& pieces_of_rank, const Make<T>& make,
                const Consume<T>& consume) const {
    std::exception_ptr failure;
    progress::Stage stage(
        "writing",
        static_cast<double>(std::accumulate(pieces_of_rank.begin(), pieces_of_rank.end(), std::int64_t{0})),
        "pieces");
    double pieces_done = 0;
    const auto attempt = [&](const auto& action) {
      try {
        if (!failure) action();
      } catch (...) {
        failure = std::current_exception();
      }
    };
    for (std::int64_t k = 0; k < pieces(); ++k) {
      attempt([&] { consume(std::span<const T>(make(begin_of(k), begin_of(k + 1)))); });
      stage.advance(++pieces_done);
    }
    for (int from = 1; from < comm.size(); ++from) {
      for (std::int64_t k = 0; k < pieces_of_rank[from]; ++k) {
        const std::vector<std::byte> bytes = comm.receive_bytes(from);
        attempt([&] { consume(std::span<const T>(detail::from_bytes<T>(bytes))); });
        stage.advance(++pieces_done);
      }
    }
    if (failure) std::rethrow_exception(failure);
  }

  /// A rank that fails still sends as many pieces as it announced, empty ones.
  template <class T>
  void send_all(const Make<T>& make) const {
    std::exception_ptr failure;
    const auto made = [&](std::int64_t k) -> std::vector<T> {
      try {
        if (!failure) return make(begin_of(k), begin_of(k + 1));
      } catch (...) {
        failure = std::current_exception();
      }
      return {};
    };
    std::vector<std::vector<T>> ahead;
    for (std::int64_t k = 0; k < std::min(pieces(), pieces_ahead); ++k) ahead.push_back(made(k));
    for (std::int64_t k = 0; k < pieces(); ++k) {
      const std::vector<T> piece = k < pieces_ahead ? std::move(ahead[k]) : made(k);
      comm.send_bytes(std::as_bytes(std::span<const T>(piece)), 0);
    }
    if (failure) std::rethrow_exception(failure);
  }
};

}  // namespace quadloop::io
