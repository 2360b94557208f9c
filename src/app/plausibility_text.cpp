#include "plausibility_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>

namespace launchsafe::app {
namespace {

std::string line_of(const scene::Implausible& value) {
  if (value.accepted()) return scene::accepted_text({value});
  return "verdicts are in doubt: " + scene::doubt_text(value);
}

}  // namespace

std::vector<std::string> plausibility_lines(const scene::Scene& scene) {
  std::vector<std::string> lines;
  for (const scene::Implausible& each : scene::implausible_values(scene)) lines.push_back(line_of(each));
  for (const std::string& key : scene::needless_acceptances(scene))
    lines.push_back(fmt::format("accept names {}, whose value is plausible", key));
  return lines;
}

std::vector<std::string> plausibility_lines(const study::StudyFile& study) {
  if (study.study.kind == study::StudyKind::stability) return {};
  std::vector<std::string> lines;
  for (const scene::Implausible& each : study.study.implausible) lines.push_back(line_of(each));
  std::vector<std::string> order;
  std::map<std::string, std::size_t> cases;
  for (const study::StudyCase& each : study.cases) {
    for (const scene::Implausible& value : scene::implausible_values(each.scene.scene)) {
      const std::string line = line_of(value);
      if (++cases[line] == 1) order.push_back(line);
    }
  }
  for (const std::string& line : order)
    lines.push_back(fmt::format("{} ({} of {} cases)", line, cases[line], study.cases.size()));
  return lines;
}

nlohmann::ordered_json plausibility_json(const scene::Scene& scene) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const scene::Implausible& each : scene::implausible_values(scene)) {
    list.push_back({{"key", each.key},
                    {"value", each.value},
                    {"plausible", each.range},
                    {"accepted_because", each.accepted() ? nlohmann::ordered_json(each.because) : nullptr}});
  }
  return list;
}

}  // namespace launchsafe::app
