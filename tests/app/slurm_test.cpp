// launchsafe emit slurm: what the scripts say, and what they do where sbatch, squeue and scontrol are
// stand-ins. tests/app/slurm.sh runs them on a real Slurm.
#include "program.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <map>
#include <thread>

namespace launchsafe::app {
namespace {

const std::string small_sweep = R"(kind = "critical-gap"
scene = "shell.toml"
early_time = "0.03 ms"
gaps = "0, 0.01 cm"
confirm = false
input_uncertainty = { value = "2 K", because = "for a test" }
model_form_uncertainty = { value = "1 K", because = "for a test" }

[[vary]]
key = "peak_pressure"
values = "40, 50, 60 MPa"
)";

const std::vector<std::string> script_names{"shard.sbatch", "merge.sbatch", "submit.sh"};

class SlurmProgram : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("shell.toml", tiny_scene);
    write("sweep.toml", small_sweep);
    std::filesystem::create_directory(folder() / "bin");
  }

  Outcome emit(const std::vector<std::string>& options = {}, const std::string& study = "sweep.toml") {
    std::vector<std::string> arguments{"emit", "slurm", study, "-o", "out", "--shards", "2"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run(arguments);
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
  void stand_in(const std::string& name, const std::string& printed, const std::string& also = "") const {
    write("bin/" + name,
          "#!/bin/sh\necho \"" + name + " $*\" >> calls.txt\n" + also + "\necho '" + printed + "'\n");
    std::filesystem::permissions(folder() / "bin" / name, std::filesystem::perms::owner_all);
  }

  /// Runs a shard of two long cases as Slurm would, and after half a second has it told that its time is
  /// nearly up; `meanwhile` is done before the script asks for the state of the job.
  int run_shard_until_told(const std::string& job_state, const std::string& meanwhile) {
    write("shell.toml", long_scene());
    EXPECT_EQ(emit().code, 0);
    stand_in("squeue", job_state, meanwhile);
    stand_in("scontrol", "");
    return shell(
        "export SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_ID=1\n"
        "sh out/slurm/shard.sbatch & sleep 0.5\n"
        "kill -USR1 $!; wait $!\n");
  }

  /// MiB that the program has had at once, as the kernel says till its end.
  double memory_of(const std::vector<std::string>& arguments) {
    start(arguments);
    double kilobytes = 0;
    for (; !has_ended(); std::this_thread::sleep_for(std::chrono::milliseconds(1))) {
      std::ifstream status("/proc/" + std::to_string(child()) + "/status");
      for (std::string word; status >> word;)
        if (word == "VmHWM:") status >> kilobytes;
    }
    EXPECT_GE(wait().code, 0);
    return kilobytes / 1024.0;
  }

  std::string script(const std::string& name) const { return read("out/slurm/" + name); }
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(SlurmProgram, WritesThreeScriptsAndNamesTheOneCommandToRun) {
  const Outcome outcome = emit();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const std::string& name : script_names) {
    EXPECT_TRUE(contains(outcome.out, "out/slurm/" + name)) << outcome.out;
    EXPECT_EQ(shell("sh -n out/slurm/" + name + " && bash -n out/slurm/" + name), 0) << read("shell.txt");
  }
  EXPECT_TRUE(contains(outcome.out, "to submit: sh out/slurm/submit.sh\n")) << outcome.out;
  EXPECT_FALSE(exists("out/manifest.json"));
}

TEST_F(SlurmProgram, JsonHoldsTheFilesAndTheCommand) {
  const auto object = nlohmann::json::parse(emit({"--json", "--quiet"}).out);
  EXPECT_EQ(object["files"].size(), 3u);
  EXPECT_EQ(object["submit"], "sh out/slurm/submit.sh");
  EXPECT_EQ(object["time_s"], 600);
}

TEST_F(SlurmProgram, AsksForWhatAShardNeeds) {
  ASSERT_EQ(emit({"--jobs", "4", "--memory", "8GB", "--time-limit", "90s"}).code, 0);
  const std::string shard = script("shard.sbatch");
  for (const std::string part :
       {"#SBATCH --job-name=launchsafe-sweep\n", "#SBATCH --array=1-2\n", "#SBATCH --cpus-per-task=4\n",
        "#SBATCH --mem=7630M\n", "#SBATCH --time=0-00:10:00\n", "#SBATCH --requeue\n",
        "#SBATCH --open-mode=append\n", "#SBATCH --signal=B:USR1@60\n", "/out/slurm/%x-%a.log\"\n",
        " --shard \"$SLURM_ARRAY_TASK_ID/2\" --jobs 4 --memory 7200MB --time-limit 90s\n"}) {
    EXPECT_TRUE(contains(shard, part)) << part << " in\n" << shard;
  }
}

#ifndef __SANITIZE_ADDRESS__  // which has memory of its own
TEST_F(SlurmProgram, AShardAndTheMergeTakeTheMemoryThatTheyAskForLessAQuarter) {
  std::string pressures = "40 MPa";
  for (int i = 1; i < 150; ++i) pressures = fmt::format("{:.2f}, ", 40.0 - 0.01 * i) + pressures;
  const std::string in_detail = with(small_sweep, "confirm = false", "confirm = true");
  for (const std::string& study : {small_sweep, with(small_sweep, "40, 50, 60 MPa", pressures), in_detail}) {
    std::filesystem::remove_all(folder() / "out");
    write("sweep.toml", study);
    const auto asked = nlohmann::json::parse(emit({"--json"}).out);
    for (const std::string shard : {"1/2", "2/2"}) {
      const double taken =
          memory_of({"study", "sweep.toml", "-o", "out", "--shard", shard, "--jobs", "1", "-q"});
      EXPECT_LT(1.1 * taken, asked["memory_MiB"]) << shard << " of\n" << study;
      EXPECT_GT(1.6 * taken, asked["memory_MiB"]) << shard << " of\n" << study;
    }
    const double taken = memory_of({"merge", "sweep.toml", "-o", "out", "--jobs", "1", "-q"});
    EXPECT_LT(1.1 * taken, asked["merge_memory_MiB"]) << study;
    EXPECT_GT(1.6 * taken + 32, asked["merge_memory_MiB"]) << "gnuplot apart, of\n" << study;
  }
}
#endif

TEST_F(SlurmProgram, TheTimeFollowsFromTheSlowestShard) {
  write("shell.toml",
        with(with(tiny_scene, "0.15 ms", "20 ms"), "cell_size = \"5 mm\"", "cell_size = \"0.1 mm\""));
  const auto minutes = [this](const std::string& jobs) {
    std::filesystem::remove_all(folder() / "out");
    return nlohmann::json::parse(emit({"--jobs", jobs, "--json"}).out)["time_s"].get<double>() / 60.0;
  };
  const double one_after_the_other = minutes("1");  // two of three runs
  EXPECT_GT(one_after_the_other, 100.0);
  EXPECT_NEAR(minutes("2"), one_after_the_other / 2.0, 1.0);
}

TEST_F(SlurmProgram, TheUsersOptionsComeLastAndOnlyTheShardsAreAnArray) {
  ASSERT_EQ(emit({"--sbatch", "--partition=long", "--sbatch=--array=1-2%1", "--sbatch=--comment=my # study",
                  "--sbatch=-A group"})
                .code,
            0);
  const std::string others = "#SBATCH --comment=\"my # study\"\n#SBATCH -A group\n\n";
  EXPECT_TRUE(
      contains(script("shard.sbatch"), ".log\"\n#SBATCH --partition=long\n#SBATCH --array=1-2%1\n" + others))
      << script("shard.sbatch");
  EXPECT_TRUE(contains(script("merge.sbatch"), ".log\"\n#SBATCH --partition=long\n" + others))
      << script("merge.sbatch");
}

TEST_F(SlurmProgram, ScriptsAreKeptAsTheyAreOrRefused) {
  ASSERT_EQ(emit().code, 0);
  std::map<std::string, std::string> before;
  for (const std::string& name : script_names) before[name] = script(name);
  EXPECT_EQ(emit().code, 0);
  const Outcome other = emit({"--jobs", "2"});
  EXPECT_EQ(other.code, 2);
  EXPECT_EQ(other.lines_of_error(), 1) << other.err;
  EXPECT_TRUE(other.says("out/slurm/shard.sbatch")) << other.err;
  EXPECT_TRUE(other.out.empty()) << other.out;
  for (const std::string& name : script_names) EXPECT_EQ(script(name), before[name]);
}

TEST_F(SlurmProgram, BadInputLeavesNothing) {
  EXPECT_EQ(emit({"--sbatch=partition=long"}).code, 2);
  EXPECT_EQ(emit({"--sbatch=--comment=a\nb"}).code, 2);
  EXPECT_EQ(emit({"--memory", "much"}).code, 2);
  EXPECT_EQ(run({"emit", "slurm", "sweep.toml", "-o", "back\\slash", "--shards", "2"}).code, 2);
  write("sweep.toml", with(small_sweep, "gaps", "gasps"));
  const Outcome unknown = emit();
  EXPECT_EQ(unknown.code, 2);
  EXPECT_TRUE(unknown.says("sweep.toml:4:")) << unknown.err;
  EXPECT_FALSE(exists("out"));
  EXPECT_FALSE(exists("back\\slash"));
}

TEST_F(SlurmProgram, AFolderOfAnotherStudyIsRefused) {
  ASSERT_NE(run({"study", "sweep.toml", "-o", "out"}).code, 2);
  write("sweep.toml", with(small_sweep, "60 MPa", "70 MPa"));
  EXPECT_EQ(emit().code, 2);
  EXPECT_FALSE(exists("out/slurm"));
}

TEST_F(SlurmProgram, SubmitsTheArrayAndTheMergeBehindIt) {
  stand_in("sbatch", "31;here");
  ASSERT_EQ(emit().code, 0);
  EXPECT_EQ(shell("sh out/slurm/submit.sh"), 0) << read("shell.txt");
  EXPECT_TRUE(contains(read("shell.txt"), "2 shards as job 31, the merge as job 31\n")) << read("shell.txt");
  const std::string calls = read("calls.txt");
  EXPECT_TRUE(contains(calls, "/out/slurm/shard.sbatch\nsbatch --parsable --dependency=afterany:31 /"))
      << calls;
  EXPECT_TRUE(contains(calls, "/out/slurm/merge.sbatch\n")) << calls;
}

TEST_F(SlurmProgram, SubmittingWithoutSlurmFailsAndSaysSo) {
  ASSERT_EQ(emit().code, 0);
  EXPECT_EQ(shell("PATH=$PWD/bin\n. ./out/slurm/submit.sh"), 70);
  EXPECT_TRUE(contains(read("shell.txt"), "sbatch is not there")) << read("shell.txt");
  stand_in("sbatch", "");
  write("bin/sbatch", "#!/bin/sh\necho 'no such partition' >&2\nexit 1\n");
  EXPECT_EQ(shell("sh out/slurm/submit.sh"), 70);
  EXPECT_TRUE(contains(read("shell.txt"), "Slurm took no job")) << read("shell.txt");
}

TEST_F(SlurmProgram, ShardsAndMergeGiveTheReportOfTheWholeStudyFromAnyFolder) {
  const std::string odd = R"(it's a "$HOME" of 100%)";
  std::filesystem::create_directory(folder() / odd);
  write(odd + "/shell.toml", tiny_scene);
  write(odd + "/sweep.toml", small_sweep);
  const int code = run({"study", (folder() / odd / "sweep.toml").string(), "-o", "plain"}).code;
  ASSERT_EQ(run({"emit", "slurm", odd + "/sweep.toml", "-o", odd + "/out", "--shards", "2"}).code, 0);
  EXPECT_TRUE(
      contains(read(odd + "/out/slurm/shard.sbatch"), R"(/it's a \"$HOME\" of 100%%/out/slurm/%x-%a.log")"));
  EXPECT_EQ(
      shell(
          "cd it*/out/slurm && for SLURM_ARRAY_TASK_ID in 1 2; do\n"
          "  export SLURM_ARRAY_TASK_ID SLURM_ARRAY_JOB_ID=7; (cd / && sh \"$OLDPWD/shard.sbatch\") || exit\n"
          "done\n"
          "sh merge.sbatch"),
      code)
      << read("shell.txt");
  for (const std::string name : {"verdicts.csv", "critical_gaps.csv"}) {
    EXPECT_TRUE(read(odd + "/out/" + name) == read("plain/" + name)) << name;
    EXPECT_FALSE(read("plain/" + name).empty()) << name;
  }
}

/// What the status of a shard says once a case is finished.
std::string finished_by_shard(int shard) {
  return fmt::format(R"(echo '"runs_stored": 1' > out/status.{}-of-2.json)", shard);
}
const std::string a_case_is_stored = finished_by_shard(1);

TEST_F(SlurmProgram, ATaskWhoseTimeIsNearlyUpIsQueuedAgain) {
  EXPECT_EQ(run_shard_until_told("RUNNING", a_case_is_stored), 75) << read("shell.txt");
  EXPECT_TRUE(contains(read("shell.txt"), "launchsafe: interrupted; 0 runs are kept")) << read("shell.txt");
  EXPECT_TRUE(contains(read("calls.txt"), "scontrol requeue 7_1\n")) << read("calls.txt");
}

TEST_F(SlurmProgram, ATaskThatCannotFinishACaseInItsTimeIsNot) {
  EXPECT_EQ(run_shard_until_told("RUNNING", ""), 75) << read("shell.txt");
  EXPECT_TRUE(contains(read("shell.txt"), "raise --time in shard.sbatch")) << read("shell.txt");
  EXPECT_FALSE(contains(read("calls.txt"), "scontrol")) << read("calls.txt");
}

TEST_F(SlurmProgram, WhatOtherShardsFinishDoesNotQueueATaskAgain) {
  const std::string other = finished_by_shard(2) + "; mkdir -p out/cases; : > out/cases/fake.h5";
  EXPECT_EQ(run_shard_until_told("RUNNING", other), 75) << read("shell.txt");
  EXPECT_FALSE(contains(read("calls.txt"), "scontrol")) << read("calls.txt");
}

TEST_F(SlurmProgram, ACancelledTaskIsNot) {
  EXPECT_EQ(run_shard_until_told("COMPLETING", a_case_is_stored), 75) << read("shell.txt");
  EXPECT_TRUE(contains(read("shell.txt"), "not queued again: the task is COMPLETING")) << read("shell.txt");
  EXPECT_FALSE(contains(read("calls.txt"), "scontrol")) << read("calls.txt");
}

TEST_F(SlurmProgram, CasesThatFailedDoNotFailTheirShard) {
  ASSERT_EQ(emit({"--time-limit", "1e-6 s"}).code, 0);
  EXPECT_EQ(shell("SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_ID=1 sh out/slurm/shard.sbatch"), 0)
      << read("shell.txt");
  EXPECT_TRUE(contains(read("shell.txt"), "some cases failed")) << read("shell.txt");
  EXPECT_EQ(shell("sh out/slurm/merge.sbatch"), 3) << read("shell.txt");
}

}  // namespace
}  // namespace launchsafe::app
