#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "io/files/reading/value_pipe.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::io {

/// Values as bytes in memory, for pass().
class PackedWriter {
 public:
  static constexpr bool reads = false;

  void bytes(const void* from, std::size_t size) {
    const auto* const begin = static_cast<const std::byte*>(from);
    packed.insert(packed.end(), begin, begin + size);
  }

  std::vector<std::byte> packed;
};

class PackedReader {
 public:
  static constexpr bool reads = true;

  explicit PackedReader(std::span<const std::byte> packed) : packed_{packed} {}

  void bytes(void* to, std::size_t size) {
    QUADLOOP_REQUIRE(size <= packed_.size(), "packed values end early", size);
    if (size > 0) std::memcpy(to, packed_.data(), size);
    packed_ = packed_.subspan(size);
  }

 private:
  std::span<const std::byte> packed_;
};

/// Returns a value as bytes, and from them.
template <class Value>
std::vector<std::byte> packed(Value& value) {
  PackedWriter writer;
  pass(writer, value);
  return std::move(writer.packed);
}
template <class Value>
Value unpacked(std::span<const std::byte> bytes) {
  Value value{};
  PackedReader reader(bytes);
  pass(reader, value);
  return value;
}

/// Gives every rank the value of one rank. *Collective.*
template <class Value>
void broadcast_value(const Communicator& comm, Value& value, int from = 0) {
  if (comm.size() == 1) return;
  std::vector<std::byte> bytes;
  if (comm.rank() == from) bytes = packed(value);
  comm.broadcast(bytes, from);
  if (comm.rank() != from) value = unpacked<Value>(bytes);
}

/// Returns the values of all ranks, in the order of ranks, on every rank. *Collective.*
template <class Value>
std::vector<Value> gather_values(const Communicator& comm, Value& own) {
  const std::vector<std::byte> bytes = packed(own),
                               all = comm.all_gather_values(std::span<const std::byte>(bytes));
  std::vector<Value> values(comm.size());
  PackedReader reader(all);
  for (Value& value : values) pass(reader, value);
  return values;
}

/// Lets the ranks continue the work on a value one after another, in their order: `work(value)`, which should
/// be short and must not throw. The value before, which is used on the first rank only, is the same type's
/// default. Returns the last rank's result on all ranks. *Collective.*
template <class Value, class Work>
Value relay(const Communicator& comm, const Work& work) {
  const int last = comm.size() - 1;
  Value value = comm.is_root() ? Value{} : unpacked<Value>(comm.receive_bytes(comm.rank() - 1));
  work(value);
  if (comm.rank() < last) comm.send_bytes(packed(value), comm.rank() + 1);
  broadcast_value(comm, value, last);
  return value;
}

}  // namespace quadloop::io
