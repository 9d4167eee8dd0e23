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

/// A group of ranks that work together; the only place where MPI is called. Every member function but rank()
/// and size() is *collective* (all ranks enter it, in the same order) unless it says otherwise. Data are
/// trivially copyable values. There is no floating-point sum: its result would depend on the number of ranks.
class Communicator {
 public:
  /// In bytes. MPI counts are 32-bit: longer data go in pieces.
  static constexpr std::size_t largest_message = std::size_t{1} << 30;

  explicit Communicator(MPI_Comm to_duplicate);
  ~Communicator();
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }
  MPI_Comm raw() const { return comm_; }

  std::int64_t sum(std::int64_t value) const;
  std::int64_t minimum(std::int64_t value) const;
  std::int64_t maximum(std::int64_t value) const;
  double minimum(double value) const;
  double maximum(double value) const;
  bool any(bool value) const { return maximum(std::int64_t{value}) != 0; }
  /// The sum of the values of all lower ranks.
  std::int64_t exclusive_sum(std::int64_t value) const;
  void barrier() const;
  /// A barrier for a wait of seconds to hours: a rank that waits sleeps between its looks, so that the
  /// processors are free for another program, where barrier() keeps each of them busy. Ranks leave it up to
  /// 10 ms late for each doubling of their number.
  void patient_barrier() const;

  /// One value from every rank, in the order of ranks, on every rank.
  template <class T>
  std::vector<T> all_gather(const T& value) const;

  /// All ranks' values one after another, on every rank.
  template <class T>
  std::vector<T> all_gather_values(std::span<const T> values) const;

  /// The values of rank `from` on every rank.
  template <class T>
  void broadcast(std::vector<T>& values, int from = 0) const;

  /// One number for each rank; the result's entry r came from rank r.
  std::vector<std::int64_t> exchange_counts(const std::vector<std::int64_t>& to_rank) const;

  struct Outgoing {
    int to;
    std::span<const std::byte> bytes;
  };
  struct Incoming {
    int from;
    std::span<std::byte> bytes;  ///< room for them
  };
  /// Point to point, entered by the ranks named alone, self included: each expects one message of just that
  /// length from those that send to it. Any length: it goes in pieces of at most `largest_piece` bytes.
  void exchange_messages(std::span<const Outgoing> out, std::span<const Incoming> in,
                         std::size_t largest_piece = largest_message) const;

  /// Point to point, not collective: sends to, receives from one rank. Any length.
  void send_bytes(std::span<const std::byte> bytes, int to) const;
  std::vector<std::byte> receive_bytes(int from) const;

  /// Runs `local` on every rank; if it throws on any, the lowest such rank's Error is thrown on all.
  void together(const std::function<void()>& local) const;

 private:
  std::vector<std::byte> all_gather_bytes(std::span<const std::byte> bytes) const;
  void broadcast_bytes(std::vector<std::byte>& bytes, int from) const;

  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0;
  int size_ = 1;
};

/// The root's words on every rank; none holds a zero byte. *Collective.*
std::vector<std::string> broadcast_words(const Communicator& comm, const std::vector<std::string>& words);

namespace detail {

template <class T>
std::vector<T> from_bytes(std::span<const std::byte> bytes);

}  // namespace detail

}  // namespace quadloop

#include "mesher/base/parallel/communicator.ipp"
