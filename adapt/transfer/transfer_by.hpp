#pragma once

#include <functional>

#include "adapt/transfer/transfer.hpp"

namespace quadloop::adapt {

/// A transfer of the caller: returns the variables of the old field, in their order, with a row for each
/// owned node and each cell of the new mesh. *Collective.*
using TransferFunction =
    std::function<Field(const Mesh& old_mesh, const Field& old_field, const Mesh& new_mesh)>;

/// Transfers by a function, and reports the drift. Throws InputError for other variables or rows.
/// *Collective.*
Transferred transfer_by(const Communicator& comm, const Mesh& old_mesh, const Field& old_field,
                        const Mesh& new_mesh, const TransferFunction& function);

/// A transfer between two meshes of one block.
using TransferInBlock =
    std::function<Transferred(const Mesh& old_mesh, const Field& old_field, const Mesh& new_mesh)>;

/// Each block as a mesh of its own, as in transfer(). *Collective.*
Transferred transfer_by_block(const Communicator& comm, const Mesh& old_mesh, const Field& old_field,
                              const Mesh& new_mesh, const TransferInBlock& in_block);

}  // namespace quadloop::adapt
