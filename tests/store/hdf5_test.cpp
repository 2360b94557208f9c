#include "launchsafe/store/hdf5.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <thread>

namespace launchsafe::store {
namespace {

std::string written(void (*body)(Hdf5Writer&)) {
  Hdf5Writer writer;
  body(writer);
  const Result<std::string> image = writer.finish();
  return image ? *image : std::string();
}

TEST(Hdf5, ReadsBackWhatWasWritten) {
  const std::string image = written([](Hdf5Writer& writer) {
    writer.group("outer", "a group", [&] {
      writer.group("inner", "a group in it", [&] {
        writer.value("number", -0.1, {"m", "a number"});
        writer.value("count", std::uint64_t{1} << 63, {"1", "a count"});
        writer.value("text", std::string("caf\u00e9 | \n"), {"none", "a text"});
        writer.value("empty", std::string(), {"none", "no text"});
      });
      writer.array("list", std::vector<std::int64_t>{-1, 2}, {"1", "integers"});
      writer.array("names", std::vector<std::string>{"G1", "", "row 10"}, {"none", "names"});
      writer.array("none", std::vector<double>{}, {"K", "nothing"});
      writer.table("table", {1, 2, 3, 4, 5, 6}, {2, 3}, {"K", "two rows"});
    });
  });
  Hdf5Reader reader(image);
  reader.group("outer", "", [&] {
    EXPECT_EQ(reader.size(), 5U);
    EXPECT_TRUE(reader.has("inner"));
    EXPECT_FALSE(reader.has("other"));
    reader.group("inner", "", [&] {
      double number = 0;
      std::uint64_t count = 0;
      std::string text, empty = "before";
      reader.value("number", number);
      reader.value("count", count);
      reader.value("text", text);
      reader.value("empty", empty);
      EXPECT_EQ(number, -0.1);
      EXPECT_EQ(count, std::uint64_t{1} << 63);
      EXPECT_EQ(text, "caf\u00e9 | \n");
      EXPECT_EQ(empty, "");
    });
    std::vector<std::int64_t> list;
    std::vector<std::string> names;
    std::vector<double> none{1}, table;
    reader.array("list", list);
    reader.array("names", names);
    reader.array("none", none);
    reader.table("table", table, {2, 3});
    EXPECT_EQ(list, (std::vector<std::int64_t>{-1, 2}));
    EXPECT_EQ(names, (std::vector<std::string>{"G1", "", "row 10"}));
    EXPECT_TRUE(none.empty());
    EXPECT_EQ(table, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  });
  EXPECT_FALSE(reader.failed()) << reader.error()->message;
}

TEST(Hdf5, DemandsUnits) {
  Hdf5Writer writer;
  writer.value("length", 1.0, {"", "a length"});
  const Result<std::string> image = writer.finish();
  ASSERT_FALSE(image);
  EXPECT_NE(image.error().message.find("/length"), std::string::npos);
}

TEST(Hdf5, RefusesATableOfAnotherSizeThanItsShape) {
  Hdf5Writer writer;
  writer.table("table", {1, 2, 3}, {2, 2}, {"1", "three values"});
  EXPECT_FALSE(writer.finish());
}

TEST(Hdf5, TheFirstErrorSticksAndNamesThePlace) {
  const std::string image = written([](Hdf5Writer& writer) {
    writer.group("group", "a group", [&] { writer.value("text", std::string("text"), {"none", "a text"}); });
  });
  Hdf5Reader reader(image);
  double number = 7;
  reader.group("group", "", [&] { reader.value("text", number); });
  reader.group("absent", "", [] { ADD_FAILURE() << "entered a group after an error"; });
  ASSERT_TRUE(reader.failed());
  EXPECT_EQ(reader.error()->kind, Error::Kind::corrupt);
  EXPECT_NE(reader.error()->message.find("/group/text"), std::string::npos) << reader.error()->message;
  EXPECT_EQ(number, 7);
}

TEST(Hdf5, BytesThatAreNoFileAreAnError) {
  EXPECT_TRUE(Hdf5Reader("").failed());
  EXPECT_TRUE(Hdf5Reader("no HDF5").failed());
  EXPECT_TRUE(Hdf5Reader(std::string(10'000, '\0')).failed());
}

TEST(Hdf5, PrintsNothingOnErrorsInAnyThread) {
  ::testing::internal::CaptureStderr();
  const auto read_nonsense = [] { EXPECT_TRUE(Hdf5Reader("no HDF5").failed()); };
  read_nonsense();
  std::thread(read_nonsense).join();
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Hdf5, FilesOpenAtTheSameTimeAreNotMixedUp) {
  const std::string one = written([](Hdf5Writer& writer) { writer.value("number", 1.0, {"1", "one"}); });
  const std::string two = written([](Hdf5Writer& writer) { writer.value("number", 2.0, {"1", "two"}); });
  Hdf5Reader first(one), second(two);
  double from_first = 0, from_second = 0;
  first.value("number", from_first);
  second.value("number", from_second);
  EXPECT_EQ(from_first, 1);
  EXPECT_EQ(from_second, 2);
}

}  // namespace
}  // namespace launchsafe::store
