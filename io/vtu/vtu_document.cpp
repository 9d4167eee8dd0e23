#include "io/vtu/vtu_document.hpp"

#include <expat.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <string_view>
#include <type_traits>

#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

using Parser = std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)>;

/// An error to be thrown after expat, which is C and does not support exceptions.
struct Refusal {
  std::size_t place = 0;
  std::string message;
};

std::string attribute(const XML_Char** attributes, std::string_view name) {
  for (; *attributes != nullptr; attributes += 2) {
    if (attributes[0] == name) return attributes[1];
  }
  return {};
}

class Builder {
 public:
  Builder(XML_Parser parser, std::string_view text, VtuDocument& document)
      : parser_{parser}, text_{text}, document_{document} {
    XML_SetUserData(parser, this);
    XML_SetElementHandler(
        parser,
        [](void* self, const XML_Char* name, const XML_Char** attributes) {
          static_cast<Builder*>(self)->start(name, attributes);
        },
        [](void* self, const XML_Char* name) { static_cast<Builder*>(self)->end(name); });
  }

  const std::optional<Refusal>& refusal() const { return refusal_; }
  bool is_vtk() const { return is_vtk_; }
  int pieces() const { return pieces_; }

 private:
  std::size_t here() const { return XML_GetCurrentByteIndex(parser_); }
  std::size_t after() const { return here() + XML_GetCurrentByteCount(parser_); }

  void refuse(const std::string& message) {
    if (!refusal_) refusal_ = Refusal{here(), message};
    XML_StopParser(parser_, XML_FALSE);
  }

  void start(std::string_view name, const XML_Char** attributes) {
    if (in_array_) {  // a comment inside an array: the data are before or after it
      end_data();
      ++notes_;
    } else if (name == "VTKFile") {
      start_file(attributes);
    } else if (name == "Piece") {
      start_piece(attributes);
    } else if (name == "DataArray" || name == "Array") {
      start_array(attributes);
    } else {
      section_ = name;
    }
  }

  void end(std::string_view name) {
    if (notes_ > 0) {
      --notes_;
      if (!data_ended_) document_.arrays.back().begin = after();
    } else if (in_array_) {
      end_data();
      if (!data_ended_) document_.arrays.back().end = here();
      in_array_ = false;
    } else if (name == section_) {
      section_.clear();
    }
  }

  void start_file(const XML_Char** attributes) {
    is_vtk_ = true;
    const std::string type = attribute(attributes, "type"), compressor = attribute(attributes, "compressor");
    if (type != "UnstructuredGrid")
      return refuse("holds VTK data of type '" + type + "'; save it as an unstructured grid");
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor") {
      return refuse("is compressed by " + compressor + "; save it with zlib or without compression");
    }
    document_.compressed = !compressor.empty();
    document_.big_endian = attribute(attributes, "byte_order") == "BigEndian";
    document_.wide_header = attribute(attributes, "header_type") == "UInt64";
  }

  void start_piece(const XML_Char** attributes) {
    if (++pieces_ > 1) return refuse("the grid has several pieces; merge them into one");
    document_.piece_place = here();
    document_.points = count(attributes, "NumberOfPoints", 0);
    document_.cells = count(attributes, "NumberOfCells", 0);
  }

  void start_array(const XML_Char** attributes) {
    VtuArray array;
    array.section = section_;
    array.name = attribute(attributes, "Name");
    array.type = attribute(attributes, "type");
    array.format = attribute(attributes, "format");
    if (array.format.empty()) array.format = "ascii";
    array.components = std::max<std::int64_t>(1, count(attributes, "NumberOfComponents", 1));
    array.place = here();
    array.begin = array.end = after();
    if (!attribute(attributes, "offset").empty()) array.offset = count(attributes, "offset", 0);
    document_.arrays.push_back(array);
    in_array_ = true;
    data_ended_ = false;
  }

  /// Data end at the first tag that follows them.
  void end_data() {
    VtuArray& array = document_.arrays.back();
    if (data_ended_ || here() < array.begin) return;
    const std::string_view data = text_.substr(array.begin, here() - array.begin);
    if (data.find_first_not_of(" \t\r\n") == std::string_view::npos) return;
    array.end = here();
    data_ended_ = true;
  }

  std::int64_t count(const XML_Char** attributes, const char* name, std::int64_t absent) {
    const std::string text = attribute(attributes, name);
    if (text.empty()) return absent;
    std::int64_t value = 0;
    const auto [stopped, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || stopped != text.data() + text.size() || value < 0)
      refuse(std::string(name) + " is '" + text + "', not a count");
    return value;
  }

  XML_Parser parser_;
  std::string_view text_;
  VtuDocument& document_;
  std::string section_;
  bool is_vtk_ = false, in_array_ = false, data_ended_ = false;
  int pieces_ = 0, notes_ = 0;
  std::optional<Refusal> refusal_;
};

