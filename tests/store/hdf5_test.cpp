#include "launchsafe/store/hdf5.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace launchsafe::store {
namespace {

/// Values of every type.
struct Values {
  double number = 0;
  std::uint64_t count = 0;
  bool flag = false;
  std::string text, empty;
  std::vector<int> list;
  std::vector<std::string> names;
  std::vector<double> none, table;
  bool operator==(const Values&) const = default;
};

void lay_out(Hdf5& file, Values& values) {
  file.data("outer/inner/number", values.number, "m");
  file.data("outer/inner/count", values.count, "1");
  file.data("outer/inner/flag", values.flag, "1");
  file.data("outer/text", values.text, "none");
  file.data("outer/empty", values.empty, "none");
  file.data("list", values.list, "1");
  file.data("names", values.names, "none");
  file.data("none", values.none, "K");
  file.table("table", values.table, 2, 3, "K");
}

std::string written() {
  Values values{-0.1,    std::uint64_t{1} << 63, true, "caf\u00e9 | \n",  "",
                {-1, 2}, {"G1", "", "row 10"},   {},   {1, 2, 3, 4, 5, 6}};
  Hdf5 file;
  lay_out(file, values);
  return file.finish();
}

TEST(Hdf5, ReadsBackWhatWasWritten) {
  const std::string image = written();
  Hdf5 file(image), other(image);  // at the same time
  Values values, again;
  values.none = {1};
  lay_out(file, values);
  lay_out(other, again);
  EXPECT_TRUE(values == again);
  EXPECT_EQ(values.number, -0.1);
  EXPECT_EQ(values.count, std::uint64_t{1} << 63);
  EXPECT_TRUE(values.flag);
  EXPECT_EQ(values.text, "caf\u00e9 | \n");
  EXPECT_EQ(values.list, (std::vector<int>{-1, 2}));
  EXPECT_EQ(values.names, (std::vector<std::string>{"G1", "", "row 10"}));
  EXPECT_TRUE(values.none.empty());
  EXPECT_EQ(values.table, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(file.size("outer"), 3U);
  EXPECT_EQ(file.size("absent"), 0U);
  EXPECT_TRUE(file.has("list"));
  EXPECT_FALSE(file.has("other"));
  EXPECT_EQ(image, written()) << "equal values are equal bytes";
}

TEST(Hdf5, AnErrorNamesThePlace) {
  Hdf5 writer;
  std::vector<double> three{1, 2, 3};
  EXPECT_THROW(writer.table("table", three, 2, 2, "1"), Error);
  const std::string image = written();
  Hdf5 file(image);
  double number = 7;
  for (const char* name : {"outer/text", "absent", "list"}) {
    try {
      file.data(name, number, "m");
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind, Error::Kind::corrupt);
      EXPECT_NE(error.message.find(name), std::string::npos) << error.message;
    }
  }
  EXPECT_THROW(file.table("table", three, 3, 2, "K"), Error);
}

TEST(Hdf5, BytesThatAreNoFileAreAnErrorWithoutWordsInAnyThread) {
  ::testing::internal::CaptureStderr();
  const auto read_nonsense = [] {
    for (const std::string& bytes : {std::string(), std::string("no HDF5"), std::string(10'000, '\0')})
      EXPECT_THROW(Hdf5{std::string_view(bytes)}, Error);
  };
  read_nonsense();
  std::thread(read_nonsense).join();
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace launchsafe::store
