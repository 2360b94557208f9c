#include "launchsafe/store/hdf5_mold.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace launchsafe::store {
namespace {

/// A small tree; `values` decide its shape by their number alone.
void lay_out(Hdf5Output& output, const std::vector<double>& values, const std::string& text) {
  output.attribute("format", "test");
  output.group("outer", "a group", [&] {
    output.value("count", static_cast<std::int64_t>(values.size()), {"1", "how many"});
    output.value("text", text, {"none", "a text"});
    output.group("inner", "a group in it", [&] { output.array("values", values, {"K", "values"}); });
  });
  output.value("first", values.empty() ? 0.0 : values.front(), {"K", "the first one"});
}

std::string by_library(const std::vector<double>& values, const std::string& text) {
  Hdf5Writer writer;
  lay_out(writer, values, text);
  return *writer.finish(8);
}

Hdf5Mold mold_of(const std::vector<double>& values, const std::string& text) {
  Hdf5Writer writer;
  lay_out(writer, values, text);
  std::string file = *writer.finish(8);
  return {std::move(file), 8, writer.steps()};
}

TEST(Hdf5Mold, GivesTheVeryBytesOfTheLibrary) {
  const Hdf5Mold mold = mold_of({1, 2, 3}, "one");
  Hdf5Filler filler(mold);
  lay_out(filler, {-4, 5e300, 6}, "another text");
  const Result<std::string> file = filler.finish();
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_TRUE(*file == by_library({-4, 5e300, 6}, "another text"));
  EXPECT_FALSE(*file == by_library({1, 2, 3}, "one"));
}

TEST(Hdf5Mold, FitsNoOtherShape) {
  const Hdf5Mold mold = mold_of({1, 2, 3}, "one");
  Hdf5Filler longer(mold);
  lay_out(longer, {1, 2, 3, 4}, "one");
  EXPECT_FALSE(longer.finish());

  Hdf5Filler less(mold);
  less.attribute("format", "test");
  EXPECT_FALSE(less.finish());

  Hdf5Filler other_unit(mold);
  other_unit.attribute("format", "test");
  other_unit.group("outer", "a group", [&] {
    other_unit.value("count", std::int64_t{3}, {"m", "how many"});
  });
  EXPECT_FALSE(other_unit.finish());

  Hdf5Filler other_attribute(mold);
  other_attribute.attribute("format", "tested");
  EXPECT_FALSE(other_attribute.finish());
}

TEST(Hdf5Mold, IsFilledWithoutValuesToo) {
  const Hdf5Mold mold = mold_of({}, "");
  Hdf5Filler filler(mold);
  lay_out(filler, {}, "");
  EXPECT_TRUE(*filler.finish() == by_library({}, ""));
}

TEST(Hdf5Mold, ManyShapesInTurnGiveTheSameFilesAsNone) {
  Hdf5Molds molds;
  for (int round = 0; round < 3; ++round) {
    for (std::size_t length = 0; length < 7; ++length) {
      const std::vector<double> values(length, round + 0.5);
      const std::string text(40 * length, 'x');
      const auto file = molds.file_of(8, [&](Hdf5Output& output) { lay_out(output, values, text); });
      ASSERT_TRUE(file);
      EXPECT_TRUE(*file == by_library(values, text)) << length;
    }
  }
}

TEST(Hdf5Mold, AnErrorIsTheSameAsWithoutMolds) {
  Hdf5Molds molds;
  const auto broken = [](Hdf5Output& output) {
    output.table("table", {1, 2, 3}, {2, 2}, {"1", "three values"});
  };
  const auto file = molds.file_of(8, broken);
  ASSERT_FALSE(file);
  Hdf5Writer writer;
  broken(writer);
  EXPECT_EQ(file.error().message, writer.finish().error().message);
}

}  // namespace
}  // namespace launchsafe::store
