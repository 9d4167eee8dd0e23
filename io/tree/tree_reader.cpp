#include <utility>

#include "io/files/reading/separate_reader.hpp"
#include "io/tree/tree_check.hpp"
#include "io/tree/tree_file.hpp"
#include "io/tree/tree_share.hpp"

namespace quadloop::io {

TreeRecord read_tree(const Communicator& comm, const std::string& path) {
  TreeShare share;
  comm.together([&] {
    share =
        read_separately<TreeShare>("tree", path, {std::to_string(comm.rank()), std::to_string(comm.size())});
  });
  require_whole_tree(comm, share.tree, share.before, path);
  return std::move(share.tree);
}

}  // namespace quadloop::io
