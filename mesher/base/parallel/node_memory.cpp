#include "mesher/base/parallel/node_memory.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "mesher/base/parallel/memory_file.hpp"

namespace quadloop {

namespace {

/// The bytes for the sender in a broadcast, which does not change them.
std::span<std::byte> to_send(const SharedArray<std::byte>& bytes) {
  return {const_cast<std::byte*>(bytes.data()), bytes.size()};
}

}  // namespace

NodeMemory::NodeMemory(const Communicator& comm)
    : node_{comm.ranks_of_node()}, firsts_{comm.ranks_with(node_.is_root() ? 0 : 1)} {}

NodeMemory::NodeMemory(const Communicator& comm, int node)
    : node_{comm.ranks_with(node)}, firsts_{comm.ranks_with(node_.is_root() ? 0 : 1)} {}

SharedArray<std::byte> NodeMemory::bytes_once_per_node(const SharedArray<std::byte>& of_first) const {
  std::vector<std::size_t> size{of_first.size()};
  if (node_.is_root()) firsts_.broadcast(size);
  node_.broadcast(size);
  if (size.front() == 0) return {};
  if (node_.size() > 1) return shared_in_node(of_first, size.front());
  std::vector<std::byte> bytes;
  if (!firsts_.is_root()) bytes.resize(size.front());
  firsts_.broadcast_bytes(firsts_.is_root() ? to_send(of_first) : bytes);
  return firsts_.is_root() ? of_first : bytes;
}

/// On the first rank of a node.
void NodeMemory::receive(const SharedArray<std::byte>& of_first, std::span<std::byte> bytes) const {
  if (firsts_.is_root()) std::ranges::copy(of_first, bytes.begin());
  firsts_.broadcast_bytes(bytes);
}

SharedArray<std::byte> NodeMemory::shared_in_node(const SharedArray<std::byte>& of_first,
                                                  std::size_t size) const {
  std::optional<MemoryFile> file;
  std::vector<std::byte> copy;  // where memory is not shared
  std::vector<MemoryFile::Place> place(1);
  if (node_.is_root()) {
    file = MemoryFile::of_size(size);
    if (!file) copy.resize(size);
    receive(of_first, file ? file->bytes() : copy);
    if (file) place.front() = file->place();
  }
  node_.broadcast(place);
  if (place.front().size > 0) {
    SharedArray<std::byte> shared = node_.is_root() ? SharedArray<std::byte>() : mapped(place.front());
    // The first rank closes the file when all have tried to map it.
    const bool refused = node_.any(!node_.is_root() && shared.empty());
    if (!refused) return node_.is_root() ? std::move(*file).finished() : shared;
    if (node_.is_root()) copy.assign(file->bytes().begin(), file->bytes().end());
  }
  copy.resize(size);
  node_.broadcast_bytes(copy);
  return copy;
}

}  // namespace quadloop
