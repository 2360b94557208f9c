// With --json every outcome is one JSON object on stdout, errors too.
#include "stored_study.hpp"

namespace launchsafe::app {
namespace {

using Arguments = std::vector<std::string>;

class JsonProgram : public StoredStudy {
 protected:
  void SetUp() override {
    StoredStudy::SetUp();
    write("unknown_key.toml", with(tiny_scene, "peak_time = ", "peek_time = "));
    write("odd.toml", "kind = \"critical-gap\"\nscene = \"none.toml\"\n");
    std::filesystem::create_directory(folder() / "foreign");
    write("foreign/report.md", "mine\n");
  }

  /// What is printed, which must be one object and nothing else.
  nlohmann::json object_of(const Outcome& outcome) const {
    auto object = nlohmann::json::parse(outcome.out, nullptr, false);
    EXPECT_TRUE(object.is_object()) << outcome.out << outcome.err;
    return object.is_object() ? object : nlohmann::json::object();
  }
};

struct ErrorPath {
  Arguments arguments;
  int code;
  std::string part;  ///< of the message
};

TEST_F(JsonProgram, EveryObjectSaysWhatItIs) {
  EXPECT_EQ(object_of(run({"run", "shell.toml", "--json"}))["format"], "launchsafe run 1");
  EXPECT_EQ(object_of(run({"explain", "--keys", "--json"}))["format"], "launchsafe explain 1");
  EXPECT_EQ(object_of(run({"study", "study.toml", "-o", "out", "--json"}))["format"], "launchsafe study 1");
  EXPECT_EQ(nlohmann::json::parse(read("out/study.json"))["format"], "launchsafe study 1");
  EXPECT_EQ(object_of(run({"--version", "--json"}))["format"], "launchsafe 1");
  EXPECT_EQ(object_of(run({"run", "--json"}))["format"], "launchsafe 1");
}

TEST_F(JsonProgram, EveryErrorIsAnObjectAndOneLineForPeople) {
  const std::vector<ErrorPath> paths{
      {{}, 2, "subcommand"},
      {{"run", "shell.toml", "--fast"}, 2, "--fast"},
      {{"run", "absent.toml"}, 2, "absent.toml"},
      {{"run", "unknown_key.toml", "-o", "out"}, 2, "peek_time"},
      {{"run", "shell.toml", "-o", "shell.toml"}, 2, "no folder"},
      {{"study", "study.toml"}, 2, "--output"},
      {{"study", "study.toml", "-o", "out", "--memory", "much"}, 2, "--memory"},
      {{"study", "odd.toml", "-o", "out"}, 2, "none.toml"},
      {{"study", "absent.toml", "--dry-run"}, 2, "absent.toml"},
      {{"study", "study.toml", "-o", "foreign"}, 2, "foreign"},
      {{"merge", "study.toml", "-o", "merged"}, 3, "missing"},
      {{"merge", "study.toml", "-o", "merged", "nowhere"}, 2, "nowhere"},
      {{"explain"}, 2, "--keys"},
      {{"explain", "unknown_key.toml"}, 2, "peek_time"}};
  for (const ErrorPath& path : paths) {
    Arguments arguments = path.arguments;
    arguments.push_back("--json");
    const Outcome outcome = run(arguments);
    std::string line;
    for (const std::string& argument : arguments) line += argument + " ";
    EXPECT_EQ(outcome.code, path.code) << line << "\n" << outcome.err;
    const auto object = object_of(outcome);
    ASSERT_TRUE(object.contains("error")) << line << "\n" << outcome.out;
    const auto message = object["error"]["message"].get<std::string>();
    EXPECT_NE(message.find(path.part), std::string::npos) << line << "\n" << message;
    EXPECT_EQ(outcome.err, "launchsafe: " + message + "\n") << line;
    for (const char* key : {"file", "line", "column", "key", "found", "allowed", "suggestion"})
      EXPECT_TRUE(object["error"].contains(key)) << line << ": " << key;
  }
}

TEST_F(JsonProgram, AFaultOfTheInputHasItsParts) {
  const auto error = object_of(run({"run", "--json", "unknown_key.toml"}))["error"];
  EXPECT_EQ(error["file"], "unknown_key.toml");
  EXPECT_EQ(error["line"], 7);
  EXPECT_EQ(error["key"], "load.peek_time");
  EXPECT_NE(error["suggestion"].dump().find("peak_time"), std::string::npos) << error;
  EXPECT_TRUE(error["found"].is_string()) << error;
  EXPECT_TRUE(error["allowed"].is_string()) << error;
}

TEST_F(JsonProgram, AnInterruptionIsAnErrorOfOneObject) {
  write("long.toml", long_scene());
  start({"run", "long.toml", "--json", "--quiet"});
  wait_until_it_catches(SIGTERM);
  send(SIGTERM);
  const Outcome outcome = wait();
  EXPECT_EQ(outcome.code, 75) << outcome.err;
  EXPECT_TRUE(object_of(outcome).contains("error")) << outcome.out;
}

}  // namespace
}  // namespace launchsafe::app
