// A gnuplot that hangs does not keep the user from stopping, and costs no result.
#include "stored_study.hpp"

#include <cstdlib>

namespace launchsafe::app {
namespace {

class HangingPicture : public StoredStudy {
 protected:
  void SetUp() override {
    StoredStudy::SetUp();
    std::filesystem::create_directory(folder() / "bin");
    write("bin/gnuplot", "#!/bin/sh\ntouch \"$0.began\"\nsleep 600\n");
    std::filesystem::permissions(folder() / "bin/gnuplot", std::filesystem::perms::owner_all);
    const std::string path = (folder() / "bin").string() + ":" + std::getenv("PATH");
    before_start([path] { ::setenv("PATH", path.c_str(), 1); });
    write("study.toml",
          "kind = \"critical-gap\"\nscene = \"shell.toml\"\nearly_time = "
          "\"0.03 ms\"\nuncertainty.peak_pressure = \"0 %\"\nnumerics = { value = \"2 K\", because = \"two "
          "meshes of it\" }\nconfirm = false\n");
  }
};

TEST_F(HangingPicture, IsGivenUpWhenTheUserStopsAndDrawnTheNextTime) {
  start({"study", "study.toml", "-o", "out"});
  wait_for_file("bin/gnuplot.began");
  send(SIGINT);
  const Outcome outcome = wait();
  EXPECT_EQ(outcome.code, 75) << outcome.err;
  write("bin/gnuplot", "#!/bin/sh\necho '<svg></svg>'\n");
  const Outcome again = run({"study", "study.toml", "-o", "out"});
  EXPECT_TRUE(again.says("ran 0")) << again.err;
  EXPECT_EQ(read("out/temperature.svg"), "<svg></svg>\n");
}

}  // namespace
}  // namespace launchsafe::app
