// Studies of one launch in one safety report have to agree.
#include "safety_report_files.hpp"

namespace launchsafe::report {
namespace {

TEST_F(SafetyReport, StudiesOfDifferentShellsAreRefusedByName) {
  const path study = copy_of("accuracy");
  // The manifest's input with its checksum, as a study of another shell would have written it.
  auto manifest = nlohmann::ordered_json::parse(read(study / "manifest.json"));
  std::string input = manifest["input"];
  const std::string from = "charge.density = \"1717 kg/m3\"";
  input.replace(input.find(from), from.size(), "charge.density = \"1600 kg/m3\"");
  manifest["input"] = input;
  manifest["input_sha256"] = store::sha256(input);
  write(study / "manifest.json", manifest.dump(2));
  const std::string fault = fault_of({shipped("critical_gap_155mm"), study});
  EXPECT_TRUE(has(fault, "different shells")) << fault;
  EXPECT_TRUE(has(fault, "charge.density")) << fault;
  EXPECT_TRUE(has(fault, study.string())) << fault;
}

/// The bounds of the launch at 496 MPa in the main job, which is case 0 of it, and in the sweep.
class SafetyReportOfOneLaunch : public SafetyReport {
 protected:
  void SetUp() override {
    SafetyReport::SetUp();
    main_ = copy_of("critical_gap_155mm");
    sweep_ = copy_of("sweep_pressure_defect");
  }
  /// The sweep's case of that launch gets the main job's bound, 0.0273431 cm, and `by` more.
  void bound_differs_by(double by) {
    const auto main = nlohmann::json::parse(read(main_ / "study.json"))["cases"][0];
    change(sweep_, [&](auto& results) {
      for (auto& row : results["cases"])
        if (row["peak_pressure_MPa"] == 496.0 && row["crack_radius_um"] == 30.0)
          set_bound(row, main["critical_gap_at_least_cm"].template get<double>() + by);
    });
  }
  /// The sweep's input is that of the main job but for one key.
  void with_scene_of_main(const std::string& from, const std::string& to) {
    auto manifest = nlohmann::ordered_json::parse(read(sweep_ / "manifest.json"));
    const std::string input = manifest["input"];
    const std::string heading = "\n\n# scene\n";
    std::string main_input = nlohmann::ordered_json::parse(read(main_ / "manifest.json"))["input"];
    std::string scene = main_input.substr(main_input.rfind(heading));
    if (!from.empty()) {
      ASSERT_NE(scene.find(from), std::string::npos) << from;
      scene.replace(scene.find(from), from.size(), to);
    }
    const std::string whole = input.substr(0, input.rfind(heading)) + scene;
    manifest["input"] = whole;
    manifest["input_sha256"] = store::sha256(whole);
    write(sweep_ / "manifest.json", manifest.dump(2));
  }
  path main_, sweep_;
};

// What bounds may differ by: the brackets, 0.0001 cm each.
TEST_F(SafetyReportOfOneLaunch, StudiesThatBoundItDifferentlyAreRefused) {
  with_scene_of_main("", "");
  bound_differs_by(0.00019);
  EXPECT_EQ(fault_of({main_, sweep_}), "");
  bound_differs_by(0.00021);
  const std::string fault = fault_of({main_, sweep_});
  for (const std::string& part : {main_.string(), sweep_.string(), std::string("case 496 MPa"),
                                  std::string("0.0273431 cm"), std::string("0.0275531 cm"),
                                  std::string("one launch different lower bounds"), std::string("allowed")})
    EXPECT_TRUE(has(fault, part)) << part << " in " << fault;
}

TEST_F(SafetyReportOfOneLaunch, OtherNumericsMayHaveAnotherBound) {
  with_scene_of_main("numerics.pic_fraction = 0\n", "numerics.pic_fraction = 0.01\n");
  bound_differs_by(0.01);
  EXPECT_EQ(fault_of({main_, sweep_}), "");
}

TEST_F(SafetyReportOfOneLaunch, AnotherLaunchMayHaveAnotherBound) {
  with_scene_of_main("initial_temperature = \"300 K\"", "initial_temperature = \"310 K\"");
  bound_differs_by(0.01);
  EXPECT_EQ(fault_of({main_, sweep_}), "");
}

}  // namespace
}  // namespace launchsafe::report
