#include "io/text/range_tokens.hpp"

#include <algorithm>

#include "io/text/tokens.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

RangeTokens::RangeTokens(const Communicator& comm, const std::string& path, std::size_t piece)
    : range_{comm, path, piece} {
  comm.together([&] { count_pieces(); });
  begin_ = comm.exclusive_sum(pieces_.back().tokens);
  end_ = begin_ + pieces_.back().tokens;
  first_line_ = 1 + comm.exclusive_sum(pieces_.back().lines);
}

/// The last entry is behind the last piece.
void RangeTokens::count_pieces() {
  Piece before{range_.begin(), 0, 0};
  while (before.place < range_.end()) {
    pieces_.push_back(before);
    const std::string_view text = range_.piece_at(before.place);
    const char* const end = text.data() + text.size();
    for (const char* at = next_token(text.data(), end, comment); at != end;
         at = next_token(end_of_token(at, end), end, comment))
      ++before.tokens;
    before.lines += std::count(text.begin(), text.end(), '\n');
    before.place += std::ssize(text);
  }
  pieces_.push_back(before);
}

void RangeTokens::load(std::size_t piece) {
  text_ = range_.piece_at(pieces_[piece].place);
  loaded_ = piece;
  at_ = text_.data();
  number_ = begin_ + pieces_[piece].tokens;
  behind_token_ = false;
}

void RangeTokens::go_to(std::int64_t number) {
  QUADLOOP_REQUIRE(begin_ <= number && number < end_, "a token of another rank is read", number);
  const std::int64_t own = number - begin_;
  const bool is_loaded =
      !text_.empty() && pieces_[loaded_].tokens <= own && own < pieces_[loaded_ + 1].tokens;
  if (!is_loaded) {
    const auto after = std::ranges::upper_bound(pieces_, own, {}, &Piece::tokens);
    load(after - pieces_.begin() - 1);
  } else if (number < number_) {
    at_ = text_.data();
    number_ = begin_ + pieces_[loaded_].tokens;
  }
  const char* const end = text_.data() + text_.size();
  behind_token_ = false;
  at_ = next_token(at_, end, comment);
  for (; number_ < number; ++number_) at_ = next_token(end_of_token(at_, end), end, comment);
}

std::string_view RangeTokens::next() {
  at_ = next_token(at_, text_.data() + text_.size(), comment);
  while (at_ == text_.data() + text_.size()) {
    QUADLOOP_REQUIRE(loaded_ + 2 < pieces_.size(), "a token behind those of a rank is read", number_);
    load(loaded_ + 1);
    at_ = next_token(at_, text_.data() + text_.size(), comment);
  }
  const char* const end = end_of_token(at_, text_.data() + text_.size());
  const std::string_view token(at_, end);
  place_ = pieces_[loaded_].place + (at_ - text_.data());
  length_ = std::ssize(token);
  at_ = end;
  behind_token_ = true;
  ++number_;
  return token;
}

std::string RangeTokens::text_before(std::int64_t number) {
  if (pieces_.size() == 1) return {};
  const bool is_there = !text_.empty() && behind_token_ && number_ == number;
  if (number > begin_ && !is_there) {
    go_to(number - 1);
    next();
  } else if (number == begin_) {
    load(0);
  }
  std::string passed;
  while (true) {
    const char* const end = text_.data() + text_.size();
    const char* const token = next_token(at_, end, comment);
    passed.append(at_, token);
    at_ = token;
    behind_token_ = false;
    if (token != end || loaded_ + 2 == pieces_.size()) return passed;
    load(loaded_ + 1);
  }
}

std::int64_t RangeTokens::line_of(std::int64_t place) {
  const auto after = std::ranges::upper_bound(pieces_, place, {}, &Piece::place);
  const Piece& piece = after == pieces_.begin() ? *after : after[-1];
  std::int64_t lines = piece.lines;
  if (piece.place < place) {
    const std::string_view text = range_.piece_at(piece.place);
    lines += std::count(text.begin(), text.begin() + (place - piece.place), '\n');
    text_ = {};  // another piece may be loaded
  }
  return first_line_ + lines;
}

}  // namespace quadloop::io
