#include "io/text/text_output.hpp"

namespace quadloop::io {

TextOutput::TextOutput(OutputSet& outputs, const std::string& path)
    : TextOutput(outputs.communicator(), outputs.stage(path)) {}

TextOutput::TextOutput(const Communicator& comm, const StagedFile& staged) : comm_{comm} {
  comm_.together([&] {
    if (comm_.is_root()) file_ = std::make_unique<OutputFile>(staged);
  });
}

void TextOutput::write(const std::string& text) {
  comm_.together([&] {
    if (file_) file_->write(text);
  });
}

void TextOutput::close() {
  comm_.together([&] {
    if (file_) file_->close();
  });
}

}  // namespace quadloop::io
