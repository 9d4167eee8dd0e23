#include "io/cgns/cgns_boundaries.hpp"

#include <array>

#include "io/cgns/cgns_names.hpp"

namespace quadloop {

BoundaryEdges& CgnsBoundaries::named(Mesh& mesh, const std::string& name, const std::string& condition) {
  const auto [number, is_new] = names_.entry_of(name);
  if (is_new) mesh.boundaries.push_back({name, condition, {}});
  return mesh.boundaries[number];
}

std::string CgnsBoundaries::condition_of_family(const File& file, int base, const std::string& family) {
  if (!families_) read_families(file, base);
  const auto found = families_->find(family);
  return found == families_->end() ? "none" : found->second;
}

void CgnsBoundaries::read_families(const File& file, int base) {
  families_.emplace();
  int families = 0;
  file.check(cg_nfamilies(file.id(), base, &families));
  for (int f = 1; f <= families; ++f) {
    std::array<char, 33> name{}, condition{};
    int conditions = 0, geometries = 0;
    BCType_t type = BCTypeNull;
    file.check(cg_family_read(file.id(), base, f, name.data(), &conditions, &geometries));
    if (conditions == 0) continue;
    file.check(cg_fambc_read(file.id(), base, f, 1, condition.data(), &type));
    families_->emplace(name.data(), condition_of_cgns_family(type, condition.data()));
  }
}

}  // namespace quadloop
