#include "app/report/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace quadloop::app {

void Statistics::add(const std::string& name, std::int64_t count) {
  add_raw(name, std::to_string(count), json_of(count));
}

void Statistics::add(const std::string& name, double value, const char* pattern, const std::string& key) {
  add_raw(name, fmt::format(fmt::runtime(pattern), value), json_of(value), key);
}

void Statistics::add_raw(const std::string& name, const std::string& text, const std::string& json,
                         const std::string& key) {
  std::string derived = name;
  std::replace(derived.begin(), derived.end(), ' ', '_');
  statistics_.push_back({name, key.empty() ? derived : key, text, json});
}

void Statistics::add_place(Point place, const std::string& key) {
  add_lines(fmt::format("    {:>38}\n", fmt::format("at ({:.6g}, {:.6g})", place.x, place.y)));
  add_member(key, json_of(std::vector{place.x, place.y}));
}

std::string Statistics::table(int width, int value_width) const {
  std::string text;
  for (const Figure& figure : statistics_)
    text += figure.name.empty()
                ? figure.text
                : fmt::format("  {:<{}}{:>{}}\n", figure.name, width, figure.text, value_width);
  return text;
}

JsonObject Statistics::record() const {
  JsonObject json;
  for (const Figure& figure : statistics_) {
    if (!figure.key.empty()) json.add_raw(figure.key, figure.json);
  }
  return json;
}

}  // namespace quadloop::app
