#include <optional>

#include "io/loaded/foreign_mesh.hpp"
#include "io/msh/msh_file.hpp"
#include "io/msh/msh_text.hpp"

namespace quadloop {

namespace {

class MshReader {
 public:
  explicit MshReader(const std::string& path) : text_{path, 2} {}

  LoadedMesh read() {
    text_.read([this](std::int64_t tag, Point3 point) { put_point(tag, point); },
               [this](const MshElement& element) { put_element(element); });
    if (text_.may_repeat()) drop_repeated(foreign_, text_.scan().path());
    drop_unused_nodes(foreign_, text_.scan().path());
    warn_of_names();
    return finish(std::move(foreign_), text_.scan());
  }

 private:
  void warn_of_names() {
    const std::int64_t curves = text_.groups().curves_without_group();
    if (curves == 0) return;
    foreign_.loaded.warnings.push_back(
        text_.scan().path() + ": " + std::to_string(curves) +
        " curves are in no physical group; their boundaries are called " +
        "boundary_ and the curve's number (in Gmsh, Physical Curve gives names)");
  }

  void put_point(std::int64_t tag, Point3 point) {
    if (!z_) z_ = point.z;
    if (point.z != *z_)
      text_.scan().refuse("node " + std::to_string(tag) +
                          " does not lie in the first node's plane z = constant; only plane meshes can be "
                          "read");
    foreign_.loaded.mesh.points.push_back({point.x, point.y});
  }

  void put_element(const MshElement& element) {
    if (element.type == msh_triangle) {
      foreign_.add_triangle(element.as<NodeId, 3>(), text_.groups().block_of(foreign_, element.physical));
    } else if (element.type == msh_quad) {
      foreign_.add_quad(element.as<NodeId, 4>(), text_.groups().block_of(foreign_, element.physical));
    } else if (element.type == msh_line) {
      foreign_.edges.push_back({element.as<NodeId, 2>(),
                                text_.groups().boundary_of(foreign_, element.physical, element.entity),
                                element.place});
    }
  }

  MshText text_;
  std::optional<double> z_;
  ForeignMesh foreign_;
};

}  // namespace

LoadedMesh read_msh(const std::string& path) { return MshReader(path).read(); }

}  // namespace quadloop
