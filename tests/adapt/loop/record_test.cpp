// What record.json keeps of a run's case, and which changes of it are told apart. On one rank alone.
#include "adapt/loop/record.hpp"

#include <gtest/gtest.h>

#include "adapt/loop/case_settings.hpp"

namespace quadloop::adapt {
namespace {

CycleRecord sample() {
  CycleRecord record;
  record.cycle = 3;
  record.case_digest = 0x0123456789abcdef;
  record.geometry_digest = 0xfedcba9876543210;
  record.settings = {{"adapt.refine", "0.5"},
                     {"boundary.is \"a\" \\ b.spacing", "2"},
                     {"solver.command", R"(["a, b", "\"{mesh}\": "])"}};
  record.seconds = {{"mesh", 0.25}};
  return record;
}

TEST(Record, ItsCaseComesBack) {
  const CycleRecord record = sample();
  const auto read = recorded_case(json_text(record));
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->case_digest, record.case_digest);
  EXPECT_EQ(read->geometry_digest, record.geometry_digest);
  ASSERT_EQ(read->settings.size(), record.settings.size());
  for (std::size_t i = 0; i < record.settings.size(); ++i)
    EXPECT_EQ(read->settings[i].first, record.settings[i].first);
  EXPECT_TRUE(changed_settings(read->settings, record.settings).empty());
  EXPECT_TRUE(recorded_case(json_text({}))->settings.empty());
}

TEST(Record, ItsNumbersComeBack) {
  CycleRecord record = sample();
  record.cl = -0.25;
  record.forces = {{"wall", 7, 8, 0, 0}};
  const std::string text = json_text(record);
  EXPECT_EQ(recorded_number(text, "cl"), -0.25);
  EXPECT_FALSE(recorded_number(text, "cd").has_value()) << "that of the wall is none of the record's";
  EXPECT_FALSE(recorded_number(text, "forces").has_value());
}

TEST(Record, ItsBytesStay) {
  CycleRecord record = sample();
  record.solution_digest = 7;
  record.nodes = 7;
  record.worst_angle = 30.5;
  record.deviation = 1.0 / 0.0;
  record.drift = {{"density", -1e-17}};
  record.cl = 0.25;
  EXPECT_EQ(json_text(record), R"({
  "cycle": 3,
  "case_digest": "0123456789abcdef",
  "geometry_digest": "fedcba9876543210",
  "solution_digest": "0000000000000007",
  "nodes": 7,
  "triangles": 0,
  "quads": 0,
  "leaves": 0,
  "worst_angle": 30.5,
  "indicator": {"mean": 0, "deviation": null},
  "refined": 0,
  "coarsened": 0,
  "outside": 0,
  "drift": {"density": -1e-17},
  "cl": 0.25,
  "case": {
    "adapt.refine": 0.5,
    "boundary.is \"a\" \\ b.spacing": 2,
    "solver.command": ["a, b", "\"{mesh}\": "]
  },
  "seconds": {"mesh": 0.25}
}
)");
}

TEST(Record, OfAnEarlierVersionHasNoDigestOfTheSolution) {
  std::string text = json_text(sample());
  const std::string line = "  \"solution_digest\": \"0000000000000000\",\n";
  ASSERT_EQ(recorded_case(text)->solution_digest, 0U);
  text.erase(text.find(line), line.size());
  ASSERT_TRUE(recorded_case(text).has_value());
  EXPECT_FALSE(recorded_case(text)->solution_digest.has_value());
}

TEST(Record, NoPartOfOneIsWhole) {
  const std::string text = json_text(sample());
  for (std::size_t length = 0; length < text.size(); ++length)
    EXPECT_FALSE(recorded_case(text.substr(0, length)).has_value()) << length;
}

TEST(Record, ItIsReadHoweverItIsWritten) {
  std::string text = json_text(sample());
  std::erase(text, '\n');
  const auto read = recorded_case(text + "\n");
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->settings.size(), 3U);
  EXPECT_EQ(read->settings[0].second, "0.5");
}

TEST(CaseSettings, ValuesAreComparedNotTheirTexts) {
  const CaseSettings before{{"spacing.max", "1000000.0"}, {"solver.command", R"(["a","b"])"}};
  EXPECT_TRUE(
      changed_settings(before, {{"spacing.max", "1e+06"}, {"solver.command", R"(["a", "b"])"}}).empty());
  EXPECT_EQ(changed_settings(before, {{"spacing.max", "1e+07"}, {"solver.command", R"(["a","b"])"}}).size(),
            1U);
}

TEST(CaseSettings, ChangesAreToldByKey) {
  const CaseSettings before{{"a", "1"}, {"b", "2"}, {"d", "4"}}, now{{"b", "3"}, {"c", "3"}, {"d", "4"}};
  const auto changes = changed_settings(before, now);
  ASSERT_EQ(changes.size(), 3U);
  EXPECT_EQ(text_of(changes), "a was 1, is now not set, b was 2, is now 3, c was not set, is now 3");
  EXPECT_TRUE(changed_settings(now, now).empty());
}

TEST(CaseSettings, FilesOfATemplateAreToldByTheirNamesAndMayChange) {
  const CaseSettings before{{template_key("0/U"), "\"1f\""}, {template_key("gone"), "\"2\""}},
      now{{template_key("0/U"), "\"2f\""}, {template_key("new"), "\"3\""}};
  EXPECT_EQ(text_of(changed_settings(before, now)),
            "the file '0/U' of solver.template has changed, the file 'gone' of solver.template is gone, "
            "the file 'new' of solver.template is new");
  EXPECT_EQ(run_digest(before, 1), run_digest(now, 1));
}

TEST(CaseSettings, TheDigestLeavesOutWhatMayChange) {
  const CaseSettings settings{
      {"adapt.refine", "0.5"}, {"solver.command", "[\"a\"]"}, {"solver.iterations", "7"}};
  CaseSettings other = settings;
  other[1].second = "[\"b\"]";
  other[2].second = "8";
  EXPECT_EQ(run_digest(settings, 1), run_digest(other, 1));
  EXPECT_NE(run_digest(settings, 1), run_digest(settings, 2));
  other[0].second = "0.6";
  EXPECT_NE(run_digest(settings, 1), run_digest(other, 1));
}

}  // namespace
}  // namespace quadloop::adapt
