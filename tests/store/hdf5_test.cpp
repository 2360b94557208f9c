#include "launchsafe/store/hdf5.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <thread>

namespace launchsafe::store {
namespace {

std::string written(void (*body)(Hdf5Writer&)) {
  Hdf5Writer writer;
  body(writer);
  return writer.finish();
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
}

/// What `action` throws.
Error error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

TEST(Hdf5, DemandsUnits) {
  Hdf5Writer writer;
  const Error error = error_of([&] { writer.value("length", 1.0, {"", "a length"}); });
  EXPECT_EQ(error.kind, Error::Kind::failed);
  EXPECT_NE(error.message.find("length"), std::string::npos);
}

TEST(Hdf5, RefusesATableOfAnotherSizeThanItsShape) {
  Hdf5Writer writer;
  EXPECT_THROW(writer.table("table", {1, 2, 3}, {2, 2}, {"1", "three values"}), Error);
}

TEST(Hdf5, AnErrorNamesThePlaceAndLeavesTheValue) {
  const std::string image = written([](Hdf5Writer& writer) {
    writer.group("group", "a group", [&] { writer.value("text", std::string("text"), {"none", "a text"}); });
  });
  Hdf5Reader reader(image);
  double number = 7;
  const Error error = error_of([&] { reader.group("group", "", [&] { reader.value("text", number); }); });
  EXPECT_EQ(error.kind, Error::Kind::corrupt);
  EXPECT_NE(error.message.find("text"), std::string::npos) << error.message;
  EXPECT_EQ(number, 7);
  EXPECT_THROW(Hdf5Reader(image).group("absent", "", [] { ADD_FAILURE() << "entered a group"; }), Error);
}

TEST(Hdf5, BytesThatAreNoFileAreAnError) {
  EXPECT_THROW(Hdf5Reader(""), Error);
  EXPECT_THROW(Hdf5Reader("no HDF5"), Error);
  EXPECT_THROW(Hdf5Reader(std::string(10'000, '\0')), Error);
}

TEST(Hdf5, PrintsNothingOnErrorsInAnyThread) {
  ::testing::internal::CaptureStderr();
  const auto read_nonsense = [] { EXPECT_THROW(Hdf5Reader("no HDF5"), Error); };
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
