#include "io/msh/msh_output.hpp"

#include <charconv>

namespace quadloop::io {

namespace {

std::string shortest(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

}  // namespace

void MshOutput::write_head(const Box& box) {
  std::string text = std::string("$MeshFormat\n") + (is_new_ ? "4.1" : "2.2") +
                     " 0 8\n$EndMeshFormat\n$PhysicalNames\n" + std::to_string(groups_.size()) + "\n";
  std::array<std::int64_t, 4> of_dimension{};
  std::string points, others;  // entities
  for (std::size_t n = 0; n < groups_.size(); ++n) {
    const std::string number = std::to_string(n + 1);
    text += std::to_string(groups_[n].dimension) + " " + number + " \"" + msh_group_name(groups_[n].name) +
            "\"\n";
    ++of_dimension[groups_[n].dimension];
    if (groups_[n].dimension == 0) {
      const Point3 p = groups_[n].place;
      points +=
          number + " " + shortest(p.x) + " " + shortest(p.y) + " " + shortest(p.z) + " 1 " + number + "\n";
      continue;
    }
    others += number;
    for (const double bound : box) others += " " + shortest(bound);
    others += " 1 " + number + " 0\n";
  }
  text += "$EndPhysicalNames\n";
  if (is_new_) {
    text += "$Entities\n";
    for (const std::int64_t count : of_dimension)
      text += std::to_string(count) + (&count == &of_dimension[3] ? "\n" : " ");
    text += points + others + "$EndEntities\n";
  }
  file_.write(text);
}

void MshOutput::write_periodic(const std::vector<Link>& links) {
  if (links.empty()) return;
  std::string text = "$Periodic\n" + std::to_string(links.size()) + "\n";
  for (const Link& link : links) {
    text += "1 " + std::to_string(link.group) + " " + std::to_string(link.partner) + "\n" +
            (is_new_ ? "16 " : "Affine ") + link.affine + "\n" + std::to_string(link.nodes.size()) + "\n";
    for (const auto& [node, partner] : link.nodes)
      text += std::to_string(node + 1) + " " + std::to_string(partner + 1) + "\n";
  }
  file_.write(text + "$EndPeriodic\n");
}

std::string MshOutput::new_nodes_head(std::int64_t all) const {
  const std::string count = std::to_string(all);
  std::size_t last = groups_.size();
  while (groups_[last - 1].dimension == 0) --last;
  return "$Nodes\n1 " + count + " 1 " + count + "\n" + std::to_string(groups_[last - 1].dimension) + " " +
         std::to_string(last) + " 0 " + count + "\n";
}

}  // namespace quadloop::io
