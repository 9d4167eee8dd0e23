#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace quadloop {

/// A group of cooperating ranks; the only class that calls MPI. Every member function except rank() and
/// size() is *collective* (all ranks call it, in the same order) unless stated otherwise. Data are trivially
/// copyable values. There is no floating-point sum, as it would depend on the number of ranks: see
/// reproducible_sum().
class Communicator {
 public:
  /// In bytes. MPI counts are 32-bit, so longer data are sent in several messages.
  static constexpr std::size_t largest_message = std::size_t{1} << 30;

  explicit Communicator(MPI_Comm to_duplicate);
  ~Communicator();
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;

  /// Returns the group of those ranks that give the same number, in their order.
  Communicator ranks_with(int number) const;
  /// Returns the group of those ranks that are on the same node (machine) and can share memory.
  Communicator ranks_of_node() const;

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }
  MPI_Comm raw() const { return comm_; }

  std::int64_t sum(std::int64_t value) const;
  /// Sums entry by entry; every rank gives the same number of values.
  std::vector<std::int64_t> sum(std::span<const std::int64_t> values) const;
  std::int64_t minimum(std::int64_t value) const;
  std::int64_t maximum(std::int64_t value) const;
  double minimum(double value) const;
  double maximum(double value) const;
  bool any(bool value) const { return maximum(std::int64_t{value}) != 0; }
  /// Returns the sum of the values of all lower ranks.
  std::int64_t exclusive_sum(std::int64_t value) const;
  void barrier() const;
  /// A barrier for waits of seconds to hours, e.g. for another program. Waiting ranks sleep between polls, so
  /// that the processors are free; in barrier() they would keep them busy. The delay is up to 10 ms for each
  /// doubling of the number of ranks.
  void patient_barrier() const;

  /// Returns one value from every rank, in the order of ranks, on every rank.
  template <class T>
  std::vector<T> all_gather(const T& value) const;

  /// Returns the values of all ranks, concatenated, on every rank.
  template <class T>
  std::vector<T> all_gather_values(std::span<const T> values) const;

  /// Sends the values of rank `from` to every rank.
  template <class T>
  void broadcast(std::vector<T>& values, int from = 0) const;
  /// Sends the bytes of rank `from` to every rank, which has space for the same number. Any length: in pieces
  /// of at most `largest_piece` bytes.
  void broadcast_bytes(std::span<std::byte> bytes, int from = 0,
                       std::size_t largest_piece = largest_message) const;

  struct Count {
    int rank;
    std::int64_t count;
  };
  /// Number of ranks from which exchange_counts() avoids the messages between all pairs of ranks. On fewer
  /// ranks they are faster, as they need fewer turns of waiting.
  static constexpr int many_ranks = 128;
  /// Sends counts above 0 to some ranks, each at most once; returns those of the ranks that send one to this
  /// rank, ascending. On `many` ranks or more, only those exchange messages that have something to say to
  /// each other (non-blocking consensus; Hoefler, Siebert and Lumsdaine, PPoPP 2010).
  std::vector<Count> exchange_counts(std::span<const Count> to, int many = many_ranks) const;

  struct Outgoing {
    int to;
    std::span<const std::byte> bytes;
  };
  struct Incoming {
    int from;
    std::span<std::byte> bytes;  ///< receive buffer
  };
  /// Sends and receives the given messages; called only by the ranks involved. A rank may send to itself. For
  /// each outgoing message the receiver must have an incoming one of the same length. Any length: data are
  /// sent in pieces of at most `largest_piece` bytes.
  void exchange_messages(std::span<const Outgoing> out, std::span<const Incoming> in,
                         std::size_t largest_piece = largest_message) const;

  /// Point to point, not collective. Sending waits until the receiver asks: it buffers nothing. Any length.
  void send_bytes(std::span<const std::byte> bytes, int to) const;
  std::vector<std::byte> receive_bytes(int from) const;

  /// Runs `local` on every rank. If it throws on some ranks, all ranks throw the error of the lowest of
  /// these.
  void together(const std::function<void()>& local) const;
  /// Runs `local` on the first rank; the others wait as in patient_barrier(). If it throws, all ranks throw
  /// the error.
  void on_first(const std::function<void()>& local) const;

 private:
  struct ToOwn {
    MPI_Comm comm = MPI_COMM_NULL;
  };
  explicit Communicator(ToOwn to_own);

  std::vector<Count> counts_by_consensus(std::span<const Count> to) const;
  std::vector<std::byte> all_gather_bytes(std::span<const std::byte> bytes) const;
  std::size_t broadcast_size(std::size_t size, int from) const;

  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0;
  int size_ = 1;
  mutable int exchanges_ = 0;  ///< of counts: two in succession have different tags
};

/// Returns the strings of one rank on every rank; they must not contain zero bytes. *Collective.*
std::vector<std::string> broadcast_words(const Communicator& comm, const std::vector<std::string>& words,
                                         int from = 0);

namespace detail {

template <class T>
std::vector<T> from_bytes(std::span<const std::byte> bytes);

}  // namespace detail

}  // namespace quadloop

#include "mesher/base/parallel/communicator.ipp"
