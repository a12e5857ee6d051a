// Tables that bind parameters to the members of a struct.
#include "renderer/base/parameter_table.h"

#include <gtest/gtest.h>

#include "renderer/methods/many_lights/parameters.h"
#include "renderer/registry/registry.h"

namespace lamplighter {
namespace {

enum class Shape { box, ball };

struct SharedOptions {
  int count = 3;
  bool operator==(const SharedOptions&) const = default;
};

struct Options : SharedOptions {
  float size = 0.5f;
  bool fast = true;
  Shape shape = Shape::ball;
  std::string name = "b";
  bool operator==(const Options&) const = default;
};

const ParameterTable<SharedOptions>& sharedTable() {
  static const ParameterTable<SharedOptions> table{&SharedOptions::count, "count", "Count", "",
                                                   "How many.",           {1, 9}};
  return table;
}

const ParameterTable<Options>& table() {
  using O = Options;
  using enum ParameterGroup;
  static const ParameterTable<O> all{
      {&O::size, "size", "Size", "m", "Its size.", {0.1, 4.0, kLogarithmic}, budgets, "More."},
      sharedTable(),
      {&O::fast, "fast", "Fast", "Fast or not.", technique},
      {&O::shape, "shape", "Shape", "", "Its shape.", {{"box", Shape::box}, {"ball", Shape::ball}}},
      {&O::name, "name", "Name", "Its name.", {"a", "b"}}};
  return all;
}

// Any value that is not the default.
ParameterValue otherValue(const ParameterSpec& spec) {
  if (!spec.choices.empty())
    return spec.choices.front() == std::get<std::string>(spec.defaultValue) ? spec.choices.back()
                                                                            : spec.choices.front();
  if (const bool* value = std::get_if<bool>(&spec.defaultValue)) return !*value;
  const auto other = [&](auto value) -> ParameterValue {
    const auto least = static_cast<decltype(value)>(spec.minimum);
    return value == least ? static_cast<decltype(value)>(spec.maximum) : least;
  };
  if (const int* value = std::get_if<int>(&spec.defaultValue)) return other(*value);
  return other(std::get<float>(spec.defaultValue));
}

TEST(ParameterTable, TakesDefaultsFromTheMembers) {
  EXPECT_EQ(table()["size"].defaultValue, ParameterValue(0.5f));
  EXPECT_EQ(table()["count"].defaultValue, ParameterValue(3));
  EXPECT_EQ(table()["fast"].defaultValue, ParameterValue(true));
  EXPECT_EQ(table()["shape"].defaultValue, ParameterValue(std::string("ball")));
  EXPECT_EQ(table()["name"].defaultValue, ParameterValue(std::string("b")));
  EXPECT_EQ(table().read({}), Options());
}

TEST(ParameterTable, KeepsTheOrderAndTheDeclarations) {
  std::vector<std::string> names;
  for (const ParameterSpec& spec : table().specs()) names.push_back(spec.name);
  EXPECT_EQ(names, (std::vector<std::string>{"size", "count", "fast", "shape", "name"}));
  const ParameterSpec& size = table()["size"];
  EXPECT_EQ(size.unit, "m");
  EXPECT_EQ(size.minimum, 0.1);
  EXPECT_EQ(size.maximum, 4.0);
  EXPECT_TRUE(size.logarithmic);
  EXPECT_EQ(size.group, ParameterGroup::budgets);
  EXPECT_EQ(size.benefit, "More.");
  EXPECT_EQ(table()["shape"].choices, (std::vector<std::string>{"box", "ball"}));
  EXPECT_THROW(table()["other"], std::out_of_range);
}

TEST(ParameterTable, ReadsEachParameterIntoItsMember) {
  Settings settings;
  settings.set("size", 2.0f);
  settings.set("count", 7);
  settings.set("fast", false);
  settings.set("shape", std::string("box"));
  settings.set("name", std::string("a"));
  settings.set("of another method", 1);
  const Options read = table().read(settings);
  EXPECT_EQ(read.size, 2.0f);
  EXPECT_EQ(read.count, 7);
  EXPECT_FALSE(read.fast);
  EXPECT_EQ(read.shape, Shape::box);
  EXPECT_EQ(read.name, "a");
  EXPECT_EQ(table().only("count").specs().size(), 1u);
  EXPECT_EQ(table().only("count").read(settings).count, 7);
  EXPECT_EQ(table().only("count").read(settings).size, 0.5f);
}

TEST(ParameterTable, OptionsDifferByEachParameter) {
  for (const ParameterSpec& spec : manyLightsParameters().specs()) {
    Settings settings;
    settings.set(spec.name, otherValue(spec));
    EXPECT_NE(manyLightsParameters().read(settings), ManyLightsParameters()) << spec.name;
    settings.set(spec.name, spec.defaultValue);
    EXPECT_EQ(manyLightsParameters().read(settings), ManyLightsParameters()) << spec.name;
  }
}

TEST(ParameterTable, EveryParameterOfAMethodReadsBackItsText) {
  for (const MethodInfo& method : methods()) {
    for (const ParameterSpec& spec : method.parameters) {
      for (const ParameterValue& value : {spec.defaultValue, otherValue(spec)})
        EXPECT_EQ(Settings::parse(spec, Settings::format(value)), value) << spec.name;
    }
  }
}

}  // namespace
}  // namespace lamplighter
