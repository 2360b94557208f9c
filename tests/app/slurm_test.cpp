// The batch files of studies/slurm where sbatch and scontrol are stand-ins. tests/app/slurm.sh runs them on a
// real Slurm.
#include "program.hpp"

#include <cstdlib>

namespace launchsafe::app {
namespace {

const std::string small_sweep = R"(kind = "critical-gap"
scene = "shell.toml"
early_time = "0.03 ms"
gaps = "0, 0.01 cm"
confirm = false
uncertainty.peak_pressure = "0 %"
numerics = { value = "2 K", because = "two meshes of it" }

[[vary]]
key = "peak_pressure"
values = "40, 50, 60 MPa"
)";

class BatchFiles : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("shell.toml", tiny_scene);
    write("sweep.toml", small_sweep);
    std::filesystem::create_directory(folder() / "bin");
    std::filesystem::create_symlink(LAUNCHSAFE_PROGRAM, folder() / "bin" / "launchsafe");
    for (const char* name : {"shards.sbatch", "merge.sbatch"})
      std::filesystem::copy(std::string(LAUNCHSAFE_SOURCE_DIR "/studies/slurm/") + name, folder());
    write("shards.sbatch", with(with(read("shards.sbatch"), "shards=20", "shards=2"), "cores=4", "cores=1"));
  }

  /// Runs shell commands in the test's folder, with what is in bin before everything else; their output is in
  /// shell.txt.
  int shell(const std::string& commands) const {
    write("commands.sh", "PATH=$PWD/bin:$PATH\n" + commands);
    const int status =
        std::system(("cd '" + folder().string() + "' && sh commands.sh > shell.txt 2>&1").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// A program of Slurm that notes how it was called and prints something.
  void stand_in(const std::string& name, const std::string& printed) const {
    write("bin/" + name, "#!/bin/sh\necho \"" + name + " $*\" >> calls.txt\necho '" + printed + "'\n");
    std::filesystem::permissions(folder() / "bin" / name, std::filesystem::perms::owner_all);
  }

  /// Runs the first of two shards with long cases, and after half a second tells it that its time is nearly
  /// up.
  int run_shard_until_told(int restarts_before) const {
    write("shell.toml", long_scene());
    stand_in("scontrol", "");
    return shell("export SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_ID=1 SLURM_RESTART_COUNT=" +
                 std::to_string(restarts_before) +
                 "\n"
                 "sh shards.sbatch sweep.toml out & sleep 0.5\n"
                 "kill -USR1 $!; wait $!\n");
  }
};

TEST_F(BatchFiles, SubmitTheArrayAndTheMergeBehindIt) {
  stand_in("sbatch", "31;here");
  EXPECT_EQ(shell("sh shards.sbatch sweep.toml out"), 0) << read("shell.txt");
  const std::string calls = read("calls.txt");
  for (const char* part : {" --array=1-2%8 ", " shards.sbatch sweep.toml out\n", " --dependency=afterany:31 ",
                           "/merge.sbatch sweep.toml out\n"})
    EXPECT_NE(calls.find(part), std::string::npos) << part << calls;
}

TEST_F(BatchFiles, GiveTheReportOfTheWholeStudy) {
  const int code = run({"study", "sweep.toml", "-o", "plain"}).code;
  EXPECT_EQ(shell("export SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_ID\n"
                  "for SLURM_ARRAY_TASK_ID in 1 2; do sh shards.sbatch sweep.toml out || exit; done\n"
                  "sh merge.sbatch sweep.toml out"),
            code)
      << read("shell.txt");
  for (const char* name : {"out/verdicts.csv", "out/critical_gaps.csv"}) EXPECT_TRUE(exists(name));
  EXPECT_EQ(read("out/verdicts.csv"), read("plain/verdicts.csv"));
}

TEST_F(BatchFiles, QueueATaskAgainThatReachesItsTimeLimit) {
  EXPECT_EQ(run_shard_until_told(9), 75) << read("shell.txt");
  EXPECT_EQ(read("calls.txt"), "scontrol requeue 7_1\n");
}

TEST_F(BatchFiles, QueueNoTaskAgainForEver) {
  EXPECT_EQ(run_shard_until_told(10), 75) << read("shell.txt");
  EXPECT_FALSE(exists("calls.txt"));
}

}  // namespace
}  // namespace launchsafe::app
