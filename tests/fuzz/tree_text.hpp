#pragma once

#include <string>
#include <string_view>

namespace quadloop::fuzz {

/// Writes the HDF5 file that a text describes, one item a line; other lines count for nothing:
///     attribute NAME TYPE VALUE                       a number, or text where TYPE is "text"
///     dataset NAME TYPE ROWS COLUMNS VALUE ...        COLUMNS 0: of one dimension; values that lack are 0
///     packed NAME TYPE ROWS COLUMNS VALUE ...         the same in compressed chunks
///     damage PLACE BIT                                of the finished file: one bit turned
/// TYPE is i1, i2, i4, i8, u4, u8 (bytes of an integer) or f8. Throws InputError for text that is no such
/// file, or one of more than a million numbers.
void write_tree_of_text(std::string_view text, const std::string& path);

}  // namespace quadloop::fuzz