/// The list of pieces.
class PieceList {
 public:
  explicit PieceList(XML_Parser parser) : parser_{parser} {
    XML_SetUserData(parser, this);
    XML_SetStartElementHandler(parser, [](void* self, const XML_Char* name, const XML_Char** attributes) {
      static_cast<PieceList*>(self)->start(name, attributes);
    });
  }

  const std::optional<Refusal>& refusal() const { return refusal_; }
  const std::vector<std::string>& sources() const { return sources_; }

 private:
  void start(std::string_view name, const XML_Char** attributes) {
    if (name == "VTKFile" && attribute(attributes, "type") != "PUnstructuredGrid")
      refuse("holds VTK data of type '" + attribute(attributes, "type") +
             "'; save it as an unstructured grid");
    if (name != "Piece") return;
    sources_.push_back(attribute(attributes, "Source"));
    if (sources_.back().empty()) refuse("a piece names no file (Source)");
  }
  void refuse(const std::string& message) {
    if (!refusal_) refusal_ = Refusal{static_cast<std::size_t>(XML_GetCurrentByteIndex(parser_)), message};
    XML_StopParser(parser_, XML_FALSE);
  }

  XML_Parser parser_;
  std::vector<std::string> sources_;
  std::optional<Refusal> refusal_;
};

/// Finds the tag's end and the underscore; raw data are not XML, so expat must not see them.
void find_appended(const TextScanner& scan, std::size_t tag, VtuDocument& document) {
  const std::string_view text = scan.text();
  const std::size_t close = text.find('>', tag), underscore = text.find('_', close);
  if (close == std::string_view::npos || underscore == std::string_view::npos)
    scan.refuse_at(tag, "the file ends before its appended data");
  const std::string_view head = text.substr(tag, close - tag);
  document.appended_raw = head.find("raw") != std::string_view::npos;
  document.appended_begin = underscore + 1;
  const std::size_t end = text.rfind("</AppendedData");
  document.appended_end = end == std::string_view::npos || end < underscore ? text.size() : end;
}

template <class Builder>
void feed(const TextScanner& scan, XML_Parser parser, std::string_view text, bool whole,
          const Builder& builder) {
  constexpr std::size_t largest_piece = std::size_t{1} << 26;
  for (std::size_t begin = 0; begin == 0 || begin < text.size(); begin += largest_piece) {
    const std::string_view piece = text.substr(begin, largest_piece);
    const bool last = whole && begin + largest_piece >= text.size();
    const XML_Status status = XML_Parse(parser, piece.data(), static_cast<int>(piece.size()), last ? 1 : 0);
    if (builder.refusal()) scan.refuse_at(builder.refusal()->place, builder.refusal()->message);
    if (status == XML_STATUS_OK) continue;
    const auto place =
        std::min(static_cast<std::size_t>(std::max<XML_Index>(0, XML_GetCurrentByteIndex(parser))),
                 scan.text().size());
    scan.refuse_at(place,
                   std::string("is no whole VTK XML file: ") + XML_ErrorString(XML_GetErrorCode(parser)));
  }
}

}  // namespace

const VtuArray* VtuDocument::find(const std::string& section, const std::string& name) const {
  const auto found = std::find_if(arrays.begin(), arrays.end(),
                                  [&](const VtuArray& a) { return a.section == section && a.name == name; });
  return found == arrays.end() ? nullptr : &*found;
}

std::vector<std::string> parse_pvtu(const TextScanner& scan) {
  const Parser parser(XML_ParserCreate(nullptr), &XML_ParserFree);
  QUADLOOP_REQUIRE(parser != nullptr, "no memory for reading XML");
  const PieceList list(parser.get());
  feed(scan, parser.get(), scan.text(), true, list);
  if (list.sources().empty()) scan.refuse_at(0, "the grid has no piece, and so no cells");
  return list.sources();
}

VtuDocument parse_vtu(const TextScanner& scan) {
  VtuDocument document;
  const Parser parser(XML_ParserCreate(nullptr), &XML_ParserFree);
  QUADLOOP_REQUIRE(parser != nullptr, "no memory for reading XML");
  Builder builder(parser.get(), scan.text(), document);
  const std::size_t appended = scan.text().find("<AppendedData");
  const bool whole = appended == std::string_view::npos;
  feed(scan, parser.get(), scan.text().substr(0, appended), whole, builder);
  if (!builder.is_vtk()) scan.refuse_at(0, "is no VTK XML file: it has no element VTKFile");
  if (builder.pieces() == 0) scan.refuse_at(0, "the grid has no piece, and so no cells");
  if (!whole) find_appended(scan, appended, document);
  return document;
}

}  // namespace quadloop::io
